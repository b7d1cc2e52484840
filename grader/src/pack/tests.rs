//! Packages used as on their platforms, with a stand-in for the grader.

use std::process::Output;

use super::*;

mod checks;

/// A repository with a window, which no package needs.
const REPOSITORY: [(&str, &str); 9] = [
    (
        "Cargo.toml",
        r#"[workspace]
members = ["crates/window", "grader"]
[package]
name = "course"
edition = "2024"
[features]
default = ["window"]
window = ["dep:window"]
[[bin]]
name = "course"
path = "src/main.rs"
required-features = ["window"]
[dependencies]
window = { path = "crates/window", optional = true }
[dev-dependencies]
grader = { path = "grader" }
[profile.dev.package]
window = { opt-level = 1 }
"#,
    ),
    (
        "Cargo.lock",
        r#"version = 4

[[package]]
name = "course"
version = "0.0.0"
dependencies = [
 "grader",
 "window",
]

[[package]]
name = "grader"
version = "0.0.0"
dependencies = [
 "course",
]

[[package]]
name = "window"
version = "0.0.0"
"#,
    ),
    ("src/lib.rs", "#[cfg(feature = \"window\")]\npub mod demo;\n"),
    ("src/main.rs", "fn main() {}\n"),
    (
        "grader/Cargo.toml",
        "[package]\nname = \"grader\"\nedition = \"2024\"\n[dependencies]\n\
         course = { path = \"..\", default-features = false }\n",
    ),
    ("grader/src/lib.rs", ""),
    ("crates/window/Cargo.toml", "[package]\nname = \"window\"\nedition = \"2024\"\n"),
    ("crates/window/src/lib.rs", ""),
    ("target/x", ""),
];

fn packed(platform: Platform) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let repository = folder.path().join("repository");
    for (name, text) in REPOSITORY {
        let path = repository.join(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, text).unwrap();
    }
    // Inside the repository, as users will do: it must not be packed into itself.
    let out = repository.join("out");
    pack(&PackOptions {
        platform,
        out,
        repository,
        seed: 42,
        rubric: None,
        functions: 22,
        checks: Vec::new(),
        vendor: false,
    })
    .unwrap();
    folder
}

/// Writes a program without having it open for writing, which would keep other threads' programs from starting.
fn program(path: &Path, text: &str) {
    fs::create_dir_all(path.parent().unwrap()).unwrap();
    let script = r#"printf '%s' "$2" >"$1" && chmod +x "$1""#;
    assert!(Command::new("sh").args(["-c", script, "sh"]).arg(path).arg(text).status().unwrap().success());
}

/// Runs `run_autograder` with a grader; gives what it did and the results that it left.
fn run_autograder(grader: &str) -> (Output, Option<String>) {
    let folder = packed(Platform::Gradescope);
    let root = folder.path().join("autograder");
    fs::create_dir_all(root.join("results")).unwrap();
    fs::write(root.join("results/results.json"), "of another submission").unwrap();
    program(&root.join("source/target/release/grader"), grader);
    let script = folder.path().join("repository/out/autograder/run_autograder");
    fs::write(root.join("submission_metadata.json"), "{}").unwrap();
    let output = Command::new(script).env("AUTOGRADER_ROOT", &root).output().unwrap();
    (output, fs::read_to_string(root.join("results/results.json")).ok())
}

#[test]
fn the_archive_for_gradescope_has_its_scripts_at_the_top_and_the_sources() {
    let folder = packed(Platform::Gradescope);
    let mut zip =
        zip::ZipArchive::new(File::open(folder.path().join("repository/out/autograder.zip")).unwrap()).unwrap();
    let names: Vec<String> = zip.file_names().map(|name| name.unwrap().into_owned()).collect();
    assert_eq!(
        names,
        [
            "AUTOGRADER.md",
            "Cargo.lock",
            "Cargo.toml",
            "grader/Cargo.toml",
            "grader/src/lib.rs",
            "run_autograder",
            "setup.sh",
            "src/lib.rs",
            "src/main.rs"
        ]
    );
    for name in ["run_autograder", "setup.sh"] {
        assert_eq!(zip.by_name(name).unwrap().unix_mode().unwrap() & 0o777, 0o755);
    }
    let text = io::read_to_string(zip.by_name("setup.sh").unwrap()).unwrap();
    assert!(text.contains("--seed 42") && !text.contains("@SEED@") && !text.contains("@TOOLCHAIN@"));
}

/// Packages of a lock file.
fn locked(path: &Path) -> Vec<String> {
    let text = fs::read_to_string(path).unwrap();
    text.lines().filter_map(|line| line.strip_prefix("name = ")).map(|name| name.trim_matches('"').to_owned()).collect()
}

/// Checks with cargo that the grader of a package can be built with the lock file unchanged.
fn is_whole(files: &Path) -> bool {
    let mut cargo = Command::new("cargo");
    cargo
        .args(["tree", "--locked", "--offline", "--package", "grader"])
        .current_dir(files)
        .output()
        .unwrap()
        .status
        .success()
}

#[test]
fn a_package_asks_for_no_window() {
    let folder = packed(Platform::Gradescope);
    let files = folder.path().join("repository/out/autograder");
    assert_eq!(locked(&files.join("Cargo.lock")), ["course", "grader"]);
    assert!(is_whole(&files));
}

#[test]
fn this_repository_packs_into_two_megabytes_without_the_window() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    let repository = crate::grading::repository();
    let rubric = repository.join("grader/rubrics/second.toml");
    let platform = Platform::Gradescope;
    let asked = Some(rubric.clone());
    let (functions, checks) = (10, Vec::new());
    pack(&PackOptions {
        platform,
        out: out.clone(),
        repository,
        seed: 1,
        rubric: asked,
        functions,
        checks,
        vendor: false,
    })
    .unwrap();
    let read = |path: &Path| fs::read_to_string(path).unwrap();
    assert_eq!(read(&out.join("autograder/grader/rubric.toml")), read(&rubric), "the assignment's");
    let names = locked(&out.join("autograder/Cargo.lock"));
    for name in ["nalgebra", "grader", "grader-child", "finite-elements-3d"] {
        assert!(names.iter().any(|found| found == name), "{name} is missing");
    }
    for name in ["fem-viewer", "fem-engine", "kiss3d", "wgpu", "egui", "image"] {
        assert!(!names.iter().any(|found| found == name), "{name} comes along");
    }
    // The sources of what is locked come along with --vendor: 160 packages are 25 MB, 530 were 94.
    assert!(names.len() < 200, "{} packages", names.len());
    assert!(fs::metadata(out.join("autograder.zip")).unwrap().len() < 2_000_000);
    assert!(is_whole(&out.join("autograder")));
}

#[test]
fn gradescope_gets_the_results_of_a_grader_that_worked() {
    let (output, results) = run_autograder("#!/bin/sh\necho \"$@\"\necho '{}' >\"$4/results.json\"\n");
    assert!(output.status.success());
    assert_eq!(results.as_deref(), Some("{}\n"));
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(text.starts_with("grade ") && text.contains("/submission --out ") && text.contains("--seed 42"), "{text}");
    assert!(text.ends_with("/autograder/submission_metadata.json\n") && text.contains(" --metadata "), "{text}");
}

#[test]
fn gradescope_gets_no_score_from_a_grader_that_failed() {
    for grader in ["#!/bin/sh\necho '{}' >\"$4/results.json\"\nexit 1\n", "#!/bin/sh\nexit 0\n"] {
        let (output, results) = run_autograder(grader);
        assert_eq!((output.status.code(), results), (Some(1), None));
        assert!(String::from_utf8(output.stdout).unwrap().contains("no grade"));
    }
}

#[test]
fn classroom_50_gets_the_graders_result_and_nothing_from_a_grader_that_failed() {
    let folder = packed(Platform::Classroom50);
    let out = folder.path().join("repository/out");
    assert!(!out.join("src").exists(), "students can read what is published there");
    let grader = folder.path().join("grader");
    let run = |text: &str| {
        program(&grader, text);
        fs::write(folder.path().join("result.json"), "forged").unwrap();
        let mut command = Command::new("python3");
        command.arg(out.join("autograder.py")).env("GRADER", &grader).current_dir(folder.path());
        (command.output().unwrap().status.code(), fs::read_to_string(folder.path().join("result.json")).ok())
    };
    let graded = "#!/bin/sh\n[ \"$1\" = sandbox ] || echo \"$6\" >\"$4/result.json\"\n";
    assert_eq!(run(graded), (Some(0), Some("42\n".to_owned())));
    let unconfined = format!("{graded}[ \"$1\" != sandbox ]\n");
    assert_eq!(run(&unconfined), (Some(1), None), "without a sandbox nothing is graded");
    // A grader that does not know whose submission it is writes no such file.
    for text in [
        "#!/bin/sh\nexit 1\n",
        "#!/bin/sh\nexit 0\n",
        "#!/bin/sh\n[ \"$1\" = sandbox ] && exit\necho '{}' >\"$4/result.json\"; exit 1\n",
    ] {
        assert_eq!(run(text), (Some(1), None), "{text}");
    }
}

#[test]
fn each_platform_asks_for_the_sandbox_before_it_grades() {
    for (platform, script, grades) in [
        (Platform::Gradescope, "autograder/setup.sh", "grader grade"),
        (Platform::Classroom50, "autograder.py", "\"grade\""),
        (Platform::Slurm, "array.sbatch", "\" class"),
    ] {
        let folder = packed(platform);
        let text = fs::read_to_string(folder.path().join("repository/out").join(script)).unwrap();
        let calls = |asked: &str| text.find(asked).unwrap_or_else(|| panic!("{script} has no {asked}"));
        let asks =
            text.find("grader sandbox").or(text.find("\"$grader\" sandbox")).or(text.find("GRADER, \"sandbox\""));
        assert!(asks.is_some_and(|at| at < text.rfind(grades).unwrap_or(calls(grades))), "{script}");
    }
}

#[test]
fn no_mark_is_left_in_a_package_and_a_full_folder_is_refused() {
    for platform in [Platform::Gradescope, Platform::Classroom50, Platform::Slurm] {
        let folder = packed(platform);
        let repository = folder.path().join("repository");
        let mut out = repository.join("out");
        let again = PackOptions {
            platform,
            out: out.clone(),
            repository,
            seed: 1,
            rubric: None,
            functions: 22,
            checks: Vec::new(),
            vendor: false,
        };
        assert!(matches!(pack(&again), Err(PackError::Folder(FolderError::NotEmpty(_)))));
        if platform == Platform::Gradescope {
            out.push("autograder");
        }
        for path in fs::read_dir(out).unwrap().map(|entry| entry.unwrap().path()).filter(|path| path.is_file()) {
            let text = fs::read_to_string(&path).unwrap();
            for mark in ["@TOOLCHAIN@", "@SEED@", "@RUBRIC@", "@FUNCTIONS@", "@SHARDS@", "@CPUS@", "@MEMORY@", "@TIME@"]
            {
                assert!(!text.contains(mark), "{mark} in {}", path.display());
            }
        }
    }
}

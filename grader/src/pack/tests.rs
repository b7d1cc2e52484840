//! Packages as their engines would use them, with a grader that does what a test wants.

use std::process::Output;

use super::*;

fn packed(engine: Engine) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let repository = folder.path().join("repository");
    for (name, text) in
        [("Cargo.toml", ""), ("Cargo.lock", ""), ("src/lib.rs", "code"), ("grader/x", ""), ("target/x", "")]
    {
        let path = repository.join(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, text).unwrap();
    }
    // Inside the repository, as users will do: it must not be packed into itself.
    let out = repository.join("out");
    pack(&PackOptions { engine, out, repository, seed: 42, vendor: false }).unwrap();
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
    let folder = packed(Engine::Gradescope);
    let root = folder.path().join("autograder");
    fs::create_dir_all(root.join("results")).unwrap();
    fs::write(root.join("results/results.json"), "of another submission").unwrap();
    program(&root.join("source/target/release/grader"), grader);
    let script = folder.path().join("repository/out/autograder/run_autograder");
    let output = Command::new(script).env("AUTOGRADER_ROOT", &root).output().unwrap();
    (output, fs::read_to_string(root.join("results/results.json")).ok())
}

#[test]
fn the_archive_for_gradescope_has_its_scripts_at_the_top_and_the_sources() {
    let folder = packed(Engine::Gradescope);
    let mut zip =
        zip::ZipArchive::new(File::open(folder.path().join("repository/out/autograder.zip")).unwrap()).unwrap();
    let names: Vec<String> = zip.file_names().map(|name| name.unwrap().into_owned()).collect();
    assert_eq!(
        names,
        ["AUTOGRADER.md", "Cargo.lock", "Cargo.toml", "grader/x", "run_autograder", "setup.sh", "src/lib.rs"]
    );
    for name in ["run_autograder", "setup.sh"] {
        assert_eq!(zip.by_name(name).unwrap().unix_mode().unwrap() & 0o777, 0o755);
    }
    let text = io::read_to_string(zip.by_name("setup.sh").unwrap()).unwrap();
    assert!(text.contains("--seed 42") && !text.contains("@SEED@") && !text.contains("@TOOLCHAIN@"));
}

#[test]
fn gradescope_gets_the_results_of_a_grader_that_worked() {
    let (output, results) = run_autograder("#!/bin/sh\necho \"$@\"\necho '{}' >\"$4/results.json\"\n");
    assert!(output.status.success());
    assert_eq!(results.as_deref(), Some("{}\n"));
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(
        text.starts_with("grade ") && text.contains("/submission --out ") && text.ends_with("--seed 42\n"),
        "{text}"
    );
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
fn classroom_50_gets_whole_numbers_and_nothing_from_a_grader_that_failed() {
    let folder = packed(Engine::Classroom50);
    let out = folder.path().join("repository/out");
    assert!(!out.join("src").exists(), "students can read what is published there");
    let grader = folder.path().join("grader");
    let run = |text: &str| {
        program(&grader, text);
        fs::write(folder.path().join("result.json"), "forged").unwrap();
        let mut command = Command::new("python3");
        for name in ["CLASSROOM", "ASSIGNMENT", "SUBMISSION_TAG", "COMMIT_URL", "RELEASE_URL"] {
            command.env(name, name);
        }
        command.arg(out.join("autograder.py")).env("GRADER", &grader).current_dir(folder.path());
        (command.output().unwrap().status.code(), fs::read_to_string(folder.path().join("result.json")).ok())
    };
    let tests =
        r#"{"tests": [{"name": "a", "score": 1.5, "max_score": 2}, {"name": "b", "score": 1, "max_score": 1}]}"#;
    let (code, text) = run(&format!("#!/bin/sh\necho '{tests}' >\"$4/results.json\"\n"));
    let result: serde_json::Value = serde_json::from_str(&text.unwrap()).unwrap();
    assert_eq!((code, &result["score"], &result["max-score"]), (Some(0), &250.into(), &300.into()));
    assert_eq!((&result["schema"], &result["tests"][1]["passed"]), (&"classroom50/result/v1".into(), &true.into()));
    assert_eq!(run("#!/bin/sh\nexit 1\n"), (Some(1), None));
    assert_eq!(run("#!/bin/sh\necho nonsense >\"$4/results.json\"\n"), (Some(1), None));
}

#[test]
fn no_mark_is_left_in_a_package_and_a_full_folder_is_refused() {
    for engine in [Engine::Gradescope, Engine::Classroom50, Engine::Slurm] {
        let folder = packed(engine);
        let repository = folder.path().join("repository");
        let mut out = repository.join("out");
        let again = PackOptions { engine, out: out.clone(), repository, seed: 1, vendor: false };
        assert!(matches!(pack(&again), Err(PackError::NotEmpty(_))));
        if engine == Engine::Gradescope {
            out.push("autograder");
        }
        for path in fs::read_dir(out).unwrap().map(|entry| entry.unwrap().path()).filter(|path| path.is_file()) {
            let text = fs::read_to_string(&path).unwrap();
            for mark in ["@TOOLCHAIN@", "@SEED@", "@SHARDS@", "@CPUS@", "@MEMORY@", "@TIME@"] {
                assert!(!text.contains(mark), "{mark} in {}", path.display());
            }
        }
    }
}

//! Composes the shaders of the kiss3d that this workspace is built with, each with all its conditions off, all on, and one on or
//! off at a time. naga must accept them, and find the entry points of the source.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::Command;

use naga::valid::{Capabilities, ValidationFlags, Validator};

/// Returns the folder of kiss3d's shaders.
fn shaders() -> PathBuf {
    let host = output(Command::new("rustc").args(["--print", "host-tuple"]));
    let host = std::str::from_utf8(&host).expect("a name in UTF-8").trim();
    // Packages of other systems need not be there.
    let metadata = output(Command::new(env!("CARGO")).args([
        "metadata",
        "--format-version",
        "1",
        "--offline",
        "--filter-platform",
        host,
    ]));
    let metadata: serde_json::Value = serde_json::from_slice(&metadata).expect("cargo metadata prints JSON");
    let packages = metadata["packages"].as_array().expect("a list of packages");
    let kiss3d = packages.iter().find(|package| package["name"] == "kiss3d").expect("kiss3d is a dependency");
    Path::new(kiss3d["manifest_path"].as_str().expect("a path")).with_file_name("src").join("builtin")
}

/// Returns what a command prints.
fn output(command: &mut Command) -> Vec<u8> {
    let output = command.current_dir(env!("CARGO_MANIFEST_DIR")).output().expect("the command starts");
    assert!(output.status.success(), "{command:?}: {}", String::from_utf8_lossy(&output.stderr));
    output.stdout
}

/// Returns a module's path in the imports of the shaders.
fn module(file: &Path) -> String {
    match file.file_stem().and_then(|stem| stem.to_str()).expect("a name in UTF-8") {
        "rt_intersect_bvh" => "package::rt_intersect".to_string(),
        stem => format!("package::{stem}"),
    }
}

fn conditions(source: &str) -> BTreeSet<&str> {
    source
        .lines()
        .map(|line| line.split("//").next().expect("a line"))
        .flat_map(|line| line.split("@if(").skip(1))
        .filter_map(|behind| behind.split_once(')'))
        .flat_map(|(condition, _)| condition.split(['|', '&', '!', ' ']))
        .filter(|name| !name.is_empty())
        .collect()
}

fn compose(modules: &[(String, String)], root: &str, features: &BTreeSet<&str>) -> String {
    let mut resolver = wesl::VirtualResolver::new();
    for (path, source) in modules {
        resolver.add_module(path.parse().expect("a path"), source.clone());
    }
    let mut composer = wesl::Wesl::new("").set_custom_resolver(resolver);
    for feature in features {
        composer.set_feature(feature, true);
    }
    composer.compile(&root.parse().expect("a path")).unwrap_or_else(|error| panic!("{root} with {features:?}: {error}"))
}

#[test]
fn every_shader_of_kiss3d_is_valid_when_composed() {
    let folder = shaders();
    let files: Vec<PathBuf> = [folder.clone(), folder.join("raytrace")]
        .iter()
        .flat_map(|folder| std::fs::read_dir(folder).expect("the folder of shaders"))
        .map(|entry| entry.expect("a file").path())
        .filter(|path| path.extension().is_some_and(|extension| extension == "wgsl"))
        .collect();
    let modules: Vec<(String, String)> =
        files.iter().map(|file| (module(file), std::fs::read_to_string(file).expect("a shader"))).collect();
    let mut composed = 0;
    for (root, source) in modules.iter().filter(|(root, _)| !root.contains("rt_intersect")) {
        let all = conditions(source);
        let mut variants = vec![BTreeSet::new(), all.clone()];
        variants.extend(all.iter().map(|one| BTreeSet::from([*one])));
        variants.extend(all.iter().map(|one| all.iter().copied().filter(|other| other != one).collect()));
        for features in variants {
            if features.contains("hardware") {
                continue; // with another module for the intersections
            }
            let text = compose(&modules, root, &features);
            let shader = naga::front::wgsl::parse_str(&text)
                .unwrap_or_else(|error| panic!("{root} with {features:?}: {}", error.emit_to_string(&text)));
            Validator::new(ValidationFlags::all(), Capabilities::all())
                .validate(&shader)
                .unwrap_or_else(|error| panic!("{root} with {features:?}: {error:?}"));
            composed += 1;
        }
    }
    assert!(composed > 80, "{composed} shaders were composed");
}

//! Puts an instructor's own checks into the grader. The file that `GRADER_CHECKS` names lists them, one in each line: function, name and
//! file, divided by tabs. Without it there are none.

use std::path::PathBuf;
use std::{env, fs};

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rerun-if-env-changed=GRADER_CHECKS");
    println!("cargo::rerun-if-env-changed=GRADER_CHECKS_KEY");
    let list = env::var_os("GRADER_CHECKS").map(|path| fs::read_to_string(path).expect("the list of checks"));
    let (mut modules, mut rows) = (String::new(), String::new());
    for (index, line) in list.unwrap_or_default().lines().enumerate() {
        let parts: Vec<&str> = line.split('\t').collect();
        let [function, name, file] = parts[..] else { panic!("`{line}` is no function, name and file") };
        println!("cargo::rerun-if-changed={file}");
        modules.push_str(&format!("#[path = {file:?}]\nmod check{index};\n"));
        rows.push_str(&format!("    ({function:?}, Check {{ name: {name:?}, run: check{index}::check }}),\n"));
    }
    let key = env::var("GRADER_CHECKS_KEY").unwrap_or_default();
    let is_release = env::var("PROFILE").is_ok_and(|profile| profile == "release");
    let code = format!(
        "{modules}/// The checks, each with its function.\npub const OWN: &[(&str, Check)] = &[\n{rows}];\n\
         /// Key of the sources that they were built from.\npub const KEY: &str = {key:?};\n\
         /// True in a build with `--release`.\npub const IS_RELEASE: bool = {is_release};\n"
    );
    let folder = PathBuf::from(env::var_os("OUT_DIR").expect("cargo names a folder"));
    fs::write(folder.join("own_checks.rs"), code).expect("the folder can be written to");
}

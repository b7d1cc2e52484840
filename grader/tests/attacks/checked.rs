//! `check` on another's folder.

use std::fs;
use std::net::TcpListener;
use std::process::Command;

use tempfile::TempDir;

use super::classroom::solutions;
use super::hostile;

#[test]
fn checking_the_folder_of_another_runs_nothing_of_it_outside_of_the_sandbox() {
    let [folder, outside] = [(); 2].map(|()| TempDir::new().expect("a folder"));
    let (sentinel, left) = (outside.path().join("sentinel"), outside.path().join("left"));
    fs::write(&sentinel, "untouched").expect("a file");
    let listener = TcpListener::bind("127.0.0.1:0").expect("a port");
    listener.set_nonblocking(true).expect("a listener");
    let body = hostile::OUTSIDE
        .replace("SENTINEL", &sentinel.display().to_string())
        .replace("LEFT", &left.display().to_string())
        .replace("ADDRESS", &listener.local_addr().expect("an address").to_string());
    let text = &solutions()["V_linear_tetrahedron"];
    let open = text.find("-> f64 {").expect("its body") + "-> f64 {".len();
    let add = |path: &str, text: &str| {
        let path = folder.path().join(path);
        fs::create_dir_all(path.parent().expect("it has a folder")).expect("a folder");
        fs::write(path, text).expect("a file");
    };
    add("src/V_linear_tetrahedron.rs", &format!("{}\n{body}\n}}\n", &text[..open]));
    // A repository whose parts would be built before anything is checked.
    let build = format!("fn main() {{ std::fs::write({left:?}, \"\").unwrap(); }}");
    add("grader/child/Cargo.toml", "[package]\nname = \"grader-child\"\nversion = \"0.0.0\"\nbuild = \"build.rs\"\n");
    add("grader/child/build.rs", &build);
    add("grader/child/src/lib.rs", "");
    add("src/given/mod.rs", "");
    add("Cargo.toml", "nalgebra = \"1\"\nnalgebra-sparse = \"1\"\n");
    add("Cargo.lock", "version = 4\n");
    let output = Command::new(env!("CARGO_BIN_EXE_grader"))
        .arg("check")
        .arg(folder.path())
        .args(["--only", "V_linear_tetrahedron"])
        .output()
        .expect("the grader starts");
    let said = String::from_utf8_lossy(&output.stdout);
    assert_eq!(output.status.code(), Some(0), "{said}{}", String::from_utf8_lossy(&output.stderr));
    assert!(said.contains("failed") || said.contains("crashed"), "{said}");
    assert_eq!(fs::read_to_string(&sentinel).expect("it is still there"), "untouched");
    assert!(!left.exists());
    assert!(listener.accept().is_err(), "no program called");
}

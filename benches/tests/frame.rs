//! The program's command `frame`.

use std::process::Command;

#[test]
fn a_short_search_gives_a_row_for_every_method_and_law() {
    let output = Command::new(env!("CARGO_BIN_EXE_fem-bench"))
        .args(["frame", "--budget", "0.1", "--frames", "2"])
        .output()
        .expect("the program has been built");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let text = String::from_utf8_lossy(&output.stdout);
    for method in ["semi_implicit_euler", "verlet", "rk4", "linearly_implicit_euler", "implicit_euler"] {
        for law in ["corotated", "stable_neo_hookean"] {
            assert!(text.contains(&format!("| `{method}` | `{law}` |")), "{method}, {law}: no row in\n{text}");
        }
    }
}

#[test]
fn a_budget_that_is_no_duration_and_a_key_that_no_scene_has_are_refused() {
    for (argument, value) in [("--budget", "0"), ("--budget", "nan"), ("--set", "mesh.unknown=1")] {
        let output = Command::new(env!("CARGO_BIN_EXE_fem-bench"))
            .args(["frame", argument, value])
            .output()
            .expect("the program has been built");
        assert_eq!(output.status.code(), Some(2), "{argument} {value}");
    }
}

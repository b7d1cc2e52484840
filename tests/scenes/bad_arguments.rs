//! Arguments that cannot be used: exit code 2 and one message with the remedy.

use crate::program::{Desk, assert_names, course_scenes};
use crate::scene_text::CUBE;

/// Asserts exit code 2 and a message that contains these parts.
fn assert_refused(desk: &Desk, arguments: &str, parts: &[&str]) {
    assert_names(&desk.refused(arguments), parts);
}

#[test]
fn an_unknown_scene_is_refused_with_a_list_of_the_known_ones() {
    let message = Desk::new().refused("nosuch --headless");
    assert_names(&message, &["`nosuch`", ".toml"]);
    for name in course_scenes() {
        assert!(message.contains(&name), "{message}");
    }
}

#[test]
fn a_path_to_no_scene_file_is_refused() {
    let desk = Desk::with("folder/x", "");
    assert_refused(&desk, "nosuch.toml --headless", &["nosuch.toml", "cannot be read", "check the path"]);
    assert_refused(&desk, "./nosuch --headless", &["./nosuch", "check the path"]);
    assert_refused(&desk, "./folder --headless", &["./folder", "cannot be read"]);
    assert_refused(&desk, "folder/ --headless", &["folder/", "cannot be read"]);
    assert_refused(&desk, "folder --headless", &["`folder`", "choose one of"]);
}

#[test]
fn flags_out_of_range_are_refused() {
    let desk = Desk::with("cube.toml", CUBE);
    for value in ["0", "-1", "nan", "inf", "-inf", "1e-999", "1e999", "abc"] {
        assert_refused(&desk, &format!("cube.toml --headless --dt={value}"), &["--dt", value, "a positive number"]);
    }
    for value in ["0", "-3", "x", "1.5", "1e3", "99999999999999999999999"] {
        assert_refused(&desk, &format!("cube.toml --headless --steps={value}"), &["--steps", value, "a whole number"]);
    }
    for value in ["euler", "IMPLICIT_EULER", "implicit"] {
        let known = ["--integrator", value, "linearly_implicit_euler", "implicit_euler", "rk4"];
        assert_refused(&desk, &format!("cube.toml --headless --integrator {value}"), &known);
    }
}

#[test]
fn an_integrator_of_the_engine_is_refused_in_a_course_scene() {
    let desk = Desk::with("cube.toml", CUBE);
    for value in ["explicit_euler", "semi_implicit_euler", "rk2", "rk4", "verlet", "static"] {
        let parts = ["cube.toml", "time.integrator", value, "use linearly_implicit_euler or implicit_euler"];
        assert_refused(&desk, &format!("cube.toml --headless --integrator {value}"), &parts);
    }
}

#[test]
fn unknown_and_incomplete_flags_are_refused() {
    let desk = Desk::with("cube.toml", CUBE);
    assert_refused(&desk, "cube.toml --headles", &["--headles", "--headless"]);
    assert_refused(&desk, "cube.toml --frobnicate", &["--frobnicate", "--help"]);
    assert_refused(&desk, "cube.toml --steps", &["--steps", "--help"]);
    assert_refused(&desk, "cube.toml --headless --headless", &["--headless", "--help"]);
    assert_refused(&desk, "cube.toml other.toml --headless", &["other.toml", "--help"]);
    assert_refused(&desk, "list --headless", &["--headless", "--help"]);
}

#[test]
fn output_files_that_cannot_be_written_are_refused_before_the_first_step() {
    let desk = Desk::with("cube.toml", CUBE);
    desk.write("folder/x", "");
    for (flag, name) in [("state", "q.json"), ("stats", "s.json"), ("energies", "e.csv"), ("export", "x.obj")] {
        let run = format!("cube.toml --headless --{flag}");
        assert_refused(&desk, &format!("{run} nowhere/{name}"), &[&format!("--{flag}"), "nowhere/", "does not exist"]);
        assert_refused(&desk, &format!("{run} folder"), &[&format!("--{flag}"), "folder", "is a folder"]);
        assert_refused(&desk, &format!("{run} folder/.."), &[&format!("--{flag}"), "is a folder"]);
        assert_refused(&desk, &format!("{run} cube.toml/{name}"), &[&format!("--{flag}"), "its folder does not exist"]);
    }
    assert_refused(&desk, "cube.toml --headless --screenshot nowhere/a.png", &["--screenshot", "does not exist"]);
}

#[test]
fn an_unknown_export_format_is_refused_with_the_known_ones() {
    let desk = Desk::with("cube.toml", CUBE);
    for name in ["x.stl", "x", "x.OBJX", "obj", ".obj"] {
        assert_refused(&desk, &format!("cube.toml --headless --export {name}"), &["--export", ".obj, .vtu, .glb"]);
    }
}

#[test]
fn meshes_that_cannot_be_read_or_written_are_refused() {
    let desk = Desk::with("nonsense.msh", b"\x00\xff\x13garbage");
    desk.write("good.node", "4 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n");
    desk.write("good.ele", "1 4 0\n0 0 1 2 3\n");
    desk.write("flat.node", "4 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 1 1 0\n");
    desk.write("flat.ele", "1 4 0\n0 0 1 2 3\n");
    assert_refused(&desk, "mesh info nonsense.msh", &["nonsense.msh"]);
    assert_refused(&desk, "mesh info nosuch.mesh", &["nosuch.mesh", "no such file"]);
    assert_refused(&desk, "mesh info cube.toml", &["cube.toml", "`.toml` is unknown", ".node with .ele"]);
    assert_refused(&desk, "mesh info flat.node", &["flat.node", "element 0", "no volume"]);
    assert_refused(&desk, "mesh convert good.node x.stl", &["x.stl", "a mesh of tetrahedra in a .stl file", ".vtu"]);
    assert_refused(&desk, "mesh convert good.node nowhere/x.vtu", &["nowhere/x.vtu", "check that the folder exists"]);
    assert_refused(&desk, "mesh convert flat.node x.vtu", &["flat.node", "element 0"]);
    assert_refused(&desk, "mesh info", &["FILE", "--help"]);
    assert!(!desk.path("x.vtu").exists() && !desk.path("x.stl").exists());
}

#[test]
fn two_options_with_the_same_output_file_are_refused() {
    let desk = Desk::with("cube.toml", CUBE);
    let arguments = "cube.toml --headless --state x.json --stats x.json";
    assert_refused(&desk, arguments, &["--state and --stats", "x.json", "give each its own"]);
}

//! Overrides: the scene that they give is the one that the file with these values gives, and errors name them.

use std::path::Path;

use fem_scene::{Override, Scene, SceneError, load_with};
use tempfile::TempDir;

use crate::{LEAST, edit, read};

/// The least scene with some keys overridden.
fn overridden(overrides: &[&str]) -> Result<Scene, SceneError> {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("name.toml");
    std::fs::write(&path, LEAST).unwrap();
    let overrides: Vec<Override> = overrides.iter().map(|text| text.parse().unwrap()).collect();
    load_with(path.to_str().unwrap(), folder.path(), &overrides)
}

/// The tables alone, without name, path and the way they came about.
fn tables(scene: Scene) -> Scene {
    Scene { path: Default::default(), overrides: Vec::new(), source: Default::default(), ..scene }
}

fn assert_same(overrides: &[&str], text: &str) {
    assert_eq!(tables(overridden(overrides).unwrap()), tables(read(text)), "{overrides:?}");
}

fn assert_refused(overrides: &[&str], parts: &[&str]) {
    let message = overridden(overrides).unwrap_err().to_string();
    for part in parts {
        assert!(message.contains(part), "`{part}` is not in: {message}");
    }
}

#[test]
fn a_value_is_that_of_the_file_with_it() {
    assert_same(&["time.dt=0.002"], &edit(LEAST, "0.01", "0.002"));
    assert_same(&[" time . dt = 0.002 "], &edit(LEAST, "0.01", "0.002"));
    assert_same(&["material.C=1", "material.C=2e5"], &edit(LEAST, "C = 1e5", "C = 2e5"));
    assert_same(&["mesh.box.size=[1, 1, 3]"], &edit(LEAST, "[2, 1, 1]", "[1, 1, 3]"));
}

#[test]
fn a_bare_word_is_a_string() {
    let rk4 = edit(LEAST, "\"implicit_euler\"", "\"rk4\"");
    assert_same(&["time.integrator=rk4"], &rk4);
    assert_same(&["time.integrator=\"rk4\""], &rk4);
    assert_same(&["pipeline=engine"], &edit(LEAST, "\"course\"", "\"engine\""));
    assert_same(&["about=a = b"], &format!("about = \"a = b\"\n{LEAST}"));
}

#[test]
fn tables_and_entries_that_are_missing_are_added() {
    let gravity = format!("{LEAST}[gravity]\nacceleration = [0, -9.81, 0]\n");
    assert_same(&["gravity.acceleration=[0, -9.81, 0]"], &gravity);
    let springs = format!("{LEAST}[[springs]]\nnodes = [0, 3]\nstiffness = 5\n");
    assert_same(&["springs.0.nodes=[0, 3]", "springs.0.stiffness=5"], &springs);
    assert_same(&["springs=[{nodes = [0, 3], stiffness = 1}]", "springs.0.stiffness=5"], &springs);
}

#[test]
fn what_is_no_override_is_refused() {
    for text in ["time.dt", "=5", "time.=5", "..=1"] {
        let error = text.parse::<Override>().unwrap_err();
        assert!(error.contains("TABLE.KEY=VALUE"), "{text}: {error}");
    }
}

#[test]
fn an_error_names_the_override_that_causes_it() {
    assert_refused(&["time.dt=-1"], &["--set time.dt=-1: ", "time.dt is -1; give a positive number"]);
    assert_refused(&["time.dt=fast", "material.C=2"], &["--set time.dt=fast: ", "expected", "correct this value"]);
    assert_refused(&["time.step=1"], &["--set time.step=1: ", "unknown field `step`"]);
    assert_refused(&["mesh.file=a.msh"], &["line 3: mesh.box stands beside `file`"]);
    assert_refused(&["time.dt.x=1"], &["--set time.dt.x=1: ", "time.dt is a value without keys; remove `.x`"]);
    assert_refused(&["mesh.box.size.3.x=1"], &["--set mesh.box.size.3.x=1: "]);
    assert_refused(&["mesh.box.size.7=1"], &["mesh.box.size has 3 entries; give a number up to 3"]);
    assert_refused(&["mesh.box.size.x=1"], &["mesh.box.size is an array; give the number of an entry"]);
}

#[test]
fn a_problem_of_the_file_itself_keeps_its_line() {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("name.toml");
    std::fs::write(&path, edit(LEAST, "dt = 0.01", "dt = \"x\"")).unwrap();
    let change = ["material.C=2".parse().unwrap()];
    let error = load_with(path.to_str().unwrap(), folder.path(), &change).unwrap_err();
    assert!(matches!(error, SceneError::Line { line: 10, .. }), "{error:?}");
}

#[test]
fn an_error_of_the_body_names_the_override_too() {
    let scene = overridden(&["fixed.nodes=[0, 900]"]).unwrap();
    let message = fem_scene::body(&scene, Path::new("no data")).unwrap_err().to_string();
    assert!(message.starts_with("--set fixed.nodes=[0, 900]: fixed.nodes"), "{message}");
    let scene = overridden(&["mesh.box.cells_per_unit=0"]).unwrap();
    let message = fem_scene::body(&scene, Path::new("no data")).unwrap_err().to_string();
    assert!(message.starts_with("--set mesh.box.cells_per_unit=0: mesh.box"), "{message}");
}

#[test]
fn a_changed_scene_is_that_of_the_file_with_the_values() {
    let scene = read(LEAST);
    let changed = scene.changed(&["material.C=2e5".parse().unwrap()]).unwrap();
    assert_eq!(tables(changed.clone()), tables(read(&edit(LEAST, "C = 1e5", "C = 2e5"))));
    let again = changed.changed(&["material.density=7".parse().unwrap()]).unwrap();
    assert_eq!((again.material.C, again.material.density), (Some(2e5), 7.0));
    assert_eq!(again.overrides.len(), 2);
}

#[test]
fn a_change_keeps_another_time_step_and_integrator_than_the_files() {
    let mut scene = read(LEAST);
    scene.time.dt = Some(0.003);
    scene.time.integrator = fem_model::Integrator::LinearlyImplicitEuler;
    let changed = scene.changed(&["material.density=7".parse().unwrap()]).unwrap();
    assert_eq!((changed.time.dt, changed.time.integrator), (scene.time.dt, scene.time.integrator));
    assert_eq!(scene.changed(&["time.dt=0.5".parse().unwrap()]).unwrap().time.dt, Some(0.5));
}

#[test]
fn a_change_that_is_refused_names_the_field_without_a_place() {
    let error = read(LEAST).changed(&["material.density=-1".parse().unwrap()]).unwrap_err();
    assert!(error.problem().starts_with("material.density is -1"), "{}", error.problem());
}

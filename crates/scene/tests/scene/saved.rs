//! Saved scenes: the text of a scene reads back to the same scene, and its file finds the same meshes.

use std::path::{Path, PathBuf};

use fem_model::Integrator;
use fem_scene::{Override, Scene, body, load, names, parse, save};
use tempfile::TempDir;

use crate::{LEAST, data, edit, read};

fn changed(scene: &Scene, changes: &[&str]) -> Scene {
    let change = |text: &&str| match text.strip_prefix('-') {
        Some(path) => Override::without(path),
        None => text.parse().unwrap(),
    };
    scene.changed(&changes.iter().map(change).collect::<Vec<_>>()).unwrap()
}

fn assert_reads_back(scene: &Scene) {
    let text = scene.to_text();
    let again = parse(&text, &scene.path).unwrap_or_else(|error| panic!("{error}\n{text}"));
    assert!(has_same_tables(&again, scene), "{}:\n{text}", scene.name);
}

/// Returns true if all tables and keys are the same, whatever the file and the overrides that gave them.
fn has_same_tables(a: &Scene, b: &Scene) -> bool {
    let bare = |scene: &Scene| {
        let scene = scene.clone();
        Scene { name: String::new(), path: PathBuf::new(), source: toml::Table::new(), overrides: Vec::new(), ..scene }
    };
    bare(a) == bare(b)
}

#[test]
fn the_text_of_every_shipped_scene_reads_back_to_the_scene() {
    let names = names(&data());
    assert!(!names.is_empty());
    names.iter().for_each(|name| assert_reads_back(&load(name, &data()).unwrap()));
}

#[test]
fn a_scene_with_painted_nodes_loaded_faces_and_another_solver_reads_back() {
    let scene = read(&edit(LEAST, "\"course\"", "\"engine\""));
    let nodes: Vec<usize> = (0..400).collect();
    let faces: Vec<[usize; 3]> = (0..90).map(|i| [i, i + 1, 1000 - i]).collect();
    let scene = changed(
        &scene,
        &[
            &format!("fixed={{nodes={nodes:?}}}"),
            &format!("traction.0={{faces={faces:?}, pressure=-1e-7}}"),
            "traction.1={edges=[[0, 1], [5, 4]], force_per_area=[0, 0.1, 0]}",
            "prescribed.0={nodes=[7], velocity=[0.1, 0, 0]}",
            "solver={kind=\"pcg\", preconditioner=\"ssor\", tolerance=1e-9}",
            "newton.max_iterations=3",
            "fibres.0={on=\"all\", modulus=1e4, around={axis=[0, 0, 1], angle=30}}",
        ],
    );
    assert_reads_back(&scene);
    let text = scene.to_text();
    assert!(text.lines().all(|line| line.len() < 130), "{text}");
    assert!(text.contains("\n[fixed] # 400 nodes\n") && text.contains("\n[[traction]] # 90 faces\n"), "{text}");
    assert_eq!(scene.fixed.unwrap().nodes.unwrap().len(), 400);
}

#[test]
fn another_integrator_time_step_and_number_of_steps_than_the_files_are_saved() {
    let mut scene = read(&format!("{LEAST}[newton]\nmax_iterations = 4\n").replace("\"course\"", "\"engine\""));
    scene.time.integrator = Integrator::Verlet;
    (scene.time.dt, scene.time.steps) = (Some(1e-3), Some(7));
    assert_eq!(scene.remove_unused_tables(), ["newton"]);
    assert_reads_back(&scene);
}

#[test]
fn a_table_or_an_entry_can_be_removed_and_one_that_is_not_there_stays_away() {
    let scene = read(&format!("{LEAST}[fixed]\nnodes = [3]\n[[springs]]\nnodes = [0, 1]\nstiffness = 1\n"));
    let without = changed(&scene, &["-fixed", "-springs.0", "-springs.7", "-solver.kind", "-traction.0.pressure"]);
    assert!(without.fixed.is_none() && without.springs.is_empty() && without.solver.is_none());
    assert!(has_same_tables(&without, &read(LEAST)));
    assert_reads_back(&without);
}

#[test]
fn a_later_override_of_the_same_key_takes_the_place_of_the_earlier_one() {
    let scene = changed(&read(LEAST), &["fixed.nodes=[1]", "material.density=2"]);
    let scene = changed(&scene, &["fixed={nodes=[2]}"]);
    let texts: Vec<String> = scene.overrides.iter().map(Override::to_string).collect();
    assert_eq!(texts, ["material.density=2", "fixed={nodes=[2]}"]);
}

/// A flat body from a picture.
fn flat(picture: &str) -> String {
    let text = edit(
        LEAST,
        "box = { size = [2, 1, 1], cells_per_unit = 1 }",
        &format!("picture = {{ file = {picture:?}, edge = 0.2 }}"),
    );
    edit(&edit(&text, "\"course\"", "\"engine\""), "C = 1e5\nD = 4e5\n", "young = 1e5\npoisson = 0.3\n")
}

#[test]
fn a_saved_scene_finds_the_files_that_lie_beside_the_old_one() {
    let (old, new) = (TempDir::new().unwrap(), TempDir::new().unwrap());
    std::fs::copy(data().join("pictures/square.png"), old.path().join("own.png")).unwrap();
    let path = old.path().join("own.toml");
    let scene = parse(&flat("own.png"), &path).unwrap();
    let saved = new.path().join("again.toml");
    save(&scene, &saved, &data()).unwrap();
    let again = load(saved.to_str().unwrap(), &data()).unwrap();
    assert_eq!(body(&again, &data()).unwrap().shape.mesh, body(&scene, &data()).unwrap().shape.mesh);
    assert_ne!(again.mesh, scene.mesh, "the path is absolute");
    let beside = old.path().join("again.toml");
    save(&scene, &beside, &data()).unwrap();
    assert!(has_same_tables(&load(beside.to_str().unwrap(), &data()).unwrap(), &scene));
    let shipped = parse(&flat("pictures/square.png"), &data().join("scenes/square.toml")).unwrap();
    save(&shipped, &new.path().join("square.toml"), &data()).unwrap();
    let text = std::fs::read_to_string(new.path().join("square.toml")).unwrap();
    assert!(text.contains("\"pictures/square.png\""), "a file in data is found from everywhere: {text}");
}

#[test]
fn a_file_that_exists_is_not_replaced_and_unusable_paths_are_refused() {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("a.toml");
    save(&read(LEAST), &path, &data()).unwrap();
    let refused = |path: &Path| save(&read(LEAST), path, &data()).unwrap_err().to_string();
    assert!(refused(&path).contains("exists already"));
    assert!(refused(&folder.path().join("a.txt")).contains("end in .toml"));
    assert!(refused(&folder.path().join("none/a.toml")).contains("make the folder first"));
}

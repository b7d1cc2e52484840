//! Tests of scenes that are set up by hand and saved while their simulation runs.

use super::editing_tests::{SCENE, start};
use super::tests::wait_for;
use super::*;
use crate::editing::change::Edit;
use crate::editing::edits::{self, Force};

fn scene() -> Scene {
    fem_scene::parse(SCENE, "fake.toml".as_ref()).unwrap()
}

fn edit(worker: &Worker, edit: Edit) {
    worker.send(Command::Change(vec![Change::Edit(edit)]));
}

#[test]
fn painted_nodes_start_the_motion_again_and_loads_do_not() {
    let (worker, _) = start(0.0);
    let before = wait_for(&worker, "some steps on", |s| s.steps >= 10);
    let solver = fem_scene::tables::SolverTable {
        kind: fem_model::SolverKind::Pcg,
        tolerance: None,
        preconditioner: None,
        precision: None,
    };
    edit(&worker, edits::of_method("solver", Some(&solver)));
    let after = wait_for(&worker, "with another solver", |s| s.changes == 1 && !s.is_building);
    assert!(after.steps >= before.steps, "{}", after.steps);
    let motion = Some((edits::Motion::Velocity, [0.0, 0.0, 1.0]));
    edit(&worker, edits::prescribed(0, &[1], motion));
    let again = wait_for(&worker, "with a prescribed motion", |s| s.changes == 2 && !s.is_building);
    assert!(again.refusal.is_none() && again.steps < before.steps, "{:?}", again.refusal);
    let scene = worker.finish().scene.unwrap();
    assert!(scene.solver.is_some() && scene.prescribed.len() == 1);
}

#[test]
fn a_saved_scene_has_the_changes_and_the_parameters_of_the_simulation() {
    let folder = std::env::temp_dir().join(format!("fem-viewer-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let path = folder.join("saved.toml");
    let _ = std::fs::remove_file(&path);
    let (worker, _) = start(0.0);
    edit(&worker, edits::fixed(&scene(), &[2, 3]));
    worker.send(Command::Save(path.clone()));
    let saved = wait_for(&worker, "saved", |s| s.saved.is_some());
    assert_eq!(saved.saved, Some(Ok(path.clone())));
    let again = fem_scene::load(path.to_str().unwrap(), &folder).unwrap();
    assert_eq!(again.fixed.unwrap().nodes, Some(vec![2, 3]));
    worker.send(Command::Save(path.clone()));
    let refused = wait_for(&worker, "refused", |s| matches!(s.saved, Some(Err(_))));
    assert!(refused.saved.unwrap().unwrap_err().contains("exists already"));
    assert!(refused.stop.is_none());
    std::fs::remove_dir_all(folder).unwrap();
}

#[test]
fn another_mesh_is_refused_while_nodes_are_listed_by_their_numbers() {
    let (worker, _) = start(0.0);
    edit(&worker, edits::fixed(&scene(), &[2]));
    worker.send(Command::Change(vec![Change::Number("cells", 2.0)]));
    let refused = wait_for(&worker, "refused", |s| s.refusal.is_some());
    assert!(refused.refusal.unwrap().contains("erase the painted nodes first"));
    edit(&worker, edits::fixed(&scene(), &[]));
    worker.send(Command::Change(vec![Change::Number("cells", 2.0)]));
    wait_for(&worker, "accepted", |s| s.changes == 4 && !s.is_building && s.refusal.is_none());
}

#[test]
fn an_edit_that_the_scene_refuses_has_a_message_and_leaves_the_run_as_it_is() {
    let (worker, _) = start(0.0);
    edit(&worker, edits::load(&scene(), 0, &[&[0, 1, 2]], Force::Pressure(f64::INFINITY)));
    let refused = wait_for(&worker, "refused", |s| s.refusal.is_some());
    wait_for(&worker, "going on", |s| s.steps > refused.steps + 2);
    assert!(worker.finish().scene.unwrap().traction.is_empty());
}

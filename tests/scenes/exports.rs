//! Exports of the final mesh and of series.

use std::fs;

use fem_mesh::{read_surface, read_tetrahedra};
use fem_model::simulation::Simulation;

use crate::program::{Desk, course_scenes};
use crate::scene_text::{CUBE, build, parse, shipped};

/// The fields of a `.vtu`.
const FIELDS: [&str; 9] = [
    "displacement",
    "velocity",
    "nodal_force",
    "stress_averaged",
    "stress_volume_averaged",
    "stress",
    "von_mises",
    "strain",
    "J",
];

#[test]
fn an_obj_export_contains_the_deformed_display_surface() {
    for name in course_scenes() {
        let desk = Desk::new();
        desk.run_well(&format!("{name} --headless --steps 3 --export x.obj"));
        let found = read_surface(&desk.path("x.obj")).unwrap();
        let mut simulation = build(&shipped(&name));
        (0..3).for_each(|_| simulation.step().unwrap());
        assert_eq!(found.vertices, simulation.display_positions(), "{name}");
        assert_eq!(found.elements, simulation.shape().display.as_ref().unwrap().elements, "{name}");
    }
}

#[test]
fn an_obj_export_without_a_display_surface_contains_the_boundary_of_the_mesh() {
    let desk = Desk::with("cube.toml", CUBE);
    desk.run_well("cube.toml --headless --export x.obj");
    let found = read_surface(&desk.path("x.obj")).unwrap();
    let mut simulation = build(&parse(CUBE));
    (0..4).for_each(|_| simulation.step().unwrap());
    assert_eq!(found.vertices, simulation.display_positions());
    assert_eq!(found.elements, simulation.shape().boundary);
}

#[test]
fn a_vtu_export_contains_the_simulation_mesh_and_its_fields() {
    for name in course_scenes() {
        let desk = Desk::new();
        desk.run_well(&format!("{name} --headless --steps 3 --export x.vtu"));
        assert_eq!(
            read_tetrahedra(&desk.path("x.vtu")).unwrap(),
            build(&shipped(&name)).shape().mesh.mesh().unwrap(),
            "{name}"
        );
        let text = desk.read("x.vtu");
        for field in FIELDS {
            assert!(text.contains(&format!("Name=\"{field}\"")), "{name}: {field}");
        }
    }
}

#[test]
fn a_glb_export_is_a_complete_gltf_2_file_with_animation() {
    for name in course_scenes() {
        let desk = Desk::new();
        desk.run_well(&format!("{name} --headless --steps 8 --export x.glb"));
        let bytes = fs::read(desk.path("x.glb")).unwrap();
        let word = |at: usize| u32::from_le_bytes(bytes[at..at + 4].try_into().unwrap());
        assert_eq!(&bytes[..4], b"glTF");
        assert_eq!((word(4), word(8) as usize), (2, bytes.len()), "{name}");
        let json: serde_json::Value = serde_json::from_slice(&bytes[20..20 + word(12) as usize]).unwrap();
        assert!(json["animations"].is_array(), "{name}: the motion is missing");
    }
}

#[test]
fn an_export_leaves_no_unfinished_file_behind() {
    let desk = Desk::with("cube.toml", CUBE);
    desk.run_well("cube.toml --headless --export x.vtu --state q.json --stats s.json --energies e.csv");
    let mut names: Vec<_> = fs::read_dir(desk.path("")).unwrap().map(|entry| entry.unwrap().file_name()).collect();
    names.sort();
    assert_eq!(names, ["cube.toml", "e.csv", "q.json", "s.json", "x.vtu"]);
}

#[test]
fn a_series_contains_every_nth_state_the_last_one_and_a_list_of_their_times() {
    let desk = Desk::with("cube.toml", CUBE);
    desk.run_well("cube.toml --headless --steps 5 --vtu-series out/cube --every 2 --export last.vtu");
    let mut names: Vec<_> =
        fs::read_dir(desk.path("out/cube")).unwrap().map(|entry| entry.unwrap().file_name()).collect();
    names.sort();
    assert_eq!(names, ["cube.pvd", "cube_000000.vtu", "cube_000002.vtu", "cube_000004.vtu", "cube_000005.vtu"]);
    let list = desk.read("out/cube/cube.pvd");
    let times = ["0.0", "0.02", "0.04", "0.05"].map(|time| format!("timestep=\"{time}\""));
    for (time, file) in times.iter().zip(&names[1..]) {
        let line = list.lines().find(|line| line.contains(file.to_str().unwrap())).unwrap();
        assert!(line.contains(time), "{line}");
    }
    desk.run_well("cube.toml --headless --steps 4 --export last.vtu");
    assert_eq!(desk.read("out/cube/cube_000004.vtu"), desk.read("last.vtu"), "a file of the series is an export");
}

#[test]
fn a_series_writes_every_step_by_default_and_opens_no_window() {
    let desk = Desk::with("cube.toml", CUBE);
    desk.run_well("cube.toml --steps 2 --vtu-series out");
    assert_eq!(fs::read_dir(desk.path("out")).unwrap().count(), 4);
}

#[test]
fn a_series_that_cannot_be_written_is_refused_before_the_first_step() {
    let desk = Desk::with("cube.toml", CUBE);
    let message = desk.refused("cube.toml --headless --vtu-series cube.toml");
    assert!(message.contains("--vtu-series cube.toml: is a file; give the name of a folder"), "{message}");
    assert!(desk.refused("cube.toml --headless --every 2").contains("--vtu-series"));
    assert!(desk.refused("cube.toml --headless --vtu-series out --every 0").contains("--every"));
}

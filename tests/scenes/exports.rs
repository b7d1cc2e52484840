//! The final mesh as other programs read it.

use std::fs;

use fem_engine::mesh::{read_surface, read_tetrahedra};
use fem_engine::simulation::Simulation;

use crate::program::{Desk, shipped_scenes};
use crate::scene_text::{CUBE, build, parse, shipped};

#[test]
fn an_obj_of_a_shipped_scene_holds_its_display_surface_where_it_is_at_the_end() {
    for name in shipped_scenes() {
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
fn a_scene_without_a_display_surface_exports_the_boundary_of_its_mesh() {
    let desk = Desk::with("cube.toml", CUBE);
    desk.run_well("cube.toml --headless --export x.obj");
    let found = read_surface(&desk.path("x.obj")).unwrap();
    let mut simulation = build(&parse(CUBE));
    (0..4).for_each(|_| simulation.step().unwrap());
    assert_eq!(found.vertices, simulation.display_positions());
    assert_eq!(found.elements, simulation.shape().boundary);
}

#[test]
fn a_vtu_of_a_shipped_scene_holds_its_simulation_mesh_and_the_fields() {
    for name in shipped_scenes() {
        let desk = Desk::new();
        desk.run_well(&format!("{name} --headless --steps 3 --export x.vtu"));
        assert_eq!(read_tetrahedra(&desk.path("x.vtu")).unwrap(), build(&shipped(&name)).shape().mesh, "{name}");
        let text = desk.read("x.vtu");
        for field in ["displacement (m)", "velocity (m/s)", "Cauchy stress (Pa)", "von Mises stress (Pa)"] {
            assert!(text.contains(&format!("\"{field}\"")), "{name}: {field}");
        }
    }
}

#[test]
fn a_glb_of_a_shipped_scene_is_a_complete_file_of_gltf_2() {
    for name in shipped_scenes() {
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

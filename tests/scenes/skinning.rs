//! The display surface follows the tetrahedra.

use fem_model::simulation::Simulation;
use fem_scene::body;
use finite_elements_3d::build_skinning_matrix;

use crate::program::{Desk, course_scenes, data};
use crate::scene_text::{CUBE, build, edit, shipped};

#[test]
fn display_positions_at_rest_are_those_of_the_file() {
    for name in course_scenes() {
        let simulation = build(&shipped(&name));
        let shape = simulation.shape();
        let expected = &shape.display.as_ref().unwrap().vertices;
        for (found, expected) in simulation.display_positions().iter().zip(expected) {
            assert!((found - expected).amax() <= 1e-9, "{name}: {found} instead of {expected}");
        }
    }
}

#[test]
fn skinning_weights_of_shipped_scenes_are_not_negative_and_sum_to_one() {
    for name in course_scenes() {
        let shape = body(&shipped(&name), &data()).unwrap().shape;
        let display = &shape.display.as_ref().unwrap().vertices;
        let N = build_skinning_matrix(shape.mesh.vertices(), shape.mesh.tetrahedra(), display);
        assert_eq!((N.nrows(), N.ncols()), (display.len(), shape.mesh.vertices().len()), "{name}");
        for (vertex, row) in N.row_iter().enumerate() {
            assert!(row.values().iter().all(|&weight| weight >= -1e-6), "{name}: vertex {vertex}: {:?}", row.values());
            let sum: f64 = row.values().iter().sum();
            assert!((sum - 1.0).abs() <= 1e-12, "{name}: vertex {vertex} has weights of {sum} together");
        }
        assert_eq!(build(&shipped(&name)).display_vertices_outside(), 0, "{name}");
    }
}

#[test]
fn a_warning_counts_display_vertices_outside_the_tetrahedra() {
    let desk = Desk::with("cube.toml", edit(CUBE, "[mesh]\n", "[mesh]\ndisplay = \"surface.obj\"\n"));
    desk.write("surface.obj", "v 0.5 0.5 0.5\nv 1.5 0.5 0.5\nv 0.5 -0.2 0.5\nv 1 1 1\nf 1 2 3\nf 1 3 4\n");
    let outcome = desk.run("cube.toml --headless --export x.obj");
    assert_eq!(outcome.code, Some(0), "{outcome:?}");
    assert_eq!(outcome.stderr.lines().count(), 1, "{}", outcome.stderr);
    for part in ["warning: cube.toml: mesh.display: 2 vertices lie outside", "use a cage"] {
        assert!(outcome.stderr.contains(part), "{}", outcome.stderr);
    }
    assert!(desk.path("x.obj").exists());
}

//! Unusual scenes that must work.

use fem_model::simulation::{Interactive, Simulation};

use crate::program::{Desk, assert_names};
use crate::scene_text::{CUBE, INTEGRATORS, build_with, edit, without};

/// The cube's scene with the mesh `m.node` in place of the box.
fn with_mesh_file(text: &str) -> String {
    edit(text, "box = { size = [1, 1, 1], cells_per_unit = 2 }", "file = \"m.node\"")
}

fn desk_with_mesh(text: &str, nodes: &str, elements: &str) -> Desk {
    let desk = Desk::with("scene.toml", with_mesh_file(text));
    desk.write("m.node", nodes);
    desk.write("m.ele", elements);
    desk
}

fn assert_runs(desk: &Desk) {
    for integrator in INTEGRATORS {
        let outcome = desk.run_well(&format!("scene.toml --headless --integrator {}", integrator.name()));
        assert!(outcome.stdout.contains(": 4 steps") && !outcome.stdout.contains("NaN"), "{}", outcome.stdout);
    }
}

/// Asserts that the scene runs with one warning, which contains these parts.
fn assert_warns(desk: &Desk, parts: &[&str]) {
    let outcome = desk.run("scene.toml --headless");
    assert_eq!(outcome.code, Some(0), "{outcome:?}");
    assert!(outcome.stderr.starts_with("warning: scene.toml: "), "{outcome:?}");
    assert_names(&outcome.stderr, parts);
}

#[test]
fn a_body_of_fixed_nodes_does_not_move() {
    let text = edit(CUBE, "below = 0.1", "below = 1.0");
    assert_runs(&Desk::with("scene.toml", &text));
    for integrator in INTEGRATORS {
        let mut simulation = build_with(&text, integrator);
        let rest = simulation.positions();
        (0..3).for_each(|_| simulation.step().unwrap());
        simulation.set_parameter("density", 500.0).unwrap();
        simulation.reset();
        simulation.step().unwrap();
        assert_eq!(simulation.positions(), rest);
    }
}

#[test]
fn repeated_and_unsorted_fixed_nodes_count_once() {
    let build = |list: &str| {
        let text = edit(CUBE, "plane = { axis = \"y\", below = 0.1 }", &format!("nodes = {list}"));
        build_with(&text, INTEGRATORS[0])
    };
    let (mut one, mut other) = (build("[2, 0, 18, 0, 2]"), build("[0, 2, 18]"));
    one.step().unwrap();
    other.step().unwrap();
    assert_eq!(one.positions(), other.positions());
}

#[test]
fn a_drag_does_not_move_a_fixed_node() {
    let mut simulation = build_with(&edit(CUBE, "vertex = \"highest\"", "vertex = 0"), INTEGRATORS[1]);
    (0..4).for_each(|_| simulation.step().unwrap());
    assert_eq!(simulation.positions().as_slice()[..3], [0.0; 3]);
}

#[test]
fn a_single_tetrahedron_runs() {
    assert_runs(&desk_with_mesh(CUBE, "4 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n", "1 4 0\n0 0 1 2 3\n"));
}

#[test]
fn the_smallest_box_runs() {
    assert_runs(&Desk::with("scene.toml", edit(CUBE, "cells_per_unit = 2", "cells_per_unit = 1")));
}

#[test]
fn disconnected_parts_run() {
    let nodes = "8 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n4 5 0 0\n5 6 0 0\n6 5 1 0\n7 5 0 1\n";
    let elements = "2 4 0\n0 0 1 2 3\n1 4 5 6 7\n";
    for text in [CUBE.to_owned(), without(CUBE, "fixed")] {
        assert_runs(&desk_with_mesh(&text, nodes, elements));
    }
    let plane = "plane = { axis = \"y\", below = 0.1 }";
    let desk = desk_with_mesh(&edit(CUBE, plane, "nodes = [0, 1, 3]"), nodes, elements);
    assert_warns(&desk, &["1 of 2 connected parts have no Dirichlet condition", "the first with node 4"]);
}

#[test]
fn coincident_vertices_run() {
    // Two tetrahedra with a common face, each with its own copy of that face's vertices.
    let nodes = "8 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n4 0 0 0\n5 0 1 0\n6 1 0 0\n7 0 0 -1\n";
    let desk = desk_with_mesh(CUBE, nodes, "2 4 0\n0 0 1 2 3\n1 4 5 6 7\n");
    assert_warns(&desk, &["mesh: 3 nodes lie at the place of another one, the first are 0 and 4"]);
}

#[test]
fn a_scene_with_a_byte_order_mark_and_windows_line_ends_is_read() {
    let text = format!("\u{feff}{}", CUBE.replace('\n', "\r\n"));
    assert_runs(&Desk::with("scene.toml", text));
}

#[test]
fn a_drag_of_zero_amplitude_or_zero_frequency_runs() {
    for (from, to) in [("amplitude = 0.2", "amplitude = 0"), ("frequency = 1.0", "frequency = 0")] {
        assert_runs(&Desk::with("scene.toml", edit(CUBE, from, to)));
    }
}

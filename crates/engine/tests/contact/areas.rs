//! The area with which a node bears on a plane: that of the faces around it which look at the plane.

use fem_model::element::shares::face_shares;
use fem_model::simulation::{Diagnostics, Simulation};

use crate::{CUBE, build, floor, run, text};

/// A body of ν = 0 that moves along y alone, pressed onto the floor by 100 Pa; at rest.
fn pressed(mesh: &str) -> impl Simulation {
    let tables = "[[prescribed]]\non = \"all\"\ncomponents = [\"x\", \"z\"]\ndisplacement = [0, 0, 0]\n\
                  [[traction]]\non = { axis = \"y\", side = \"max\", within = 1e-9 }\nforce_per_area = [0, -100, 0]\n\
                  [damping]\nalpha = 5\nbeta = 0.01\n";
    let tables = tables.replace(", \"z\"", if mesh.starts_with("rectangle") { "" } else { ", \"z\"" });
    let text = text(mesh, "linear", 1e5, "implicit_euler", 0.05, &(tables + &floor(-5e-4, "")));
    let mut simulation = build(&text.replace("poisson = 0.3", "poisson = 0").replace("density = 1000", "density = 1"));
    run(&mut simulation, 200);
    simulation
}

#[test]
fn a_pressed_body_of_uniform_stress_has_a_uniform_pressure_up_to_the_edges_of_its_touching_face() {
    for (mesh, nodes) in [
        ("rectangle = { size = [1, 1], cells_per_unit = 8 }", 9),
        ("rectangle = { size = [1, 1], cells_per_unit = 2 }\norder = 2", 5),
        (CUBE, 9),
    ] {
        let simulation = pressed(mesh);
        let (shape, forces) = (simulation.shape(), simulation.contact_forces().unwrap());
        let (vertices, mut areas) = (shape.mesh.vertices(), vec![0.0; shape.mesh.vertices().len()]);
        let shares = face_shares(shape.mesh.element());
        for face in shape.faces().iter().filter(|face| face.iter().all(|&node| vertices[node].y == 0.0)) {
            let area = shape.mesh.area(face);
            face.iter().zip(&shares).for_each(|(&node, share)| areas[node] += share * area);
        }
        assert_eq!(areas.iter().filter(|area| **area > 0.0).count(), nodes, "{mesh}");
        for (node, area) in areas.iter().enumerate() {
            let force = forces[3 * node + 1];
            assert!((force - 100.0 * area).abs() < 1e-6 * 100.0 * area + 1e-9, "{mesh}: node {node}: {force} N");
        }
    }
}

#[test]
fn a_pressed_body_of_quadratic_tetrahedra_is_carried_at_the_middles_of_the_sides_of_its_touching_faces() {
    let simulation = pressed("box = { size = [1, 1, 1], cells_per_unit = 2 }\norder = 2");
    let (shape, forces) = (simulation.shape(), simulation.contact_forces().unwrap());
    let (vertices, mut areas) = (shape.mesh.vertices(), vec![0.0; shape.mesh.vertices().len()]);
    for face in shape.faces().iter().filter(|face| face.iter().all(|&node| vertices[node].y == 0.0)) {
        face[3..].iter().for_each(|&node| areas[node] += shape.mesh.area(face) / 3.0);
    }
    assert_eq!(areas.iter().filter(|area| **area > 0.0).count(), 16);
    let total: f64 = forces.iter().skip(1).step_by(3).sum();
    assert!((total - 100.0).abs() < 1e-6, "{total} N");
    // Corners take no part of a uniform pressure, and a hundredth of that of a face with nodes at its corners alone, so that they stay above.
    for (node, area) in areas.iter().enumerate().filter(|(node, _)| vertices[*node].y == 0.0) {
        let force = forces[3 * node + 1];
        let (expected, accuracy) = if *area > 0.0 { (100.0 * area, 3.0 * area) } else { (0.2, 0.2) };
        assert!((force - expected).abs() < accuracy, "node {node}: {force} N of {area} m²");
    }
}

/// Forces of the floor on a square that is turned about its middle by so many right angles, 5e-4 m above it.
fn turned(mesh: &str, quarters: i32) -> (f64, usize) {
    let mut simulation = build(&text(mesh, "corotated", 1e5, "implicit_euler", 0.01, &floor(-1.0, "")));
    let (sin, cos) = [(0.0, 1.0), (1.0, 0.0), (0.0, -1.0), (-1.0, 0.0)][quarters as usize];
    let turn = |x: &nalgebra::Vector3<f64>| {
        let (a, b) = (x.x - 0.5, x.y - 0.5);
        [cos * a - sin * b - a, sin * a + cos * b - b - 0.9995, 0.0]
    };
    let u: Vec<_> = simulation.shape().mesh.vertices().iter().map(turn).collect();
    simulation.set_state(&u, &vec![[0.0; 3]; u.len()]);
    let forces = simulation.contact_forces().unwrap();
    (simulation.contacts()[0].force[1], forces.iter().filter(|force| **force > 0.0).count())
}

#[test]
fn the_areas_turn_with_the_body() {
    for mesh in ["rectangle = { size = [1, 1], cells_per_unit = 4 }", CUBE] {
        let upright = turned(mesh, 0);
        for quarters in 1..4 {
            let (force, count) = turned(mesh, quarters);
            assert!((force - upright.0).abs() < 1e-9 * upright.0, "{mesh}: {force} N and {} N", upright.0);
            assert_eq!(count, upright.1, "{mesh}");
        }
    }
}

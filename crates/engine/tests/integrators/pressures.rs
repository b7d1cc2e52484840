//! Pressure that follows the surface: the energy that it has, and the one that it has not.

use crate::{build, run, soft};

/// Pressure on these sides, in Pa.
pub fn pressed(sides: &[(&str, &str)], pressure: f64) -> String {
    let table = |(axis, side): &(&str, &str)| {
        format!("[[traction]]\non = {{ axis = \"{axis}\", side = \"{side}\", within = 1e-9 }}\npressure = {pressure}\n")
    };
    sides.iter().map(table).collect()
}

/// One table of all faces of the box, which close it.
pub fn closed(pressure: f64) -> String {
    let faces = build(&soft("rk4", 1e-3, "")).shape().boundary.clone();
    format!("[[traction]]\nfaces = {faces:?}\npressure = {pressure}\n")
}

/// Largest change of the total energy in a tenth of a second, as a part of the largest kinetic energy.
fn drift(rest: &str) -> f64 {
    let mut simulation = build(&soft("rk4", 1e-4, rest));
    let start = simulation.energies().total();
    let (mut worst, mut largest) = (0.0f64, 0.0f64);
    for _ in 0..1000 {
        run(&mut *simulation, 1);
        let energies = simulation.energies();
        worst = worst.max((energies.total() - start).abs());
        largest = largest.max(energies.kinetic);
    }
    assert!(largest > 1.0, "it moves: {largest} J");
    worst / largest
}

#[test]
fn a_pressure_on_a_closed_surface_keeps_the_energy() {
    let sides = ["x", "y", "z"].map(|axis| pressed(&[(axis, "min"), (axis, "max")], 4e3)).concat();
    let part = drift(&sides);
    assert!(part < 1e-6, "six tables: {part:e}");
    let part = drift(&closed(4e3));
    assert!(part < 1e-6, "{part:e}");
}

#[test]
fn a_pressure_on_a_surface_with_a_fixed_edge_keeps_the_energy() {
    // All faces but that at x = 0, whose nodes are fixed.
    let clamp = "[fixed]\nplane = { axis = \"x\", below = 1e-9 }\n[gravity]\nacceleration = [0, -9.81, 0]\n";
    let shape = build(&soft("rk4", 1e-3, "")).shape();
    let is_free = |face: &&[usize; 3]| face.iter().any(|&node| shape.mesh.vertices()[node].x > 0.0);
    let faces: Vec<_> = shape.boundary.iter().filter(is_free).collect();
    let part = drift(&format!("{clamp}[[traction]]\nfaces = {faces:?}\npressure = 4000\n"));
    assert!(part < 1e-6, "{part:e}");
}

#[test]
fn a_pressure_whose_surface_has_a_moving_edge_has_no_potential_and_the_list_of_parts_says_so() {
    let why = |rest: &str| {
        let parts = build(&soft("rk4", 1e-3, rest)).parts();
        parts.into_iter().find(|part| part.name == "pressure").unwrap().why
    };
    assert!(why(&pressed(&[("x", "max")], 1e3)).contains("so no energy contains its work"));
    assert!(!why(&closed(1e3)).contains("its work is in no energy"));
    let energy = |rest: &str| {
        let mut simulation = build(&soft("static", 1.0, rest));
        run(&mut *simulation, 1);
        simulation.energies().potential
    };
    let clamp = "[fixed]\nplane = { axis = \"x\", below = 1e-9 }\n";
    // What is stored in the body is all there is, and it is positive; a potential at equilibrium is negative.
    assert!(energy(&format!("{clamp}{}", pressed(&[("x", "max")], 1e3))) > 0.0);
    assert!(energy(&format!("{clamp}{}", closed(1e3))) < 0.0);
}

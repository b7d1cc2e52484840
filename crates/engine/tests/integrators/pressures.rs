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
    // The energy consists of the stored energy alone and is positive; with a potential of the load it would be negative at equilibrium.
    assert!(energy(&format!("{clamp}{}", pressed(&[("x", "max")], 1e3))) > 0.0);
    assert!(energy(&format!("{clamp}{}", closed(1e3))) < 0.0);
}

/// A strip of linear or quadratic triangles.
const ORDERS: [fn(&str) -> String; 2] = [crate::flat::flat, crate::quadratic::quadratic];

#[test]
fn a_pressure_on_edges_is_the_stress_of_the_deformed_body() {
    let sides = pressed(&[("x", "max")], 4e3) + &pressed(&[("y", "max")], 4e3);
    let tables = crate::side("x", "min", 0.0) + &crate::side("y", "min", 0.0) + &sides;
    for order in ORDERS {
        let mut simulation = build(&order(&crate::block("neo_hookean", &tables)));
        run(&mut *simulation, 1);
        for stress in simulation.stresses() {
            let error = (stress[(0, 0)] + 4e3).abs().max((stress[(1, 1)] + 4e3).abs());
            assert!(error < 1e-6 * 4e3 && stress[(0, 1)].abs() < 1e-2, "{stress}");
        }
    }
}

#[test]
fn a_pressure_on_a_closed_outline_keeps_the_energy_and_one_on_an_edge_with_free_ends_has_none() {
    for order in ORDERS {
        let all = order(&soft("rk4", 2e-4, "[[traction]]\non = \"all\"\npressure = 4e3\n"));
        let mut simulation = build(&all);
        let start = simulation.energies().total();
        let (mut worst, mut largest) = (0.0f64, 0.0f64);
        for _ in 0..250 {
            run(&mut *simulation, 1);
            let energies = simulation.energies();
            worst = worst.max((energies.total() - start).abs());
            largest = largest.max(energies.kinetic);
        }
        assert!(largest > 1.0, "it moves: {largest} J");
        assert!(worst < 1e-6 * largest, "{worst:e} {largest}");
        let one = build(&order(&soft("rk4", 2e-4, &pressed(&[("x", "max")], 4e3))));
        let part = one.parts().into_iter().find(|part| part.name == "pressure").unwrap();
        assert!(part.why.contains("the edge of its surface moves"), "{}", part.why);
    }
}

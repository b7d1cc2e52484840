//! Stiff and extreme cases that once failed.

use fem_model::simulation::Simulation;
use fem_scene::{body, parse};
use nalgebra::Vector3;
use std::path::Path;

use crate::{build, of_kuhn, of_law, run, soft};

/// The engine itself, whose nodes can be put anywhere.
fn engine(text: &str) -> fem_engine::simulator::Simulator<f64> {
    let scene = parse(text, Path::new("case.toml")).unwrap();
    let body = body(&scene, Path::new("")).unwrap();
    fem_engine::simulator::Simulator::new(body, &scene.method()).unwrap()
}

/// Puts every node where `place` says, without velocity.
fn place(simulation: &mut fem_engine::simulator::Simulator<f64>, place: impl Fn(&Vector3<f64>) -> Vector3<f64>) {
    let shape = simulation.shape();
    let displacements: Vec<[f64; 3]> = shape.mesh.vertices().iter().map(|X| (place(X) - X).into()).collect();
    simulation.set_state(&displacements, &vec![[0.0; 3]; displacements.len()]);
}

#[test]
fn a_soft_body_under_a_long_step_is_not_handed_on_inside_out() {
    // It falls by five times its length in the first step; directions end where the energy is infinite.
    let tables = "[fixed]\nplane = { axis = \"x\", below = 1e-9 }\n[gravity]\nacceleration = [9.81, 0, 0]\n";
    let text = soft("implicit_euler", 1.0, tables).replace("C = 1e4", "C = 20").replace("D = 4e4", "D = 40");
    let mut simulation = build(&text);
    run(&mut *simulation, 3);
    assert!(simulation.min_J().0 > 0.0);
}

#[test]
fn a_body_that_has_come_to_rest_is_not_called_stuck() {
    let mut simulation = engine(&soft("implicit_euler", 1.0, "[fixed]\nplane = { axis = \"x\", below = 1e-9 }\n"));
    place(&mut simulation, |X| X + Vector3::new(0.0, 0.0, 0.05 * X.x * X.x));
    run(&mut simulation, 1500);
    assert!(simulation.energies().total() < 1e-100);
}

#[test]
fn a_free_body_that_has_turned_converges() {
    // Its energy is near zero; the terms that add up to it are not.
    let text = soft("implicit_euler", 1e-3, "").replace("C = 1e4\nD = 4e4", "C = 1e7\nD = 4e7");
    let mut simulation = engine(&text);
    place(&mut simulation, |X| Vector3::new(1.002 * X.y, 1.0 - X.x, X.z));
    run(&mut simulation, 200);
    assert_eq!(simulation.counters().unconverged_steps, 0);
}

#[test]
fn forces_beyond_all_numbers_end_an_explicit_run() {
    // It grows by less than a half in a step, and its squares are beyond all numbers long before it is.
    let text = soft("explicit_euler", 0.014, "").replace("model = \"neo_hookean\"\nC = 1e4\nD = 4e4", LINEAR);
    let mut simulation = engine(&text);
    place(&mut simulation, |X| 1.01 * X);
    assert!((0..2000).any(|_| simulation.step().is_err()), "an unstable run goes on for ever");
}

const LINEAR: &str = "model = \"linear\"\nyoung = 1e5\npoisson = 0.3";

#[test]
fn a_squashed_body_does_not_leap_into_a_point() {
    let mut simulation = engine(&soft("implicit_euler", 1.0, ""));
    place(&mut simulation, |X| Vector3::new(0.1 * X.x, X.y, X.z));
    run(&mut simulation, 50);
    assert!((simulation.min_J().0 - 1.0).abs() < 1e-6, "{:?}", simulation.min_J());
}

#[test]
fn a_rod_that_snaps_into_a_loop_finds_its_equilibrium() {
    let text = "pipeline = \"engine\"\n[mesh]\nbox = { size = [5, 0.25, 0.25], cells_per_unit = 4 }\n[material]\n\
        model = \"neo_hookean\"\nyoung = 1e5\npoisson = 0.4\ndensity = 1000\n[time]\ndt = 1.0\nintegrator = \"static\"\n\
        [static]\nload_steps = 100\n[fixed]\nplane = { axis = \"x\", below = 1e-9 }\n[[prescribed]]\n\
        on = { axis = \"x\", side = \"max\", within = 1e-9 }\nrotation = { axis = \"x\", center = [5, 0.125, 0.125], turns = 8 }\n";
    let mut simulation = build(text);
    run(&mut *simulation, 100);
    assert_eq!(simulation.counters().unconverged_steps, 0);
    assert!(simulation.counters().newton_iterations < 3000, "{}", simulation.counters().newton_iterations);
}

#[test]
fn the_half_that_is_stiffer_and_denser_moves_less_and_weighs_more() {
    let text = soft(
        "static",
        1.0,
        "[fixed]\nplane = { axis = \"z\", below = 1e-9 }\n[gravity]\nacceleration = [0, 0, -0.1]\n",
    );
    let scene = parse(&text, Path::new("case.toml")).unwrap();
    let mut body = body(&scene, Path::new("")).unwrap();
    // The first six elements are those of the cell at x < 1.
    body.stiffness_factors = (0..12).map(|element| if element < 6 { 1.0 } else { 1e6 }).collect();
    body.density_factors = (0..12).map(|element| if element < 6 { 1.0 } else { 3.0 }).collect();
    let mut simulation = fem_engine::simulator::Simulator::<f64>::new(body, &scene.method()).unwrap();
    run(&mut simulation, 1);
    let sunk = |node: usize| 1.0 - simulation.positions()[3 * node + 2];
    assert!(sunk(6) > 1e-4 && sunk(8).abs() < 1e-3 * sunk(6), "{} and {}", sunk(6), sunk(8));
    assert!((simulation.system().total_mass - 4000.0).abs() < 1e-9);
}

#[test]
fn elements_that_are_nearly_flat_on_the_way_do_not_end_a_step() {
    // A free body at three times its length springs back by several lengths in its first steps. det F near 1e-10 has few correct digits, and so
    // has the energy.
    for dt in [0.5, 0.7, 0.8, 0.9, 1.0, 1.05, 1.1, 1.2, 1.5, 2.0] {
        let text = soft("implicit_euler", dt, "").replace("cells_per_unit = 1", "cells_per_unit = 2");
        let mut simulation = engine(&of_kuhn(&of_law("neo_hookean", &text)));
        place(&mut simulation, |X| Vector3::new(3.0 * X.x, X.y, X.z));
        for _ in 0..20 {
            simulation.step().unwrap_or_else(|failure| panic!("dt = {dt}: {failure}"));
        }
    }
}

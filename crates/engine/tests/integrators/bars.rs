//! A bar that swings along its axis: f = √(4C/ρ)/(4L) of the neo-Hookean law with D = 2C/3, whose λ is zero.

use std::path::Path;

use fem_engine::materials::AnyLaw;
use fem_engine::model::system::System;
use fem_engine::solvers::SolverChoice;
use fem_model::simulation::Simulation;
use nalgebra::DMatrix;

use crate::{build, run, scene};

const C: f64 = 1e4;
const LENGTH: f64 = 2.0;

/// √(4C/ρ)/(4L), Hz.
fn frequency() -> f64 {
    (4.0 * C / 1000.0_f64).sqrt() / (4.0 * LENGTH)
}

/// A bar of 2 m, fixed at x = 0, without lateral motion; `rest` are further tables.
fn bar(cells_per_metre: usize, rest: &str) -> String {
    let (width, nodes) = (1.0 / cells_per_metre as f64, 4 * (2 * cells_per_metre + 1));
    let all: Vec<usize> = (0..nodes).collect();
    format!(
        r#"pipeline = "engine"
[mesh]
box = {{ size = [{LENGTH}, {width:?}, {width:?}], cells_per_unit = {cells_per_metre} }}
[material]
model = "neo_hookean"
C = {C:?}
D = {:?}
density = 1000.0
[[prescribed]]
nodes = {all:?}
displacement = [0, 0, 0]
components = ["y", "z"]
[[prescribed]]
on = {{ axis = "x", side = "min", within = 0 }}
displacement = [0, 0, 0]
components = ["x"]
[time]
dt = 1e-3
integrator = "verlet"
{rest}"#,
        2.0 * C / 3.0
    )
}

/// The lowest frequency of K x = ω² M x of the free coordinates along x, Hz.
fn lowest_frequency(cells_per_metre: usize, mass: &str) -> f64 {
    let scene = scene(&bar(cells_per_metre, mass));
    let body = fem_scene::body(&scene, Path::new("no data")).unwrap();
    let law = AnyLaw::new(&scene.material.value()).unwrap();
    let system = System::<f64>::new(body, law, SolverChoice::Cholesky);
    let free: Vec<usize> = (0..system.nodes()).filter(|&node| system.rest[node].x > 0.0).collect();
    let rest = vec![[0.0; 3]; system.nodes()];
    let (mut K, mut M) = (DMatrix::zeros(free.len(), free.len()), DMatrix::zeros(free.len(), free.len()));
    for (column, &node) in free.iter().enumerate() {
        let (mut unit, mut force, mut inertia) = (rest.clone(), rest.clone(), rest.clone());
        unit[node][0] = 1.0;
        system.add_stiffness_times(1.0, &rest, &unit, &mut force);
        system.mass.add_times(1.0, &unit, &mut inertia);
        for (row, &node) in free.iter().enumerate() {
            (K[(row, column)], M[(row, column)]) = (force[node][0], inertia[node][0]);
        }
    }
    let inverse = M.cholesky().unwrap().l().try_inverse().unwrap();
    let squared = (&inverse * K * inverse.transpose()).symmetric_eigenvalues().min();
    squared.sqrt() / std::f64::consts::TAU
}

#[test]
fn the_frequency_of_a_bar_converges_with_order_2_in_h() {
    for (mass, sign) in [("", 1.0), ("[mass]\nlumped = true\n", -1.0)] {
        let errors = [4, 8, 16].map(|cells| lowest_frequency(cells, mass) / frequency() - 1.0);
        // A consistent mass makes it too high, a lumped one too low.
        assert!(errors.iter().all(|error| sign * error > 0.0), "{mass:?}: {errors:?}");
        for pair in errors.windows(2) {
            let order = (pair[0] / pair[1]).log2();
            assert!((order - 2.0).abs() < 0.1, "{mass:?}: order {order}, errors {errors:?}");
        }
        assert!(errors[2].abs() < 1e-3, "{errors:?}");
    }
}

/// Seconds between the first and the last time that the bar's end passes upwards through its place at rest under the load.
fn period(simulation: &mut dyn Simulation, steps: usize, at_rest: f64) -> f64 {
    let end = |simulation: &dyn Simulation| simulation.positions()[3 * (simulation.shape().mesh.vertices().len() - 1)];
    let (mut passed, mut before) = (Vec::new(), end(simulation));
    for _ in 0..steps {
        run(simulation, 1);
        let now = end(simulation);
        if before < at_rest && now >= at_rest {
            passed.push(simulation.time() - simulation.dt() * (now - at_rest) / (now - before));
        }
        before = now;
    }
    (passed[passed.len() - 1] - passed[0]) / (passed.len() - 1) as f64
}

#[test]
fn a_bar_that_is_loaded_at_once_swings_with_its_frequency() {
    // So little that the law is that of Hooke.
    let strain = 1e-6;
    let load = format!(
        "[[traction]]\non = {{ axis = \"x\", side = \"max\", within = 0 }}\nforce_per_area = [{:e}, 0, 0]\n",
        4.0 * C * strain
    );
    for integrator in ["verlet", "rk4", "semi_implicit_euler", "implicit_euler"] {
        let mut simulation = build(&bar(8, &load).replace("verlet", integrator));
        let steps = (4.2 / frequency() / 1e-3) as usize;
        let period = period(&mut *simulation, steps, LENGTH * (1.0 + strain));
        assert!((period * frequency() - 1.0).abs() < 5e-3, "{integrator}: {} Hz", 1.0 / period);
    }
}

//! PBD and XPBD: where their iterations converge to, momentum, constraints, the number of threads.

use nalgebra::DVector;

use crate::{build, distance, run};

/// A cantilever of 4 × 1 × 1 m and 208 nodes that falls into its bend, in a law with E = 1e5 Pa and ν = 0.3.
pub fn beam(model: &str, integrator: &str, rest: &str) -> String {
    format!(
        "pipeline = \"engine\"\n[mesh]\nbox = {{ size = [4, 1, 1], cells_per_unit = 3 }}\n[material]\nmodel = \"{model}\"\nyoung = 1e5\n\
         poisson = 0.3\ndensity = 1000\n[mass]\nlumped = true\n[gravity]\nacceleration = [0, 0, -9.81]\n[fixed]\n\
         plane = {{ axis = \"x\", below = 1e-9 }}\n[drag]\nvertex = \"highest\"\nstiffness = 1e4\ndirection = [1, 0.5, 0]\n\
         amplitude = 0.5\nfrequency = 1.0\n[[springs]]\nnodes = [12, 180]\nstiffness = 2e3\n[time]\ndt = 0.01\n\
         integrator = \"{integrator}\"\n{rest}"
    )
}

/// The beam without constraints, pull and spring.
pub fn free(text: &str) -> String {
    let [first, last] = ["[fixed]", "[time]"].map(|table| text.find(table).unwrap());
    format!("{}{}", &text[..first], &text[last..])
}

/// Positions after a few steps.
pub fn end(text: &str, steps: usize) -> DVector<f64> {
    let mut simulation = build(text);
    run(&mut *simulation, steps);
    simulation.positions()
}

/// Distance of a method from the converged steps of implicit Euler, as a part of the largest displacement.
pub fn error(model: &str, integrator: &str, iterations: &str) -> f64 {
    let newton = "[newton]\ntolerance = 1e-14\n";
    let exact = end(&beam(model, "implicit_euler", newton), 6);
    let start = build(&beam(model, "implicit_euler", newton)).positions();
    let found = end(&beam(model, integrator, iterations), 6);
    distance(&found, &exact) / distance(&exact, &start)
}

#[test]
fn iterated_xpbd_reaches_the_converged_step_of_implicit_euler_with_every_law() {
    for model in ["linear", "corotated", "st_venant_kirchhoff", "neo_hookean", "stable_neo_hookean"] {
        let error = error(model, "xpbd", "[iterations]\ncount = 3000\ntolerance = 1e-13\n");
        assert!(error < 1e-8, "{model}: {error:e}");
    }
}

#[test]
fn xpbd_without_the_residual_converges_elsewhere() {
    let plain =
        |count: usize| error("corotated", "xpbd", &format!("[iterations]\ncount = {count}\nresidual = false\n"));
    let (some, many) = (plain(200), plain(2000));
    println!("without the residual: {some:e} after 200 sweeps, {many:e} after 2000");
    assert!(many > 1e-6 && many < 0.3, "{some:e} {many:e}");
}

#[test]
fn iterated_projective_dynamics_reaches_the_minimum_of_its_energy() {
    for model in ["corotated", "stable_neo_hookean"] {
        let error = error(model, "projective_dynamics", "[iterations]\ncount = 5000\ntolerance = 1e-13\n");
        assert!(error < 1e-8, "{model}: {error:e}");
    }
}

#[test]
fn free_bodies_keep_their_linear_momentum_with_the_iterated_methods() {
    for integrator in ["pbd", "xpbd", "projective_dynamics"] {
        let text = free(&beam("corotated", integrator, "[iterations]\ncount = 5\n"));
        let text = text + "[[initial_velocity]]\nangular = { axis = [0, 1, 0], rate = 2.0 }\n";
        let mut simulation = build(&text);
        run(&mut *simulation, 20);
        let masses = crate::node_masses(&*simulation, 1000.0);
        let v = simulation.velocities();
        let total: f64 = masses.iter().sum();
        let momentum = |i: usize| masses.iter().enumerate().map(|(node, m)| m * v[3 * node + i]).sum::<f64>();
        let fallen = -9.81 * 0.2;
        let drift = (momentum(2) / total - fallen).abs().max(momentum(0).abs() / total).max(momentum(1).abs() / total);
        assert!(drift < 1e-12 * fallen.abs(), "{integrator}: {drift:e}");
    }
}

#[test]
fn nodes_end_every_step_outside_a_plane_with_coulomb_friction() {
    for integrator in ["pbd", "xpbd"] {
        let text = beam(
            "stable_neo_hookean",
            integrator,
            "[[planes]]\npoint = [0, 0, -0.2]\nnormal = [0, 0, 1]\nfriction = 0.4\n",
        );
        let mut simulation = build(&free(&text));
        for _ in 0..60 {
            run(&mut *simulation, 1);
            assert!(simulation.contacts().iter().all(|contact| contact.smallest_gap >= 0.0), "{integrator}");
        }
        assert!(simulation.contacts()[0].force[2] > 0.0, "{integrator}");
    }
}

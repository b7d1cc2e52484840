//! Vertex block descent: where its sweeps converge to, how fast, momentum, planes, the number of threads.

use nalgebra::DVector;

use crate::position_based::{beam, end, error, free};
use crate::{build, distance, run};

/// Settings of a step that ends when sweeps no longer change the velocities.
const CONVERGED: &str = "[iterations]\ncount = 3000\ntolerance = 1e-13\n";

const LAWS: [&str; 5] = ["linear", "corotated", "st_venant_kirchhoff", "neo_hookean", "stable_neo_hookean"];

#[test]
fn iterated_descent_reaches_the_converged_step_of_implicit_euler_with_every_law() {
    for model in LAWS {
        let error = error(model, "vbd", CONVERGED);
        assert!(error < 1e-8, "{model}: {error:e}");
    }
}

#[test]
fn a_single_sweep_is_not_the_converged_step() {
    let one = error("corotated", "vbd", "[iterations]\ncount = 1\n");
    assert!(one > 1e-6 && one < 0.1, "{one:e}");
}

/// Positions of a stiff beam after six steps.
fn stiff(iterations: &str) -> DVector<f64> {
    end(&beam("stable_neo_hookean", "vbd", iterations).replace("young = 1e5", "young = 1e7"), 6)
}

#[test]
fn chebyshev_acceleration_comes_nearer_to_the_converged_step_with_as_many_sweeps() {
    let converged = stiff(CONVERGED);
    let error = |iterations: &str| distance(&stiff(iterations), &converged);
    let (plain, accelerated) =
        (error("[iterations]\ncount = 60\n"), error("[iterations]\ncount = 60\nacceleration = 0.9\n"));
    assert!(plain < 1e-2 && 10.0 * accelerated < plain, "{plain:e} m, {accelerated:e} m with acceleration");
    let both = error(&(CONVERGED.to_owned() + "acceleration = 0.9\n"));
    assert!(both < 1e-9, "{both:e} m");
}

/// Largest error of the mean velocity of a free, turning body, as a part of the velocity of its fall.
fn drift(iterations: &str) -> f64 {
    let text = free(&beam("corotated", "vbd", iterations));
    let text = text + "[[initial_velocity]]\nangular = { axis = [0, 1, 0], rate = 2.0 }\n";
    let mut simulation = build(&text);
    run(&mut *simulation, 10);
    let masses = crate::node_masses(&*simulation, 1000.0);
    let v = simulation.velocities();
    let total: f64 = masses.iter().sum();
    let mean = |i: usize| masses.iter().enumerate().map(|(node, m)| m * v[3 * node + i]).sum::<f64>() / total;
    let fallen = -9.81 * 0.1;
    [mean(0), mean(1), mean(2) - fallen].into_iter().map(f64::abs).fold(0.0, f64::max) / fallen.abs()
}

#[test]
fn a_free_body_keeps_its_momentum_where_sweeps_converge_and_not_before() {
    let (converged, few) = (drift(CONVERGED), drift("[iterations]\ncount = 1\n"));
    assert!(converged < 1e-10 && few > 1e-7, "{converged:e} {few:e}");
}

/// A free beam above a plane with friction.
fn dropped(model: &str, integrator: &str, rest: &str) -> String {
    let plane = "[[planes]]\npoint = [0, 0, -0.05]\nnormal = [0, 0, 1]\nfriction = 0.4\n[[initial_velocity]]\nvelocity = [1, 0, 0]\n";
    free(&beam(model, integrator, &format!("{plane}{rest}")))
}

#[test]
fn nodes_end_every_step_outside_a_plane_which_stops_their_slide() {
    for model in ["stable_neo_hookean", "neo_hookean"] {
        let mut simulation = build(&dropped(model, "vbd", ""));
        for _ in 0..40 {
            run(&mut *simulation, 1);
            assert!(simulation.contacts().iter().all(|contact| contact.smallest_gap >= 0.0), "{model}");
        }
        let force = simulation.contacts()[0].force;
        assert!(force[2] > 0.0 && force[0] < 0.0 && force[0].abs() <= 0.4001 * force[2], "{model}: {force:?}");
    }
}

#[test]
fn contact_of_iterated_descent_is_that_of_iterated_xpbd() {
    let end = |integrator: &str| {
        let mut simulation = build(&dropped("corotated", integrator, CONVERGED));
        run(&mut *simulation, 15);
        simulation
    };
    let (found, other) = (end("vbd"), end("xpbd"));
    let apart = distance(&found.positions(), &other.positions());
    let forces = [&found, &other].map(|simulation| simulation.contacts()[0].force);
    assert!(apart < 1e-7 && forces[0][2] > 0.0, "{apart:e} {forces:?}");
    assert!((0..3).all(|i| (forces[0][i] - forces[1][i]).abs() < 1e-3 * forces[1][2]), "{forces:?}");
}

#[test]
fn no_element_stays_inverted_after_a_body_was_pushed_through_itself() {
    // St. Venant and Kirchhoff's law has no stress in a mirrored element, so that one may stay mirrored.
    for model in ["corotated", "stable_neo_hookean"] {
        let there_and_back = "[[prescribed]]\non = { axis = \"x\", side = \"max\", within = 1e-9 }\ndisplacement = [-4.5, 0, 0]\n\
             curve = { table = [[0, 0], [0.1, 1], [0.2, 0]] }\n";
        let mut simulation = build(&beam(model, "vbd", there_and_back));
        run(&mut *simulation, 10);
        let crushed = simulation.min_J().0;
        run(&mut *simulation, 90);
        let after = simulation.min_J().0;
        assert!(crushed < 0.0 && after > 0.0, "{model}: {crushed} {after}");
    }
}

fn positions_with_threads(threads: usize) -> Vec<f64> {
    let text = beam("neo_hookean", "vbd", "[iterations]\ncount = 3\nacceleration = 0.5\n");
    // Enough nodes for several threads.
    let text = text.replace("cells_per_unit = 3", "cells_per_unit = 9");
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
    pool.install(|| {
        let mut simulation = build(&text);
        run(&mut *simulation, 2);
        simulation.positions().as_slice().to_vec()
    })
}

#[test]
fn the_number_of_threads_changes_no_bit() {
    let one = positions_with_threads(1);
    assert!(one.iter().all(|x| x.is_finite()));
    assert_eq!(one, positions_with_threads(2));
}

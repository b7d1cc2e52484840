//! Plastic flow in whole runs: closed forms, order, energy, resets and files, and what it costs where it is left out.

use fem_model::simulation::Simulation;
use fem_scene::{resume, write_state};

use crate::{DYNAMIC, block, build, distance, of_law, run, side, soft, symmetry, try_build};

const ADDITIVE: &str = "[plasticity]\nmodel = \"additive\"\nyield_strain = 0.02\ncreep = 5.0\nmaximum = 0.3\n";
const J2: &str = "[plasticity]\nmodel = \"j2\"\nyield_stress = 2e3\nhardening = 5e3\n";

/// A box of 2 × 1 × 1 m that flows, E = 1e5 Pa and ν = 0.3.
fn plastic(model: &str, integrator: &str, dt: f64, rest: &str) -> String {
    let law = if model == ADDITIVE { "corotated" } else { "hencky" };
    of_law(law, &soft(integrator, dt, &format!("{rest}{model}")))
}

/// A strip of 2 × 1 m and 0.3 m thick in place of the box.
fn flat(text: &str) -> String {
    text.replace("box = { size = [2, 1, 1], cells_per_unit = 1 }", "rectangle = { size = [2, 1], cells_per_unit = 2 }")
        .replace("[material]\n", "[material]\nthickness = 0.3\n")
}

/// Both ends leave each other at 1 m/s.
const PULLED: &str =
    "[[initial_velocity]]\non = { axis = \"x\", side = \"max\", within = 1e-9 }\nvelocity = [4, 0.5, 0]\n";

fn largest_strain(simulation: &dyn Simulation) -> f64 {
    simulation.plastic_flow().unwrap().largest_strain()
}

#[test]
fn an_axially_stretched_bar_hardens_as_the_closed_form_says_however_many_load_steps_there_are() {
    let (E, stress, hardening, stretch) = (1e5, 2e3, 5e3, 1.2f64);
    let tables = symmetry() + &side("x", "max", 2.0 * (stretch - 1.0)) + J2;
    for steps in [1, 4] {
        let text = block("hencky", &format!("{tables}[static]\nload_steps = {steps}\n"));
        let mut simulation = build(&text);
        run(&mut *simulation, steps);
        // Kirchhoff stress τ = σ_y + H α with the strain ln λ = τ/E + α.
        let tau = E * (hardening * stretch.ln() + stress) / (E + hardening);
        let force = simulation.reactions()[3].force[0];
        assert!((force * stretch - tau).abs() < 1e-8 * tau, "{force} with {steps} load steps");
        let alpha = (tau - stress) / hardening;
        let flow = simulation.plastic_flow().unwrap();
        assert!(flow.strains.iter().all(|strain| (strain - alpha).abs() < 1e-10), "{:?}", flow.strains);
        assert!((flow.dissipated - 2.0 * stress * alpha).abs() < 1e-8 * flow.dissipated, "{}", flow.dissipated);
        // Stored: τ²/(2E) and H α²/2 in 2 m³.
        let stored = tau * tau / E + hardening * alpha * alpha;
        assert!((simulation.energies().potential - stored).abs() < 1e-8 * stored);
        let kirchhoff = stretch * lateral(tau, E, alpha).powi(2) * simulation.stresses()[0][(0, 0)];
        assert!((kirchhoff - tau).abs() < 1e-8 * tau, "{kirchhoff}");
    }
}

/// Lateral stretch of the bar: elastic contraction with ν = 0.3, and half of the plastic strain.
fn lateral(tau: f64, E: f64, alpha: f64) -> f64 {
    (-0.3 * tau / E - 0.5 * alpha).exp()
}

/// All nodes move at once: a strain of 0.1 along x. `until` is a further key.
fn stretched(until: &str) -> String {
    let table = |node: i32| {
        let u = 0.1 * f64::from(node % 3);
        format!("[[prescribed]]\nnodes = [{node}]\ndisplacement = [{u}, 0, 0]\n{until}")
    };
    (0..12).map(table).collect()
}

#[test]
fn the_elastic_strain_of_a_held_bar_decays_as_the_closed_form_says() {
    let mut simulation = build(&plastic(ADDITIVE, "implicit_euler", 0.01, &stretched("")));
    for step in 1..=60 {
        run(&mut *simulation, 1);
        let elastic = 0.02 + 0.08 * (-5.0 * 0.01 * f64::from(step)).exp();
        let flow = simulation.plastic_flow().unwrap();
        assert!(flow.strains.iter().all(|strain| (strain - (0.1 - elastic)).abs() < 1e-12), "step {step}: {flow:?}");
        let (mu, lambda) = (1e5 / 2.6, 3e4 / (1.3 * 0.4));
        let stress = (2.0 * mu + lambda) * elastic / 1.0;
        let found = simulation.stresses()[3][(0, 0)];
        assert!((found - stress).abs() < 1e-9 * stress, "step {step}: {found} and not {stress}");
    }
}

#[test]
fn flat_and_solid_bodies_flow_alike_in_plane_strain() {
    let tables = |count: i32, columns: i32| -> String {
        (0..count)
            .map(|node| {
                let (x, y) = (f64::from(node % columns), f64::from(node / columns % 2));
                let (u, v) = (0.1 * x + 0.05 * y, 0.15 * y - 0.02 * x);
                format!("[[prescribed]]\nnodes = [{node}]\ndisplacement = [{u}, {v}, 0]\n")
            })
            .collect()
    };
    for model in [ADDITIVE, J2] {
        let mut solid = build(&plastic(model, "implicit_euler", 0.05, &tables(12, 3)));
        let strip = flat(&plastic(model, "implicit_euler", 0.05, &tables(6, 3)));
        let mut strip = build(&strip.replace("cells_per_unit = 2", "cells_per_unit = 1"));
        for _ in 0..5 {
            run(&mut *solid, 1);
            run(&mut *strip, 1);
            let (a, b) = (largest_strain(&*solid), largest_strain(&*strip));
            assert!(a > 0.01 && (a - b).abs() < 1e-12, "{model}: {a} {b}");
            let (a, b) = (0.3 * solid.energies().potential, strip.energies().potential);
            assert!((a - b).abs() < 1e-11 * a, "{model}: {a} {b}");
            let (a, b) = (solid.plastic_flow().unwrap().dissipated, strip.plastic_flow().unwrap().dissipated);
            assert!((0.3 * a - b).abs() < 1e-11 * b, "{model}: {a} {b}");
            assert!((solid.stresses()[0] - strip.stresses()[0]).amax() < 1e-8 * solid.stresses()[0].amax(), "{model}");
        }
    }
}

#[test]
fn every_method_that_moves_lets_a_body_flow_and_ends_near_the_others() {
    for model in [ADDITIVE, J2] {
        let end = |method: &str, dt: f64| {
            let mut simulation = build(&plastic(model, method, dt, PULLED));
            run(&mut *simulation, (0.06 / dt).round() as usize);
            (simulation.positions(), largest_strain(&*simulation))
        };
        let (expected, flow) = end("rk4", 1e-4);
        assert!(flow > 0.02, "{model}: {flow}");
        for method in DYNAMIC {
            let (found, strain) = end(method, 2e-4);
            let error = distance(&found, &expected);
            assert!(error < 0.02 && (strain - flow).abs() < 0.05 * flow, "{model} {method}: {error:e} m, {strain}");
        }
    }
}

#[test]
fn the_additive_flow_is_of_first_order_in_the_time_step() {
    let end = |dt: f64| {
        let mut simulation = build(&plastic(ADDITIVE, "verlet", dt, PULLED));
        run(&mut *simulation, (0.1 / dt).round() as usize);
        simulation.positions()
    };
    let ends = [1e-3, 5e-4, 2.5e-4, 1.25e-4].map(end);
    let errors: Vec<f64> = ends.windows(2).map(|pair| distance(&pair[0], &pair[1])).collect();
    for pair in errors.windows(2) {
        let order = (pair[0] / pair[1]).log2();
        assert!((0.8..1.3).contains(&order), "{errors:?}");
    }
}

#[test]
fn kinetic_stored_and_dissipated_energy_add_up_to_what_the_body_was_given() {
    for (model, text) in [ADDITIVE, J2].map(|model| (model, plastic(model, "verlet", 1e-4, PULLED))) {
        for text in [text.clone(), flat(&text)] {
            let mut simulation = build(&text);
            let given = simulation.energies().total();
            let mut last = 0.0;
            for step in 1..=3000 {
                run(&mut *simulation, 1);
                let dissipated = simulation.plastic_flow().unwrap().dissipated;
                assert!(dissipated >= last, "{model} step {step}");
                last = dissipated;
                let error = simulation.energies().total() + dissipated - given;
                assert!(error.abs() < 2e-3 * given, "{model} step {step}: {error} of {given} J");
            }
            assert!(last > 0.1 * given, "{model}: {last} of {given} J");
        }
    }
}

#[test]
fn a_released_body_comes_to_rest_at_its_plastic_strain() {
    // Held until all strain beyond the yield strain has flowed, then free and damped.
    let tables = stretched("until = 5.0\n") + "[damping]\nalpha = 4.0\n";
    let mut simulation = build(&plastic(ADDITIVE, "implicit_euler", 0.1, &tables));
    run(&mut *simulation, 50);
    let loaded = simulation.stresses()[0].amax();
    run(&mut *simulation, 200);
    assert!(simulation.velocities().amax() < 1e-9, "{}", simulation.velocities().amax());
    let stress = simulation.stresses().iter().map(|stress| stress.amax()).fold(0.0, f64::max);
    assert!(stress < 1e-6 * loaded, "{stress} of {loaded} Pa");
    let (q, strains) = (simulation.positions(), simulation.plastic_flow().unwrap().strains);
    assert!(strains.iter().all(|strain| (strain - 0.08).abs() < 1e-8), "{strains:?}");
    let edge = |node: usize| (0..3).map(|i| (q[3 * node + i] - q[i]).powi(2)).sum::<f64>().sqrt();
    // The neighbours of node 0 along x, y and z.
    for (node, length) in [(1, 1.08), (3, 1.0), (6, 1.0)] {
        assert!((edge(node) - length).abs() < 1e-6, "{node}: {}", edge(node));
    }
}

#[test]
fn a_reset_forgets_the_flow_and_a_run_repeats_itself_bit_for_bit() {
    for model in [ADDITIVE, J2] {
        let mut simulation = build(&plastic(model, "implicit_euler", 0.01, PULLED));
        run(&mut *simulation, 10);
        let (first, flow) = (simulation.positions(), simulation.plastic_flow());
        assert!(largest_strain(&*simulation) > 0.01, "{model}");
        simulation.reset();
        assert_eq!((largest_strain(&*simulation), simulation.plastic_flow().unwrap().dissipated), (0.0, 0.0));
        run(&mut *simulation, 10);
        assert_eq!((simulation.positions(), simulation.plastic_flow()), (first, flow), "{model}");
    }
}

#[test]
fn a_resumed_run_ends_bit_for_bit_where_the_uninterrupted_one_does() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("state.json");
    for model in [ADDITIVE, J2] {
        for (method, precision) in [("verlet", "f64"), ("implicit_euler", "f64"), ("linearly_implicit_euler", "f32")] {
            let text = plastic(model, method, 1e-3, &format!("precision = \"{precision}\"\n{PULLED}"));
            let scene = crate::scene(&text);
            let mut simulation = build(&text);
            run(&mut *simulation, 40);
            write_state(&file, &scene, &*simulation).unwrap();
            run(&mut *simulation, 10);
            let mut resumed = build(&text);
            resume(&file, &scene, &mut *resumed).unwrap();
            run(&mut *resumed, 10);
            assert!(largest_strain(&*simulation) > 0.01, "{method}");
            assert_eq!(resumed.positions(), simulation.positions(), "{method} {precision}");
            assert_eq!(resumed.plastic_flow(), simulation.plastic_flow(), "{method} {precision}");
            let other = text.replace("yield_stress = 2e3", "yield_stress = 3e3").replace("creep = 5.0", "creep = 6.0");
            let error = resume(&file, &crate::scene(&other), &mut *build(&other)).unwrap_err().to_string();
            assert!(error.contains("plasticity."), "{error}");
        }
    }
}

#[test]
fn a_scene_without_the_table_has_no_flow_and_a_scene_with_it_counts_one_a_step() {
    let mut without = build(&of_law("corotated", &soft("implicit_euler", 0.01, PULLED)));
    run(&mut *without, 3);
    assert_eq!(without.plastic_flow(), None);
    let part =
        |simulation: &dyn Simulation| simulation.parts().into_iter().find(|part| part.name == "plasticity").unwrap();
    let left_out = part(&*without);
    assert!(!left_out.built && left_out.bytes == 0 && left_out.uses == 0 && !left_out.why.is_empty(), "{left_out:?}");
    let mut with = build(&plastic(ADDITIVE, "implicit_euler", 0.01, PULLED));
    run(&mut *with, 3);
    let built = part(&*with);
    assert!(built.built && built.bytes == 12 * 80 && built.uses == 3, "{built:?}");
}

#[test]
fn a_yield_stress_that_is_never_reached_changes_the_last_digits_alone() {
    for (model, law) in [(ADDITIVE, "corotated"), (J2, "hencky")] {
        let weight = "[gravity]\nacceleration = [0, -0.1, 0]\n[fixed]\nplane = { axis = \"x\", below = 1e-9 }\n";
        let (mut with, mut without) = (
            build(&plastic(model, "implicit_euler", 0.01, weight)),
            build(&of_law(law, &soft("implicit_euler", 0.01, weight))),
        );
        run(&mut *with, 20);
        run(&mut *without, 20);
        assert_eq!(largest_strain(&*with), 0.0, "{law}");
        assert!(distance(&with.positions(), &without.positions()) < 1e-12, "{law}");
    }
}

#[test]
fn combinations_without_meaning_are_refused_with_both_keys() {
    let refused = |text: &str| fem_scene::parse(text, "a.toml".as_ref()).expect_err("it is refused").to_string();
    let other = of_law("neo_hookean", &soft("verlet", 1e-3, J2));
    assert!(
        refused(&other)
            .contains("material.model is \"neo_hookean\", and plasticity.model = \"j2\" is a flow of the law")
    );
    let other = of_law("linear", &soft("verlet", 1e-3, ADDITIVE));
    assert!(refused(&other).contains("plasticity.model = \"additive\" is a flow of the law \"corotated\" alone"));
    let region = "[[materials]]\non = \"all\"\nmodel = \"linear\"\nyoung = 1e3\npoisson = 0.3\ndensity = 1.0\n";
    assert!(refused(&plastic(J2, "verlet", 1e-3, region)).contains("materials[0].model is \"linear\""));
    let still = refused(&plastic(ADDITIVE, "static", 1.0, &symmetry()));
    assert!(still.contains("time.integrator = \"static\" has none; write model = \"j2\""), "{still}");
    assert!(try_build(&plastic(J2, "static", 1.0, &symmetry())).is_ok());
}

#[test]
fn parts_of_a_body_flow_with_their_own_stiffness() {
    let half = "[[materials]]\nbox = { min = [1, 0, 0], max = [2, 1, 1] }\nmodel = \"hencky\"\nyoung = 1e6\npoisson = 0.3\n\
                density = 1000.0\n";
    let tables = symmetry() + &side("x", "max", 0.2) + half;
    let mut simulation = build(&plastic(J2, "static", 1.0, &tables));
    run(&mut *simulation, 1);
    // Both halves carry the same force, so that they yield nearly alike, and the stiff one stretches elastically by less.
    let strains = simulation.plastic_flow().unwrap().strains;
    let tau = |element: usize| 2e3 + 5e3 * strains[element];
    assert!(strains[0] > 0.02 && strains[8] > 0.02, "{strains:?}");
    assert!((tau(0) / tau(8) - 1.0).abs() < 0.05, "{} {}", tau(0), tau(8));
}

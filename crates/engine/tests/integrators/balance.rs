//! Reactions balance the loads, for every law and any number of load steps.

use fem_model::Law;
use fem_model::simulation::Simulation;

use crate::{block, build, run};

/// Weight of the box, 2 m³ at 1000 kg/m³, in N.
const WEIGHT: [f64; 3] = [2000.0, -6000.0, 4000.0];
const GRAVITY: &str = "[gravity]\nacceleration = [1, -3, 2]\n";
const TRACTION: [f64; 3] = [300.0, 50.0, -20.0];
const TABLES: &str = "[fixed]\nplane = { axis = \"x\", below = 1e-9 }\n\
                      [[traction]]\non = { axis = \"x\", side = \"max\", within = 1e-9 }\nforce_per_area = [300, 50, -20]\n";
const PRESCRIBED: &str = "[[prescribed]]\nnodes = [5]\ndisplacement = [0, 0.01, 0]\ncomponents = [\"y\"]\n";

/// Σ reactions + Σ loads at the load factor, relative to the loads.
fn imbalance(simulation: &dyn Simulation, load_factor: f64) -> f64 {
    let reactions = simulation.reactions();
    let along = |i: usize| -> f64 {
        let load = load_factor * (WEIGHT[i] + TRACTION[i]);
        reactions.iter().map(|reaction| reaction.force[i]).sum::<f64>() + load
    };
    (0..3).map(|i| along(i).abs()).fold(0.0, f64::max) / 6000.0
}

#[test]
fn reactions_balance_the_loads_after_every_load_step_of_every_law() {
    for model in Law::FACTS.iter().map(|facts| &facts.name) {
        for prescribed in ["", PRESCRIBED] {
            for load_steps in [1, 2, 5, 10] {
                let rest = format!("{GRAVITY}{TABLES}{prescribed}[static]\nload_steps = {load_steps}\n");
                let mut simulation = build(&block(model, &rest));
                // Further steps keep the full load.
                for step in 1..=load_steps + 3 {
                    run(&mut *simulation, 1);
                    let load_factor = (f64::from(step) / f64::from(load_steps)).min(1.0);
                    let error = imbalance(&*simulation, load_factor);
                    assert!(error <= 1e-9, "{model}, step {step} of {load_steps} {prescribed:?}: {error:e}");
                }
            }
        }
    }
}

#[test]
fn equilibrium_at_full_load_does_not_depend_on_the_number_of_load_steps() {
    for model in Law::FACTS.iter().map(|facts| &facts.name) {
        let end = |load_steps: usize, steps: usize| {
            let rest = format!("{GRAVITY}{TABLES}{PRESCRIBED}[static]\nload_steps = {load_steps}\n");
            let mut simulation = build(&block(model, &rest));
            run(&mut *simulation, steps);
            simulation.positions()
        };
        let once = end(1, 1);
        for (load_steps, steps) in [(1, 30), (4, 4), (4, 9), (10, 10)] {
            let error = (end(load_steps, steps) - &once).amax();
            assert!(error < 1e-11, "{model}, {steps} steps of {load_steps}: {error:e} m");
        }
    }
}

#[test]
fn a_load_step_is_in_balance_or_fails_however_large_the_load_is() {
    let mut kept = 0;
    for pressure in [1e4, 6e5, 6e6, 6e7, 6e8, 6e9] {
        let mesh = "box = { size = [4, 1, 1], cells_per_unit = 1, pattern = \"kuhn\" }";
        let text = format!(
            "pipeline = \"engine\"\n[mesh]\n{mesh}\n[material]\nmodel = \"neo_hookean\"\nyoung = 1e5\npoisson = 0.3\ndensity = 1000\n\
             [fixed]\nplane = {{ axis = \"x\", below = 1e-9 }}\n[[traction]]\non = {{ axis = \"x\", side = \"max\", within = 1e-9 }}\n\
             force_per_area = [-{pressure:e}, 0, 10]\n[time]\nintegrator = \"static\"\n[newton]\nmax_iterations = 400\n"
        );
        let mut simulation = build(&text);
        if simulation.step().is_err() {
            continue;
        }
        kept += 1;
        let [x, y, z] = simulation.reactions()[0].force;
        let error = [x - pressure, y, z + 10.0].map(f64::abs).into_iter().fold(0.0, f64::max);
        assert!(error <= 1e-6 * pressure, "{pressure:e} Pa: a reaction of ({x:e}, {y:e}, {z:e}) N");
    }
    assert!(kept >= 2, "{kept} of the loads have an equilibrium");
}

/// A bar of 100 m whose far half is a billion times as stiff as the near one, under 1 N at its end.
fn stiff_half(model: &str, poisson: f64) -> String {
    let material = |young: f64, poisson: f64| {
        format!("model = \"{model}\"\nyoung = {young:e}\npoisson = {poisson}\ndensity = 1000\n")
    };
    format!(
        "pipeline = \"engine\"\n[mesh]\nbox = {{ size = [100, 1, 1], cells_per_unit = 2, pattern = \"kuhn\" }}\n[material]\n{}\
         [[materials]]\nbox = {{ min = [50, -1, -1], max = [101, 2, 2] }}\n{}[fixed]\nplane = {{ axis = \"x\", below = 1e-9 }}\n\
         [[traction]]\non = {{ axis = \"x\", side = \"max\", within = 1e-9 }}\nforce_per_area = [0, 0, -1]\n[time]\nintegrator = \"static\"\n",
        material(1e5, poisson),
        material(1e14, 0.3),
    )
}

#[test]
fn reactions_are_right_or_the_step_fails_where_a_part_is_a_billion_times_as_stiff() {
    for model in ["linear", "neo_hookean", "st_venant_kirchhoff"] {
        let mut kept = 0;
        for poisson in [0.49999, 0.4999999] {
            let mut simulation = build(&stiff_half(model, poisson));
            if simulation.step().is_err() {
                continue;
            }
            kept += 1;
            let [x, y, z] = simulation.reactions()[0].force;
            let error = [x, y, z - 1.0].map(f64::abs).into_iter().fold(0.0, f64::max);
            assert!(error <= 1e-3, "{model} with a ratio of {poisson}: a reaction of ({x:e}, {y:e}, {z:e}) N");
        }
        assert!(kept >= 1, "{model}: none has an equilibrium");
    }
}

#[test]
fn in_single_precision_reactions_of_a_slender_bar_are_its_load_or_the_step_fails_however_small_the_load_is() {
    let mut kept = 0;
    for force in [1e2, 1.0, 1e-1, 1e-2, 1e-3, 1e-6] {
        let text = format!(
            "pipeline = \"engine\"\n[mesh]\nbox = {{ size = [50, 1, 1], cells_per_unit = 2, pattern = \"kuhn\" }}\n[material]\n\
             model = \"neo_hookean\"\nyoung = 1e9\npoisson = 0.499\ndensity = 1000\n[fixed]\nplane = {{ axis = \"x\", below = 1e-9 }}\n\
             [[traction]]\non = {{ axis = \"x\", side = \"max\", within = 1e-9 }}\nforce_per_area = [0, 0, -{force:e}]\n\
             [time]\nintegrator = \"static\"\nprecision = \"f32\"\n"
        );
        let mut simulation = build(&text);
        if let Err(failure) = simulation.step() {
            assert!(failure.remedy.contains("f64"), "{failure}");
            continue;
        }
        kept += 1;
        let [x, y, z] = simulation.reactions()[0].force;
        let error = [x, y, z - force].map(f64::abs).into_iter().fold(0.0, f64::max);
        assert!(error <= 2e-3 * force, "{force:e} N: a reaction of ({x:e}, {y:e}, {z:e}) N");
    }
    assert!(kept >= 1, "{kept} of the loads have an equilibrium");
}

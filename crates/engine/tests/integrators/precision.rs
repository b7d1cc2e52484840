//! Single precision ends where double precision does, with at most one iteration more in a step, or is refused.

use fem_model::Law;
use fem_model::simulation::Simulation;

use crate::{DYNAMIC, build, distance, of_kuhn, of_law, run, soft, try_build};

const LOADS: &str = "[gravity]\nacceleration = [0, 0, -2]\n[fixed]\nplane = { axis = \"x\", below = 1e-9 }\n";

/// The simulation after a number of steps in double and in single precision.
fn ends(text: &str, steps: usize) -> [Box<dyn Simulation>; 2] {
    ["f64", "f32"].map(|precision| {
        let mut simulation = build(&text.replace("[time]", &format!("[time]\nprecision = \"{precision}\"")));
        run(&mut *simulation, steps);
        simulation
    })
}

#[test]
fn every_law_and_method_ends_where_double_precision_does() {
    for law in Law::FACTS.iter().map(|facts| &facts.name) {
        for cells in [1, 3] {
            for integrator in DYNAMIC.iter().chain(&["static"]) {
                let dt = if integrator.ends_with("implicit_euler") && *integrator != "semi_implicit_euler" {
                    1e-2
                } else {
                    1e-3
                };
                let text = of_law(law, &soft(integrator, dt, LOADS));
                let text = text.replace("cells_per_unit = 1", &format!("cells_per_unit = {cells}"));
                let steps = if *integrator == "static" { 1 } else { 20 };
                let [double, single] = ends(&text, steps);
                let apart = distance(&double.positions(), &single.positions()) / 2.0;
                assert!(apart < 1e-5, "{law}, {integrator}, {cells} cells: {apart:e} of the length");
                let (double, single) = (double.counters(), single.counters());
                assert_eq!(single.unconverged_steps, 0, "{law}, {integrator}, {cells} cells");
                // Round-off decides whether an iteration of a step was the last.
                let (found, most) = (single.newton_iterations, double.newton_iterations + steps);
                assert!(found <= most, "{law}, {integrator}, {cells} cells: {found} iterations, not {most}");
            }
        }
    }
}

#[test]
fn slender_bodies_keep_the_digits_that_their_matrix_loses() {
    for law in ["linear", "corotated", "neo_hookean"] {
        let text = of_law(
            law,
            &soft(
                "static",
                1.0,
                "[gravity]\nacceleration = [0, 0, -0.01]\n[fixed]\nplane = { axis = \"x\", below = 1e-9 }\n",
            ),
        );
        // The large deflections of the softer mesh of alternating cells have more than one equilibrium.
        let alternating = (law == "linear").then(|| text.clone());
        for text in alternating.into_iter().chain([of_kuhn(&text)]) {
            let [double, single] = ends(&text.replace("[2, 1, 1]", "[30, 1, 1]").replace("unit = 1", "unit = 2"), 1);
            let apart = distance(&double.positions(), &single.positions()) / 30.0;
            // The order of the sums differs between processors: some end below 1e-5, others at 1.5e-5.
            assert!(apart < 5e-5, "{law}: {apart:e} of the length");
            assert_eq!(single.counters().unconverged_steps, 0, "{law}");
        }
    }
}

#[test]
fn every_law_carries_a_load_of_any_small_strain_in_single_precision() {
    for law in Law::FACTS.iter().map(|facts| &facts.name) {
        for pressure in [1e2, 1.0, 1e-1, 1e-3, 1e-6] {
            let loads = format!(
                "[fixed]\nplane = {{ axis = \"x\", below = 1e-9 }}\n[[traction]]\non = {{ axis = \"x\", side = \"max\", within = 1e-9 }}\n\
                 force_per_area = [{pressure:e}, 0, -{pressure:e}]\n"
            );
            let text = of_law(law, &soft("static", 1.0, &loads));
            let [double, single] = ends(&text, 1);
            let apart = distance(&double.positions(), &single.positions())
                / distance(&double.positions(), &build(&text).positions());
            assert!(apart < 1e-3, "{law} under {pressure:e} Pa: {apart:e} of the displacement");
            let [x, _, z] = single.reactions()[0].force;
            let error = (x + pressure).abs().max((z - pressure).abs()) / pressure;
            assert!(error < 1e-4, "{law} under {pressure:e} Pa: reactions are {error:e} off");
        }
    }
}

#[test]
fn a_tolerance_below_the_rounding_error_of_the_number_type_is_refused() {
    for (precision, tolerance, least) in [("f32", "1e-10", "9.5e-7"), ("f64", "1e-16", "1.8e-15")] {
        for integrator in ["implicit_euler", "static"] {
            let text = soft(integrator, 1e-2, &format!("{LOADS}[newton]\ntolerance = {tolerance}\n"));
            let text = text.replace("[time]", &format!("[time]\nprecision = \"{precision}\""));
            let Err(error) = try_build(&text) else { panic!("taken: {text}") };
            let said = error.to_string();
            assert!(said.contains(&format!("newton.tolerance is {tolerance}, which rounding error")), "{said}");
            assert!(said.contains(&format!("give {least} or more")), "{said}");
            assert_eq!(said.contains("remove time.precision"), precision == "f32", "{said}");
        }
    }
}

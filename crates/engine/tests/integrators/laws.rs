//! Every law in every integrator.

use fem_model::Law;
use nalgebra::DVector;

use crate::{DYNAMIC, build, distance, of_law, run, soft, try_build};

const CLAMPED: &str = "[fixed]\nplane = { axis = \"x\", below = 1e-9 }\n[gravity]\nacceleration = [0, -1e-3, 5e-4]\n";

/// Displacements after some steps under a load that strains the body by about 1e-5, m.
fn displacements(model: &str, integrator: &str) -> DVector<f64> {
    let steps = if integrator == "static" { 1 } else { 20 };
    let mut simulation = build(&of_law(model, &soft(integrator, 1e-2, CLAMPED)));
    let rest = simulation.positions();
    run(&mut *simulation, steps);
    simulation.positions() - rest
}

#[test]
fn at_small_strain_every_integrator_moves_a_body_of_every_law_as_hooke_s_law_does() {
    for integrator in DYNAMIC.into_iter().chain(["static"]) {
        let hooke = displacements("linear", integrator);
        assert!(hooke.amax() > 1e-6, "{integrator}: {:e} m", hooke.amax());
        for model in Law::FACTS.iter().map(|facts| &facts.name) {
            let difference = distance(&displacements(model, integrator), &hooke) / hooke.amax();
            assert!(difference < 1e-3, "{model}, {integrator}: {difference:e}");
        }
    }
}

#[test]
fn parameters_without_a_positive_shear_modulus_are_refused() {
    for C01 in ["-1e4", "-2e4"] {
        let text = of_law("mooney_rivlin", &soft("verlet", 1e-3, ""));
        let (before, after) = text.split_once("C10 = ").unwrap();
        let after = after.split_once("D = ").unwrap().1;
        let error = try_build(&format!("{before}C10 = 1e4\nC01 = {C01}\nD = {after}")).err().map(|e| e.to_string());
        let expected = "Pa at small strain; give parameters that make it positive";
        assert!(error.as_ref().is_some_and(|error| error.contains(expected)), "{error:?}");
    }
    let text = of_law("ogden", &soft("verlet", 1e-3, "")).replace("alpha1 = 1.5", "alpha1 = -1.5");
    let error = try_build(&text).err().map(|e| e.to_string());
    assert!(error.as_ref().is_some_and(|error| error.contains("Pa at small strain; give parameters")), "{error:?}");
}

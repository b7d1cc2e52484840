//! From a scene's table to a law.

use std::path::Path;

use super::*;
use fem_elements::Real;
use fem_elements::tensor::zero;
use fem_model::{Law as Named, LawFacts};

/// The table of a scene with these lines.
fn table(model: &str, parameters: &str) -> fem_model::Material {
    let text = format!(
        "pipeline = \"engine\"\n[mesh]\nbox = {{ size = [1, 1, 1], cells_per_unit = 1 }}\n[material]\n\
         model = \"{model}\"\n{parameters}density = 1.0\n[time]\ndt = 1.0\nintegrator = \"verlet\"\n"
    );
    fem_scene::parse(&text, Path::new("name.toml")).unwrap_or_else(|error| panic!("{error}\n{text}")).material.value()
}

#[test]
fn every_model_of_the_scene_format_is_a_law_with_each_set_of_its_parameters() {
    for LawFacts { name: model, parameters, .. } in Named::FACTS {
        for set in parameters {
            let line = |name: &&str| format!("{name} = {}\n", if *name == "poisson" { 0.25 } else { 1000.0 });
            let law = AnyLaw::<f64>::new(&table(model, &set.iter().map(line).collect::<String>()));
            assert_eq!(law.map(|law| law.name()), Some(model), "{set:?}");
        }
    }
    let sorted = |mut names: Vec<&'static str>| {
        names.sort();
        names
    };
    let models = sorted(Named::FACTS.iter().map(|facts| facts.name).collect());
    assert_eq!(sorted(AnyLaw::NAMES.to_vec()), models);
    assert_eq!(sorted(laws::<f64>().iter().map(AnyLaw::name).collect()), models);
}

#[test]
fn young_and_poisson_give_every_model_the_same_stiffness_at_rest() {
    // μ = λ = E/2.5
    let hooke = Linear { mu: 400.0, lambda: 400.0 }.derivative(&zero());
    for LawFacts { name: model, .. } in
        Named::FACTS.iter().filter(|facts| facts.parameters.iter().any(|set| set.contains(&"young")))
    {
        let law = AnyLaw::<f64>::new(&table(model, "young = 1000.0\npoisson = 0.25\n")).unwrap();
        let H = f64::law(&law).derivative(&zero());
        assert!(distance(&H, &hooke) < 1e-11, "{model}: {H:?}");
    }
}

#[test]
fn c_and_d_are_taken_as_they_are() {
    let table = table("neo_hookean", "C = 2.0\nD = 3.0\n");
    assert_eq!(AnyLaw::new(&table), Some(AnyLaw::NeoHookean(NeoHookean { C: 2.0, D: 3.0 })));
    let springs = fem_model::Law::MassSpring { stiffness: fem_model::EdgeStiffness::Uniform(1.0), damping: 0.0 };
    assert_eq!(AnyLaw::<f64>::new(&fem_model::Material { law: springs, ..table }), None);
}

#[test]
fn a_law_allows_inversion_if_its_energy_is_finite_there() {
    for law in laws::<f64>() {
        let energy = f64::law(&law).energy(&diagonal([0.0, 0.0, -1.5]));
        assert_eq!(law.allows_inversion(), energy.is_finite(), "{}", law.name());
    }
}

#[test]
fn a_law_is_linear_if_twice_the_deformation_is_twice_the_stress() {
    let G = [[0.1, 0.2, 0.0], [0.0, -0.1, 0.0], [0.0, 0.3, 0.0]];
    for law in laws::<f64>() {
        let (once, twice) = (f64::law(&law).stress(&G), f64::law(&law).stress(&G.map(|row| row.map(|x| 2.0 * x))));
        let difference = distance(&twice, &once.map(|row| row.map(|x| 2.0 * x)));
        assert_eq!(law.is_linear(), difference < 1e-12, "{}: {difference:e}", law.name());
    }
}

#[test]
fn the_moduli_are_those_of_the_derivative_at_rest() {
    for law in laws::<f64>() {
        let H = f64::law(&law).derivative(&zero());
        let [shear, bulk] = law.moduli();
        assert!((shear - H[1][1]).abs() < 1e-14 && (bulk - (H[0][0] + 2.0 * H[0][4]) / 3.0).abs() < 1e-14, "{law:?}");
    }
}

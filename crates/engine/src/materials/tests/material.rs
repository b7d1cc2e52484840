//! From a scene's table to a law.

use super::*;
use crate::materials::{Material, allows_inversion, with_law};
use crate::number::Real;
use crate::tensor::zero;
use fem_scene::Model;

const MODELS: [Model; 5] =
    [Model::Linear, Model::Corotated, Model::StVenantKirchhoff, Model::NeoHookean, Model::StableNeoHookean];

fn table(model: Model) -> fem_scene::Material {
    fem_scene::Material { model, c: None, d: None, young: Some(1000.0), poisson: Some(0.25), density: 1.0 }
}

#[test]
fn young_and_poisson_give_every_model_the_same_stiffness_at_rest() {
    // μ = λ = E/2.5
    let hooke = Linear { mu: 400.0, lambda: 400.0 }.derivative(&zero());
    for model in MODELS {
        let material = Material::<f64>::new(&table(model)).unwrap();
        let H = with_law!(material, law: f64 => law.derivative(&zero()));
        assert!(distance(&H, &hooke) < 1e-11, "{model:?}: {H:?}");
    }
}

#[test]
fn the_law_has_the_moduli_in_every_lane_and_in_single_precision() {
    for model in MODELS {
        let double = Material::<f64>::new(&table(model)).unwrap();
        let single = Material::<f32>::new(&table(model)).unwrap();
        let G = [[0.1, 0.2, 0.0], [0.0, -0.1, 0.0], [0.0, 0.3, 0.0]];
        let energy = with_law!(double, law: f64 => law.energy(&G));
        let lanes = G.map(|row| row.map(|x| f32::lanes(|_| x as f32)));
        let in_lanes = with_law!(single, law: <f32 as Real>::Lanes => law.energy(&lanes));
        assert!(f32::each(&in_lanes).iter().all(|&lane| (f64::from(lane) / energy - 1.0).abs() < 1e-5), "{model:?}");
    }
}

#[test]
fn c_and_d_are_taken_as_they_are() {
    let table =
        fem_scene::Material { c: Some(2.0), d: Some(3.0), young: None, poisson: None, ..table(Model::NeoHookean) };
    assert_eq!(Material::new(&table), Some(Material::NeoHookean(NeoHookean { C: 2.0, D: 3.0 })));
    assert_eq!(Material::<f64>::new(&fem_scene::Material { model: Model::Linear, ..table }), None);
}

#[test]
fn a_model_allows_inversion_where_its_energy_is_finite_there() {
    for model in MODELS {
        let material = Material::<f64>::new(&table(model)).unwrap();
        let energy = with_law!(material, law: f64 => law.energy(&diagonal([0.0, 0.0, -1.5])));
        assert_eq!(allows_inversion(model), energy.is_finite(), "{model:?}");
    }
}

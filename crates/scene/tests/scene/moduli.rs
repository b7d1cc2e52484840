//! From Young's modulus and Poisson's ratio to C and D.

use approx::assert_relative_eq;
use fem_model::Law;
use fem_scene::Scene;

use crate::{LEAST, edit, read};

/// C and D of a scene.
fn moduli_of(scene: &Scene) -> [f64; 2] {
    let Law::NeoHookean(law) = scene.material.value().law else { panic!("{} is another law", scene.material.model) };
    law.moduli()
}

/// C and D of a scene with this E and ν.
fn moduli(young: f64, poisson: f64) -> [f64; 2] {
    let text = edit(LEAST, "C = 1e5\nD = 4e5\n", &format!("young = {young:e}\npoisson = {poisson}\n"));
    moduli_of(&read(&text))
}

#[test]
fn c_and_d_are_used_as_given() {
    assert_eq!(moduli_of(&read(LEAST)), [1e5, 4e5]);
}

#[test]
fn a_scene_with_young_and_poisson_has_the_same_shear_and_bulk_modulus_at_small_strain() {
    for (E, nu) in [(6e6, 0.4), (1.0, 0.0), (1e12, 0.4999), (250.0, -0.9), (5.934e6, 5.0 / 13.0)] {
        let [C, D] = moduli(E, nu);
        // μ = 2C, K = 2D
        assert_relative_eq!(2.0 * C, E / (2.0 * (1.0 + nu)), max_relative = 1e-14);
        assert_relative_eq!(2.0 * D, E / (3.0 * (1.0 - 2.0 * nu)), max_relative = 1e-14);
        // and back
        assert_relative_eq!(18.0 * C * D / (3.0 * D + C), E, max_relative = 1e-12);
        assert_relative_eq!((3.0 * D - 2.0 * C) / (6.0 * D + 2.0 * C), nu, epsilon = 1e-12);
    }
}

#[test]
fn the_scenes_of_the_course_keep_the_course_s_c_and_d() {
    // C = μ/2 and D = λ/2 of E = 6e5 Pa and ν = 0.4
    let (E, nu) = (6e5, 0.4);
    let bunny = fem_scene::load("bunny", &crate::data()).unwrap();
    let [C, D] = moduli_of(&bunny);
    assert_relative_eq!(C, E / (2.0 * (1.0 + nu)) / 2.0, max_relative = 1e-12);
    assert_relative_eq!(D, E * nu / ((1.0 + nu) * (1.0 - 2.0 * nu)) / 2.0, max_relative = 1e-12);
}

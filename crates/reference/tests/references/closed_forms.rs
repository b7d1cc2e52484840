//! Equilibria in closed form.

use std::path::Path;

use fem_reference::space::closed_forms::uniaxial;
use fem_scene::parse;

/// Stretches along and across the bar of the scenes under this traction, Pa.
fn stretches(traction: &str) -> (f64, f64) {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../data/scenes/bar.toml");
    let text = std::fs::read_to_string(&file).unwrap();
    assert!(text.contains("[3.842394e5, 0, 0]"), "the traction of the bar is replaced");
    uniaxial(&parse(&text.replace("3.842394e5", traction), &file).unwrap()).unwrap()
}

#[test]
fn the_bar_of_the_scenes_has_a_stretch_of_one_and_a_half() {
    let (stretch, lateral) = stretches("3.842394e5");
    assert!((stretch - 1.5).abs() < 1e-6, "{stretch} {lateral}");
}

#[test]
fn a_small_traction_follows_hookes_law() {
    // E = 18CD/(3D + C), ν = (3D − 2C)/(6D + 2C)
    let (C, D) = (2e5, 1e6);
    let (E, nu) = (18.0 * C * D / (3.0 * D + C), (3.0 * D - 2.0 * C) / (6.0 * D + 2.0 * C));
    let (stretch, lateral) = stretches("1.0");
    assert!(((stretch - 1.0) * E - 1.0).abs() < 1e-5);
    assert!(((1.0 - lateral) * E - nu).abs() < 1e-5);
}

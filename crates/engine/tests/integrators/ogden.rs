//! Bars and sheets of Ogden's law against their closed forms.

use fem_model::simulation::Simulation;

use crate::{block, build, run, side, symmetry};

/// The terms of [`of_law`](crate::of_law), and D, Pa.
const ALPHA: [f64; 3] = [1.5, 4.0, -2.0];

fn parameters() -> ([f64; 3], f64) {
    let C = 1e5 / (4.0 * 1.3);
    ([2.0, 0.075, -0.85].map(|mu| 4.0 * C * mu / 5.0), 1e5 / (6.0 * 0.4))
}

/// Nominal stress along an axis at principal stretches, Pa.
fn nominal(stretches: [f64; 3], axis: usize) -> f64 {
    let (mu, D) = parameters();
    let J: f64 = stretches.iter().product();
    let isochoric = stretches.map(|stretch| stretch / J.cbrt());
    let term = |(mu, alpha): (f64, f64)| {
        mu * (isochoric[axis].powf(alpha) - isochoric.iter().map(|stretch| stretch.powf(alpha)).sum::<f64>() / 3.0)
    };
    (mu.into_iter().zip(ALPHA).map(term).sum::<f64>() + 2.0 * D * (J - 1.0) * J) / stretches[axis]
}

/// The stretches whose last one, and with `is_bar` the middle one too, is free.
fn with_free_sides(first: f64, middle: f64, is_bar: bool) -> [f64; 3] {
    let at = |free: f64| [first, if is_bar { free } else { middle }, free];
    let (mut least, mut most) = (0.1, 4.0);
    for _ in 0..200 {
        let free = 0.5 * (least + most);
        if nominal(at(free), 2) < 0.0 { least = free } else { most = free }
    }
    at(least)
}

/// Force on the side that is moved along x, N: the area is 1 m².
fn pull(simulation: &dyn Simulation) -> f64 {
    simulation.reactions().iter().find(|reaction| reaction.name == "prescribed[3]").unwrap().force[0]
}

#[test]
fn simple_and_equibiaxial_tension_and_pure_shear_have_the_force_of_the_closed_form() {
    for order in [1, 2] {
        for stretch in [0.7, 1.001, 1.5, 2.5] {
            let along_x = side("x", "max", 2.0 * (stretch - 1.0));
            // The y sides of the block of 2 × 1 × 1 m are free, moved as far, or fixed.
            for (other, middle, is_bar) in [
                (String::new(), 1.0, true),
                (side("y", "max", stretch - 1.0), stretch, false),
                (side("y", "max", 0.0), 1.0, false),
            ] {
                let text = block("ogden", &format!("{}{along_x}{other}[static]\nload_steps = 4\n", symmetry()));
                let mut simulation = build(&text.replace("[material]", &format!("order = {order}\n[material]")));
                run(&mut *simulation, 4);
                let stretches = with_free_sides(stretch, middle, is_bar);
                let (found, expected) = (pull(&*simulation), nominal(stretches, 0));
                assert!((found - expected).abs() < 1e-9 * (expected.abs() + 1e3), "{stretches:?}: {found} {expected}");
            }
        }
    }
}

//! Mistakes in `psi_neo_hookean`.

use nalgebra::Matrix3;

use super::Variant;

/// The mistakes that are known.
pub const VARIANTS: &[Variant] = &[
    variant!(
        psi_neo_hookean,
        "wrong exponent",
        "Blow the body up uniformly: only the second term may notice. Which power of J takes the size out of the trace?",
        |F, C, D| with_power(F, C, D, -1.0 / 3.0)
    ),
    variant!(
        psi_neo_hookean,
        "sign of the exponent",
        "Blow the body up uniformly: the trace grows, and the power of J has to undo that, not to add to it.",
        |F, C, D| with_power(F, C, D, 2.0 / 3.0)
    ),
    variant!(
        psi_neo_hookean,
        "power of J without effect",
        "The power of J has no effect: does it stand in the formula, and with an exponent that is divided as a floating-point number?",
        |F, C, D| with_power(F, C, D, 0.0)
    ),
    variant!(
        psi_neo_hookean,
        "trace of F",
        "The first term needs a sum of squares. A rotation must store no energy: does yours?",
        |F, C, D| {
            let J = F.determinant();
            infinite_unless_positive(J, C * (J.powf(-2.0 / 3.0) * F.trace() - 3.0) + D * (J - 1.0).powi(2))
        }
    ),
    variant!(
        psi_neo_hookean,
        "missing term",
        "A change of volume costs nothing here. Read the formula again, term by term.",
        |F, C, _| with_power(F, C, 0.0, -2.0 / 3.0)
    ),
    variant!(
        psi_neo_hookean,
        "3 inside the product",
        "Blow the body up uniformly: the first term must be zero. What exactly is multiplied by the power of J?",
        |F, C, D| {
            let J = F.determinant();
            infinite_unless_positive(J, C * J.powf(-2.0 / 3.0) * (F.norm_squared() - 3.0) + D * (J - 1.0).powi(2))
        }
    ),
    variant!(
        psi_neo_hookean,
        "missing constant",
        "At rest there must be no energy. What does the first term give for the identity?",
        |F, C, D| with_power(F, C, D, -2.0 / 3.0) + 3.0 * C
    ),
    variant!(
        psi_neo_hookean,
        "NaN for inverted",
        "For an inverted element the answer is not a number. When do you look at the sign of J?",
        |F, C, D| {
            let J = F.determinant();
            C * (J.powf(-2.0 / 3.0) * F.norm_squared() - 3.0) + D * (J - 1.0).powi(2)
        }
    ),
    variant!(
        psi_neo_hookean,
        "finite for inverted",
        "An inverted element must not look like a deformed one: read what the page says about J ≤ 0.",
        |F, C, D| {
            let J = F.determinant();
            C * (J.abs().powf(-2.0 / 3.0) * F.norm_squared() - 3.0) + D * (J - 1.0).powi(2)
        }
    ),
    variant!(
        psi_neo_hookean,
        "C and D swapped",
        "Each constant weighs the other's term. Which one resists a change of shape?",
        |F, C, D| with_power(F, D, C, -2.0 / 3.0)
    ),
    variant!(
        psi_neo_hookean,
        "not squared",
        "Compression stores energy too, so the second term may not change its sign with J − 1.",
        |F, C, D| {
            let J = F.determinant();
            infinite_unless_positive(J, with_power(F, C, 0.0, -2.0 / 3.0) + D * (J - 1.0))
        }
    ),
];

/// The formula with another power of J.
fn with_power(F: &Matrix3<f64>, C: f64, D: f64, power: f64) -> f64 {
    let J = F.determinant();
    infinite_unless_positive(J, C * (J.powf(power) * F.norm_squared() - 3.0) + D * (J - 1.0).powi(2))
}

fn infinite_unless_positive(J: f64, energy: f64) -> f64 {
    if J > 0.0 { energy } else { f64::INFINITY }
}

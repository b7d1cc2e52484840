//! Checks of `[newmark]`, `[generalized_alpha]` and the adaptive steps of `[time]`.

use super::check_tolerance;
use crate::Scene;
use crate::tables::{GeneralizedAlphaTable, NewmarkTable};
use fem_model::numbers::{check_finite, problem};
use fem_model::{Integrator, Refusal};

/// Returns the first parameter of an implicit method of second order that is out of range.
pub(super) fn check(scene: &Scene) -> Result<(), Refusal> {
    scene.newmark.as_ref().map_or(Ok(()), |table| check_newmark(table, &scene.method().newmark))?;
    scene.generalized_alpha.as_ref().map_or(Ok(()), check_generalized_alpha)?;
    check_adaptive(scene)
}

fn check_adaptive(scene: &Scene) -> Result<(), Refusal> {
    let Some(adaptive) = scene.time.adaptive else { return Ok(()) };
    let method = scene.time.integrator;
    if !method.estimates_error() {
        let names = Integrator::second_order_implicit().map(Integrator::name).collect::<Vec<_>>().join(", ");
        let text =
            format!("needs a method with an estimate of its error, and {} has none; use one of {names}", method.name());
        return problem("time.adaptive", text);
    }
    if scene.time.substeps.is_some() {
        return problem(
            "time.substeps",
            "stands beside time.adaptive, which chooses the parts of a step; remove one of the two",
        );
    }
    if method == Integrator::Newmark && scene.method().newmark.gamma != 0.5 {
        let text = "estimates an error of second order, and newmark.gamma is not 0.5; remove one of the two, or use generalized_alpha";
        return problem("time.adaptive", text);
    }
    check_tolerance("time.adaptive.tolerance", adaptive.tolerance)
}

/// Newmark's method is stable at any time step for 2β ≥ γ ≥ ½, and for smaller β below a critical one: Hughes, The Finite Element Method (1987),
/// 9.1. Periods are most accurate with β = 1/12.
fn check_newmark(table: &NewmarkTable, values: &fem_model::NewmarkParameters) -> Result<(), Refusal> {
    for (field, value) in [("newmark.beta", table.beta), ("newmark.gamma", table.gamma)] {
        value.map_or(Ok(()), |value| check_finite(field, &[value]))?;
    }
    let fem_model::NewmarkParameters { beta, gamma } = *values;
    if !(0.5..=1.0).contains(&gamma) {
        let text = format!(
            "is {gamma}; give a number from 0.5 to 1: 0.5 is of second order, more damps and is of first order, and less is unstable"
        );
        return problem("newmark.gamma", text);
    }
    // Rounded, 1/12 is any number of 16 digits near it.
    if !(1.0 / 12.0 - 1e-9..=1.0).contains(&beta) {
        let least = 0.5 * gamma;
        let text = format!(
            "is {beta}; give a number from {least}, half of newmark.gamma, to 1, for a method that is stable at any time step, or one from \
             0.0833333333, Fox and Goodwin's 1/12, on, for a method that has a critical time step"
        );
        return problem("newmark.beta", text);
    }
    Ok(())
}

fn check_generalized_alpha(table: &GeneralizedAlphaTable) -> Result<(), Refusal> {
    let Some(radius) = table.spectral_radius else { return Ok(()) };
    if (0.0..=1.0).contains(&radius) {
        return Ok(());
    }
    let text = format!(
        "is {radius}; give a number from 0, which ends the fastest vibrations in a step, to 1, which keeps them"
    );
    problem("generalized_alpha.spectral_radius", text)
}

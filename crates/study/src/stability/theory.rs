//! Linear stability theory: the growth of a vibration of frequency ω at the time step dt, as a function of z = ω dt; and
//! its predictions for a clamped body, with the runs that test them.
//!
//! Hairer, Lubich and Wanner, Geometric Numerical Integration (2006), ch. I and VI.3; Hairer and Wanner, Solving Ordinary
//! Differential Equations II (1996), ch. IV.2.

use fem_engine::simulator::Simulator;
use fem_model::Integrator;

use super::case::{Finding, Outcome};
use super::initial_state::Random;
use super::march::march;
use super::setup::{Setup, clamp};
use crate::study::Deadline;
use fem_reference::Elements;
use fem_reference::space::highest_mode::{HighestMode, highest_mode};

/// A method with its coefficients.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Scheme {
    /// With those that it has by default.
    Of(Integrator),
    /// Newmark's method with β = 1/12, Fox and Goodwin's: the other β of the study are stable at any time step.
    FoxGoodwin,
}

impl From<Integrator> for Scheme {
    fn from(integrator: Integrator) -> Self {
        Self::Of(integrator)
    }
}

/// The stability limit of ω dt; `None` for unconditionally stable integrators.
pub fn limit(scheme: impl Into<Scheme>) -> Option<f64> {
    match scheme.into() {
        Scheme::Of(integrator) => integrator.facts().stability_limit,
        Scheme::FoxGoodwin => Some(6.0f64.sqrt()),
    }
}

/// Logarithm of the growth factor per step: the spectral radius of the amplification matrix for ẍ = −ω² x.
pub fn growth(scheme: impl Into<Scheme>, z: f64) -> f64 {
    use Integrator::{ExplicitEuler, ImplicitMidpoint, Newmark, Rk2, Rk4, SemiImplicitEuler, Verlet};
    let z2 = z * z;
    match scheme.into() {
        // |1 + iz|
        Scheme::Of(ExplicitEuler) => 0.5 * z2.ln_1p(),
        // |1 + iz − z²/2|
        Scheme::Of(Rk2) => 0.5 * (0.25 * z2 * z2).ln_1p(),
        // |1 + iz − z²/2 − iz³/6 + z⁴/24|
        Scheme::Of(Rk4) => 0.5 * (z2.powi(3) * (z2 / 576.0 - 1.0 / 72.0)).ln_1p(),
        // trace 2 − z², determinant 1
        Scheme::Of(SemiImplicitEuler | Verlet) if z > 2.0 => (0.5 * z2 - 1.0).acosh(),
        Scheme::Of(SemiImplicitEuler | Verlet) => 0.0,
        // trace 2 − z²/(1 + z²/12), determinant 1
        Scheme::FoxGoodwin if z2 > 6.0 => (0.5 * z2 / (1.0 + z2 / 12.0) - 1.0).acosh(),
        Scheme::FoxGoodwin => 0.0,
        // Roots on the unit circle.
        Scheme::Of(ImplicitMidpoint | Newmark) => 0.0,
        // 1 / |1 − iz|; generalized-α and BDF2 damp too.
        _ => -0.5 * z2.ln_1p(),
    }
}

/// Initial amplitude of the highest mode, m; the body's elements have edges of 1 m.
const AMPLITUDE: f64 = 1e-4;

/// e-folds of that amplitude until the energy ledger has certainly ended the run.
const TO_DIVERGENCE: f64 = 2.5;

/// e-folds that leave its gain of energy below the 5 % of the ledger.
const SMALL: f64 = 0.015;

/// The prediction for an integrator at a time step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Forecast {
    /// Steps that show the outcome.
    pub steps: usize,
    /// The predicted outcome.
    pub expected: Outcome,
    /// ω_max dt over the stability limit. If that is 0: e-folds in these steps over those that end the run. `None` for
    /// unconditionally stable integrators.
    pub margin: Option<f64>,
}

/// Predicts the outcome of the highest mode at z = ω dt within `most` steps.
pub fn forecast(scheme: impl Into<Scheme>, z: f64, most: usize) -> Forecast {
    let scheme = scheme.into();
    let Some(limit) = limit(scheme) else {
        return Forecast { steps: most.min(60), expected: Outcome::Survives, margin: None };
    };
    let growth = growth(scheme, z);
    let (steps, expected) = if growth > 0.0 && 1.5 * TO_DIVERGENCE / growth < most as f64 {
        (20 + (1.5 * TO_DIVERGENCE / growth) as usize, Outcome::Explodes)
    } else if growth > 0.0 {
        (most.min((SMALL / growth) as usize).max(1), Outcome::Survives)
    } else {
        (most.min(500), Outcome::Survives)
    };
    let margin = if limit > 0.0 { z / limit } else { growth * steps as f64 / TO_DIVERGENCE };
    Forecast { steps, expected, margin: Some(margin) }
}

/// Runs a setup and compares it with a forecast.
pub fn try_forecast(setup: &Setup, forecast: Forecast, deadline: Deadline) -> Result<Finding, Finding> {
    let mut simulation = setup.build()?;
    excite(&mut simulation, AMPLITUDE)?;
    let found = march(&mut simulation, forecast.steps, deadline).survival();
    Ok(Finding { margin: forecast.margin.or(found.margin), ..found })
}

/// The clamped body of the forecasts and the maps.
pub fn clamped(integrator: Integrator, law: &'static str, young: f64, dt: f64) -> Setup {
    Setup { young, dt, ..Setup::small(integrator, law).with(clamp) }
}

/// The highest natural frequency of that body with this material, these elements and E = 1 Pa, 1/s. It is proportional to √E.
pub fn unit_omega(law: &'static str, elements: Elements) -> f64 {
    let simulation = Setup { elements, ..clamped(Integrator::Verlet, law, 1.0, 1.0) }.build();
    let mode = simulation.ok().and_then(|simulation| mode_of(&simulation).ok());
    mode.map_or(f64::NAN, |mode| mode.omega)
}

/// Sets the initial displacement to the highest mode, with this amplitude, m.
pub fn excite(simulation: &mut Simulator<f64>, amplitude: f64) -> Result<HighestMode, Finding> {
    let mode = mode_of(simulation)?;
    let shape = simulation.system().numbering.to_mesh(&mode.shape);
    let displacements: Vec<[f64; 3]> = shape.iter().map(|u| u.map(|u| amplitude * u)).collect();
    simulation.set_state(&displacements, &vec![[0.0; 3]; shape.len()]);
    Ok(mode)
}

fn mode_of(simulation: &Simulator<f64>) -> Result<HighestMode, Finding> {
    let mut random = Random::new(1);
    let start = std::iter::repeat_with(|| random.vector().into()).take(simulation.system().nodes()).collect();
    let mode = highest_mode(simulation.system(), start);
    mode.map_err(|cause| Finding::plain(Outcome::Deviates, format!("no natural frequency: {cause:?}")))
}

#[cfg(test)]
mod tests {
    use fem_model::Integrator;

    use super::{growth, limit};

    #[test]
    fn vibrations_grow_above_the_limit_only() {
        for integrator in [Integrator::SemiImplicitEuler, Integrator::Verlet, Integrator::Rk4] {
            let limit = limit(integrator).unwrap();
            assert!(
                growth(integrator, 0.99 * limit) <= 0.0 && growth(integrator, 1.01 * limit) > 0.03,
                "{integrator:?}"
            );
        }
        assert!(growth(Integrator::Rk2, 0.1) > 0.0 && growth(Integrator::ExplicitEuler, 0.1) > 0.0);
        assert!(growth(Integrator::ImplicitEuler, 1e6) < -13.0);
    }
}

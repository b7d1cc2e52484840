//! Predictions of linear stability theory for a clamped body, and the runs that test them.

use fem_engine::simulator::Simulator;
use fem_model::Integrator;

use super::case::{Finding, Outcome};
use super::initial_state::Random;
use super::march::march;
use super::scene_text::{CLAMPED, SceneText};
use super::theory::{self, HighestMode, Scheme};
use crate::scenes::Elements;
use crate::study::Deadline;

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
    let Some(limit) = theory::limit(scheme) else {
        return Forecast { steps: most.min(60), expected: Outcome::Survives, margin: None };
    };
    let growth = theory::growth(scheme, z);
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

/// Runs a scene and compares it with a forecast.
pub fn try_forecast(text: &SceneText, forecast: Forecast, deadline: Deadline) -> Result<Finding, Finding> {
    let mut simulation = text.build()?;
    excite(&mut simulation, AMPLITUDE)?;
    let found = march(&mut simulation, forecast.steps, deadline).survival();
    Ok(Finding { margin: forecast.margin.or(found.margin), ..found })
}

/// The clamped body of the forecasts and the maps.
pub fn clamped(integrator: Integrator, model: &'static str, young: f64, dt: f64) -> SceneText {
    SceneText { young, dt, ..SceneText::small(integrator, model).with(CLAMPED) }
}

/// The highest natural frequency of that body with this material, these elements and E = 1 Pa, 1/s. It is proportional to √E.
pub fn unit_omega(model: &'static str, elements: Elements) -> f64 {
    let simulation = SceneText { elements, ..clamped(Integrator::Verlet, model, 1.0, 1.0) }.build();
    let mode = simulation.ok().and_then(|simulation| highest_mode(&simulation).ok());
    mode.map_or(f64::NAN, |mode| mode.omega)
}

/// Sets the initial displacement to the highest mode, with this amplitude, m.
pub fn excite(simulation: &mut Simulator<f64>, amplitude: f64) -> Result<HighestMode, Finding> {
    let mode = highest_mode(simulation)?;
    let shape = simulation.system().numbering.to_mesh(&mode.shape);
    let displacements: Vec<[f64; 3]> = shape.iter().map(|u| u.map(|u| amplitude * u)).collect();
    simulation.set_state(&displacements, &vec![[0.0; 3]; shape.len()]);
    Ok(mode)
}

fn highest_mode(simulation: &Simulator<f64>) -> Result<HighestMode, Finding> {
    let mut random = Random::new(1);
    let start = std::iter::repeat_with(|| random.vector().into()).take(simulation.system().nodes()).collect();
    let mode = theory::highest_mode(simulation.system(), start);
    mode.map_err(|cause| Finding::plain(Outcome::Deviates, format!("no natural frequency: {cause:?}")))
}

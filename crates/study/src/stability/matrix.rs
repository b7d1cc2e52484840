//! Soft to stiff, short steps to long ones: each method with each law.

use super::case::{Case, Clock, Finding, Outcome};
use super::march::{SMALLEST_J, march};
use super::scene_text::{CLAMPED, DYNAMIC, LAWS, Text, gravity};
use super::theory::{self, Fastest};
use fem_engine::simulator::Simulator;

const FAMILY: &str = "stiffness and time step";

/// Pa
pub const YOUNG: [f64; 4] = [1e2, 1e5, 1e8, 1e12];

/// s
pub const DT: [f64; 3] = [1e-5, 1e-2, 1.0];

/// Where the fastest vibration starts, m; the body's elements have edges of 1 m.
const AMPLITUDE: f64 = 1e-4;

/// How a vibration that starts small ends: e-folds until an element is inside out, and until numbers overflow.
const TO_INVERSION: f64 = 12.0;
const TO_OVERFLOW: f64 = 800.0;

/// e-folds that leave a vibration small.
const SMALL: f64 = 2.0;

/// What theory says of a method at a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Forecast {
    /// Steps that show it.
    pub steps: usize,
    /// What they end in.
    pub expected: Outcome,
    /// ω_max dt over the method's limit; where that is 0, e-folds in these steps over those that end the run. None where the
    /// method has no limit.
    pub margin: Option<f64>,
}

/// What must become of the fastest vibration, at z = ω dt, within `most` steps.
pub fn forecast(integrator: &str, model: &str, z: f64, most: usize) -> Forecast {
    let Some(limit) = theory::limit(integrator) else {
        return Forecast { steps: most.min(60), expected: Outcome::Survives, margin: None };
    };
    let growth = theory::growth(integrator, z);
    let needed = if model == "neo_hookean" { TO_INVERSION } else { TO_OVERFLOW };
    let (steps, expected) = if growth > 0.0 && 1.5 * needed / growth < most as f64 {
        (20 + (1.5 * needed / growth) as usize, Outcome::Explodes)
    } else if growth > 0.0 {
        (most.min((SMALL / growth) as usize).max(1), Outcome::Survives)
    } else {
        (most.min(500), Outcome::Survives)
    };
    let margin = if limit > 0.0 { z / limit } else { growth * steps as f64 / needed };
    Forecast { steps, expected, margin: Some(margin) }
}

/// What the margins of a method are.
fn margin_is(integrator: &str) -> &'static str {
    match theory::limit(integrator) {
        None => SMALLEST_J,
        Some(0.0) => "e-folds of the fastest vibration over those that end the run; no step is stable",
        Some(_) => "dt / dt_limit; stable below 1",
    }
}

/// The body of this chapter and of the maps.
pub fn clamped(integrator: &'static str, model: &'static str, young: f64, dt: f64) -> Text {
    Text { young, dt, ..Text::small(integrator, model).with(CLAMPED) }
}

/// The fastest vibration of that body, 1/s, at E = 1 Pa: it grows with the root of E.
pub fn unit_omega() -> f64 {
    let simulation = clamped("verlet", "linear", 1.0, 1.0).build();
    let fastest = simulation.ok().and_then(|simulation| theory::fastest(simulation.system()).ok());
    fastest.map_or(f64::NAN, |fastest| fastest.omega)
}

/// Starts in the shape of the fastest vibration.
pub fn excite(simulation: &mut Simulator<f64>, amplitude: f64) -> Result<Fastest, Finding> {
    let fastest = theory::fastest(simulation.system());
    let fastest = fastest.map_err(|cause| Finding::plain(Outcome::Deviates, format!("no frequency: {cause:?}")))?;
    let numbering = &simulation.system().numbering;
    let shape = numbering.to_mesh(&fastest.shape);
    let displacements: Vec<[f64; 3]> = shape.iter().map(|u| u.map(|u| amplitude * u)).collect();
    simulation.set_state(&displacements, &vec![[0.0; 3]; shape.len()]);
    Ok(fastest)
}

/// Runs what a forecast is about.
pub fn try_forecast(text: &Text, forecast: Forecast, clock: Clock) -> Finding {
    let tried = || {
        let mut simulation = text.build()?;
        excite(&mut simulation, AMPLITUDE)?;
        let found = march(&mut simulation, forecast.steps, clock).survival();
        Ok(Finding { margin: forecast.margin.or(found.margin), ..found })
    };
    tried().unwrap_or_else(|finding| finding)
}

/// Adds the chapter.
pub fn add(cases: &mut Vec<Case>, quick: bool) {
    let omega = unit_omega();
    let laws: &[&str] = if quick { &LAWS[3..] } else { &LAWS };
    for integrator in DYNAMIC {
        for &model in laws {
            for young in YOUNG {
                for dt in DT {
                    cases.push(vibrating(integrator, model, young, dt, omega, quick));
                }
            }
        }
    }
    add_weighed(cases, quick);
}

fn vibrating(integrator: &'static str, model: &'static str, young: f64, dt: f64, unit_omega: f64, quick: bool) -> Case {
    let z = unit_omega * young.sqrt() * dt;
    let forecast = forecast(integrator, model, z, if quick { 2000 } else { 20_000 });
    Case {
        family: FAMILY,
        case: "clamped body, vibrating".to_owned(),
        parameters: format!("E = {young:e} Pa, dt = {dt:e} s, dt omega_max = {z:.3e}, {} steps", forecast.steps),
        integrator: integrator.to_owned(),
        material: model.to_owned(),
        expected: forecast.expected,
        margin_is: margin_is(integrator),
        seed: None,
        work: Box::new(move |clock| try_forecast(&clamped(integrator, model, young, dt), forecast, clock)),
    }
}

/// Under a weight as large as its stiffness: ρ g L = E.
fn add_weighed(cases: &mut Vec<Case>, quick: bool) {
    let methods = [("implicit_euler", DT[0]), ("implicit_euler", DT[1]), ("implicit_euler", DT[2]), ("static", 1.0)];
    for model in ["neo_hookean", "stable_neo_hookean"] {
        for young in if quick { &YOUNG[..1] } else { &YOUNG } {
            for (integrator, dt) in methods {
                for (name, direction) in [("sagging", [0.0, 0.0, -1.0]), ("hanging", [1.0, 0.0, 0.0])] {
                    let text = clamped(integrator, model, *young, dt);
                    let g = text.young / (text.density * 2.0);
                    let text = text.with(&gravity(direction.map(|x| x * g)));
                    cases.push(weighed(name, text, if integrator == "static" { 1 } else { 50 }));
                }
            }
        }
    }
}

fn weighed(name: &str, text: Text, steps: usize) -> Case {
    Case {
        family: FAMILY,
        case: format!("clamped body, {name} under a weight of E times its cross-section"),
        parameters: format!("E = {:e} Pa, dt = {:e} s, {steps} steps", text.young, text.dt),
        integrator: text.integrator.to_owned(),
        material: text.model.to_owned(),
        expected: Outcome::Survives,
        margin_is: SMALLEST_J,
        seed: None,
        work: Box::new(move |clock| match text.build() {
            Ok(mut simulation) => march(&mut simulation, steps, clock).survival(),
            Err(finding) => finding,
        }),
    }
}

//! Soft to stiff bodies, short to long time steps: each integrator with each material.

use super::*;
use fem_model::Integrator;
use fem_reference::LINEAR;

const FAMILY: &str = "stiffness and time step";

/// Young's moduli, Pa.
pub const YOUNG: [f64; 4] = [1e2, 1e5, 1e8, 1e12];

/// Time steps, s.
pub const DT: [f64; 3] = [1e-5, 1e-2, 1.0];

/// The margin of an integrator.
fn margin_is(integrator: Integrator) -> &'static str {
    match theory::limit(integrator) {
        None => SMALLEST_J,
        Some(0.0) => "e-folds of the highest mode over those that end the run; no step is stable",
        Some(_) => "dt / dt_limit; stable below 1",
    }
}

/// Adds the family.
pub fn add(cases: &mut Vec<Case>, quick: bool) {
    let omega = unit_omega("linear", LINEAR);
    let laws: &[&str] = if quick { &LAWS[3..] } else { &LAWS };
    for (((integrator, &law), young), dt) in pairs(pairs(pairs(dynamic(), laws), YOUNG), DT) {
        cases.push(vibrating(clamped(integrator, law, young, dt), omega, quick));
    }
    for (law, &young) in pairs(NEO_HOOKEAN, if quick { &YOUNG[..1] } else { &YOUNG }) {
        add_weighed(cases, 1.0, |integrator, dt| clamped(integrator, law, young, dt));
    }
}

/// A clamped body whose highest mode at E = 1 Pa has this frequency, 1/s.
pub fn vibrating(setup: Setup, unit_omega: f64, quick: bool) -> Case {
    let Setup { integrator, law, young, dt, .. } = setup;
    let z = unit_omega * young.sqrt() * dt;
    let forecast = forecast(integrator, z, if quick { 2000 } else { 20_000 });
    let parameters = format!("E = {young:e} Pa, dt = {dt:e} s, dt omega_max = {z:.3e}, {} steps", forecast.steps);
    Case {
        expected: thrown(integrator, law, z).unwrap_or(forecast.expected),
        margin_is: margin_is(integrator),
        ..setup.case(FAMILY, "clamped body, vibrating", parameters, move |setup, deadline| {
            try_forecast(setup, forecast, deadline)
        })
    }
}

/// The end of a vibration of St. Venant–Kirchhoff's law, which softens in compression, if a step of Newmark's method, many of its periods
/// long, throws elements through themselves: it gains energy.
fn thrown(integrator: Integrator, model: &str, z: f64) -> Option<Outcome> {
    let is_thrown = integrator == Integrator::Newmark && model == "st_venant_kirchhoff" && (50.0..100.0).contains(&z);
    is_thrown.then_some(Outcome::Explodes)
}

/// Under a weight of a part of the stiffness, ρ g L = part E: sagging and hanging, in motion and in equilibrium.
pub fn add_weighed(cases: &mut Vec<Case>, part: f64, clamped: impl Fn(Integrator, f64) -> Setup) {
    let methods = [
        (Integrator::ImplicitEuler, DT[0]),
        (Integrator::ImplicitEuler, DT[1]),
        (Integrator::ImplicitEuler, DT[2]),
        (Integrator::Static, 1.0),
    ];
    let directions = [("sagging", [0.0, 0.0, -1.0]), ("hanging", [1.0, 0.0, 0.0])];
    for ((integrator, dt), (name, direction)) in pairs(methods, directions) {
        let setup = clamped(integrator, dt);
        let g = part * setup.young / (setup.density * 2.0);
        let setup = setup.with(gravity(direction.map(|x| x * g)));
        cases.push(weighed(name, part, setup, if integrator == Integrator::Static { 1 } else { 50 }));
    }
}

fn weighed(name: &str, part: f64, setup: Setup, steps: usize) -> Case {
    let of = if part == 1.0 { "E".to_owned() } else { format!("{part} E") };
    let case = format!("clamped body, {name} under a weight of {of} times its cross-section");
    let nu = if setup.poisson == 0.3 { String::new() } else { format!("nu = {}, ", setup.poisson) };
    let parameters = format!("{nu}E = {:e} Pa, dt = {:e} s, {steps} steps", setup.young, setup.dt);
    setup.surviving(FAMILY, case, parameters, steps)
}

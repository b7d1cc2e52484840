//! Each method at its limit: just below and just above, and how fast vibrations grow or decay.

use super::case::{Case, Clock, Finding, Outcome};
use super::march::march;
use super::matrix::{clamped, excite, forecast, try_forecast};
use super::scene_text::{DYNAMIC, LUMPED, Text};
use super::theory;
use fem_engine::simulator::Simulator;
use fem_scene::simulation::Simulation;

const FAMILY: &str = "limits of stability";

/// Steps that show a slow growth.
const MOST: usize = 40_000;

/// Adds the chapter.
pub fn add(cases: &mut Vec<Case>, quick: bool) {
    let parts: &[f64] = if quick { &[0.99, 1.01] } else { &[0.5, 0.9, 0.98, 0.99, 1.01, 1.02, 1.1, 2.0] };
    for integrator in ["semi_implicit_euler", "verlet", "rk4"] {
        for mass in ["", LUMPED] {
            cases.extend(parts.iter().map(|&part| near(integrator, "linear", mass, part)));
            // Its frequencies change with the amplitude, by less than these.
            cases.extend([0.9, 1.1].map(|part| near(integrator, "neo_hookean", mass, part)));
        }
    }
    for integrator in DYNAMIC {
        for z in [0.1, 0.5, 1.0, 1.9, 2.5, 3.0, 30.0] {
            cases.push(growing(integrator, z));
        }
    }
}

/// At a part of the largest stable step of its own mesh, mass and stiffness.
fn near(integrator: &'static str, model: &'static str, mass: &'static str, part: f64) -> Case {
    let limit = theory::limit(integrator).unwrap_or(f64::INFINITY);
    let forecast = forecast(integrator, model, part * limit, MOST);
    let name = if mass.is_empty() { "consistent" } else { "lumped" };
    Case {
        family: FAMILY,
        case: format!("{part} of the largest stable step"),
        parameters: format!("E = 1e5 Pa, {name} mass, dt omega_max = {:.4}, {} steps", part * limit, forecast.steps),
        integrator: integrator.to_owned(),
        material: model.to_owned(),
        expected: forecast.expected,
        margin_is: "dt / dt_limit; stable below 1",
        seed: None,
        work: Box::new(move |clock| {
            let text = clamped(integrator, model, 1e5, 1.0).with(mass);
            with_step(&text, part * limit, |text| try_forecast(&text, forecast, clock))
        }),
    }
}

/// Gives the scene the step at which its fastest vibration has ω dt = z.
fn with_step(text: &Text, z: f64, work: impl FnOnce(Text) -> Finding) -> Finding {
    let omega = text.build().and_then(|mut simulation| Ok(excite(&mut simulation, 0.0)?.omega));
    match omega {
        Ok(omega) => work(Text { dt: z / omega, ..text.clone() }),
        Err(finding) => finding,
    }
}

/// Grows or decays as fast as theory says.
fn growing(integrator: &'static str, z: f64) -> Case {
    let growth = theory::growth(integrator, z);
    let expected =
        if growth > 0.0 && steps_to_overflow(growth) <= MOST { Outcome::Explodes } else { Outcome::Survives };
    Case {
        family: FAMILY,
        case: "rate of growth of the fastest vibration".to_owned(),
        parameters: format!("dt omega_max = {z}, theory: {growth:.4e} e-folds a step"),
        integrator: integrator.to_owned(),
        material: "linear".to_owned(),
        expected,
        margin_is: "measured e-folds a step over those of theory; must be within 1 % of 1",
        seed: None,
        work: Box::new(move |clock| {
            let text = clamped(integrator, "linear", 1e5, 1.0);
            with_step(&text, z, |text| measured(&text, growth, clock))
        }),
    }
}

/// Steps in which a vibration of 1 m grows beyond all numbers, with some to spare.
fn steps_to_overflow(growth: f64) -> usize {
    (800.0 / growth) as usize + 10
}

/// Steps at the start in which semi-implicit methods settle to their rate.
const SETTLED: usize = 4;

fn measured(text: &Text, growth: f64, clock: Clock) -> Finding {
    let mut simulation = match text.build() {
        Ok(simulation) => simulation,
        Err(finding) => return finding,
    };
    if let Err(finding) = excite(&mut simulation, 1.0) {
        return finding;
    }
    // What has decayed too far is no longer that vibration; what has grown too far no number.
    let count = if growth < 0.0 { 5.0 / -growth } else { 100.0 / growth.max(2.5) }.clamp(1.0, 40.0) as usize;
    let (mut sizes, start) = (Vec::new(), amplitude(&simulation));
    for _ in 0..SETTLED + count {
        if let Err(failure) = simulation.step() {
            return Finding::plain(Outcome::Deviates, format!("too early: {failure}"));
        }
        sizes.push(amplitude(&simulation));
    }
    if growth == 0.0 {
        let end = march(&mut simulation, 1000, clock);
        let swing = sizes.into_iter().fold(amplitude(&simulation), f64::max) / start;
        let outcome = if end.failure.is_none() && swing < 20.0 { Outcome::Survives } else { Outcome::Deviates };
        return Finding::plain(
            outcome,
            format!("nothing may grow; at most {swing:.3} times the start, {}", end.note()),
        );
    }
    let first = if growth < 0.0 { 0 } else { SETTLED - 1 };
    let rate = (sizes[first + count] / sizes[first]).ln() / count as f64;
    rated(&mut simulation, rate, growth, clock)
}

/// The rate beside that of theory; what grows fast enough goes on to its end.
fn rated(simulation: &mut Simulator<f64>, rate: f64, growth: f64, clock: Clock) -> Finding {
    let (ratio, note) = (rate / growth, format!("{rate:.4e} e-folds a step"));
    if !((ratio - 1.0).abs() <= 0.01) {
        return Finding::new(Outcome::Deviates, ratio, note);
    }
    if growth < 0.0 || steps_to_overflow(growth) > MOST {
        return Finding::new(Outcome::Survives, ratio, note);
    }
    let end = march(simulation, steps_to_overflow(growth), clock);
    match &end.failure {
        Some(failure) => Finding::new(Outcome::Explodes, ratio, format!("{note}; {failure}")),
        None => Finding::new(Outcome::Deviates, ratio, format!("{note}, and no end after {}", end.note())),
    }
}

/// √(kinetic + potential energy): of a single vibration, a multiple of its amplitude.
fn amplitude(simulation: &Simulator<f64>) -> f64 {
    simulation.energies().total().max(0.0).sqrt()
}

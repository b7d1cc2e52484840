//! Each integrator near its stability limit, and the growth rate of the highest mode.

use fem_engine::simulator::Simulator;
use fem_model::Integrator;
use fem_model::simulation::Simulation;

use super::*;

const FAMILY: &str = "stability limits";

/// Steps that show slow growth.
const MOST: usize = 40_000;

/// Adds the family.
pub fn add(cases: &mut Vec<Case>, quick: bool) {
    let parts: &[f64] = if quick { &[0.99, 1.01] } else { &[0.5, 0.9, 0.98, 0.99, 1.01, 1.02, 1.1, 2.0] };
    let schemes = [Integrator::SemiImplicitEuler, Integrator::Verlet, Integrator::Rk4].map(Scheme::Of);
    for (scheme, is_lumped) in pairs(schemes.into_iter().chain([Scheme::FoxGoodwin]), [false, true]) {
        cases.extend(parts.iter().map(|&part| near(scheme, "linear", is_lumped, part)));
        // Natural frequencies of the nonlinear material change with the amplitude, by less than a tenth.
        cases.extend([0.9, 1.1].map(|part| near(scheme, "neo_hookean", is_lumped, part)));
    }
    // They have more roots or stages, whose sum shows no rate at first; tests of the engine measure their damping.
    let others = [Integrator::GeneralizedAlpha, Integrator::Bdf2, Integrator::Bathe];
    let measured = dynamic().filter(|integrator| !others.contains(integrator));
    let growths = pairs(measured, [0.1, 0.5, 1.0, 1.9, 2.5, 3.0, 30.0]);
    cases.extend(growths.map(|(integrator, z)| growing(integrator, z)));
}

/// At a part of the stability limit for the body's own mesh, mass and stiffness.
fn near(scheme: Scheme, law: &'static str, is_lumped: bool, part: f64) -> Case {
    let z = part * theory::limit(scheme).unwrap_or(f64::INFINITY);
    let forecast = forecast(scheme, z, MOST);
    let (setup, note) = match scheme {
        Scheme::FoxGoodwin => {
            let newmark = clamped(Integrator::Newmark, law, 1e5, 1.0);
            (newmark.set(|method| method.newmark.beta = 0.083333333333), ", beta = 1/12")
        }
        Scheme::Of(integrator) => (clamped(integrator, law, 1e5, 1.0), ""),
    };
    let setup = setup.with_if(is_lumped, lump);
    let name = if is_lumped { "lumped" } else { "consistent" };
    let parameters = format!("E = 1e5 Pa, {name} mass{note}, dt omega_max = {z:.4}, {} steps", forecast.steps);
    Case {
        expected: forecast.expected,
        margin_is: "dt / dt_limit; stable below 1",
        ..setup.case(FAMILY, format!("{part} of the largest stable step"), parameters, move |setup, deadline| {
            try_forecast(&with_step(setup, z)?, forecast, deadline)
        })
    }
}

/// Sets the time step at which ω_max dt = z.
fn with_step(setup: &Setup, z: f64) -> Result<Setup, Finding> {
    let omega = excite(&mut setup.build()?, 0.0)?.omega;
    Ok(Setup { dt: z / omega, ..setup.clone() })
}

/// Growth or decay of the highest mode against theory.
fn growing(integrator: Integrator, z: f64) -> Case {
    let growth = theory::growth(integrator, z);
    let explodes = growth > 0.0 && steps_to_overflow(growth) <= MOST;
    let setup = clamped(integrator, "linear", 1e5, 1.0);
    let parameters = format!("dt omega_max = {z}, theory: {growth:.4e} e-folds per step");
    Case {
        expected: if explodes { Outcome::Explodes } else { Outcome::Survives },
        margin_is: "measured e-folds per step over those of theory; must be within 1 % of 1",
        ..setup.case(FAMILY, "growth rate of the highest mode", parameters, move |setup, deadline| {
            measured(&with_step(setup, z)?, growth, deadline)
        })
    }
}

/// Steps in which an amplitude of 1 m overflows, with a margin.
fn steps_to_overflow(growth: f64) -> usize {
    (800.0 / growth) as usize + 10
}

/// First steps, in which semi-implicit integrators approach their growth rate.
const SETTLED: usize = 4;

fn measured(setup: &Setup, growth: f64, deadline: Deadline) -> Result<Finding, Finding> {
    let mut simulation = setup.build()?;
    excite(&mut simulation, 1.0)?;
    simulation.accept_gain(true);
    // Few enough steps that decay does not reach round-off and growth does not overflow.
    let count = if growth < 0.0 { 5.0 / -growth } else { 100.0 / growth.max(2.5) }.clamp(1.0, 40.0) as usize;
    let (mut sizes, start) = (Vec::new(), amplitude(&simulation));
    for _ in 0..SETTLED + count {
        if let Err(failure) = simulation.step() {
            return Ok(Finding::plain(Outcome::Deviates, format!("too early: {failure}")));
        }
        sizes.push(amplitude(&simulation));
    }
    simulation.accept_gain(false);
    if growth == 0.0 {
        let end = march(&mut simulation, 1000, deadline);
        let swing = sizes.into_iter().fold(amplitude(&simulation), f64::max) / start;
        let outcome = if end.failure.is_none() && swing < 20.0 { Outcome::Survives } else { Outcome::Deviates };
        let note = format!("theory: no growth; largest amplitude {swing:.3} of the first, {}", end.note());
        return Ok(Finding::plain(outcome, note));
    }
    let first = if growth < 0.0 { 0 } else { SETTLED - 1 };
    let rate = (sizes[first + count] / sizes[first]).ln() / count as f64;
    Ok(rated(&mut simulation, rate, growth, deadline))
}

/// The rate against theory. A run that must overflow continues until it does.
fn rated(simulation: &mut Simulator<f64>, rate: f64, growth: f64, deadline: Deadline) -> Finding {
    let (ratio, note) = (rate / growth, format!("{rate:.4e} e-folds per step"));
    if !((ratio - 1.0).abs() <= 0.01) {
        return Finding::new(Outcome::Deviates, ratio, note);
    }
    if growth < 0.0 || steps_to_overflow(growth) > MOST {
        return Finding::new(Outcome::Survives, ratio, note);
    }
    let end = march(simulation, steps_to_overflow(growth), deadline);
    match &end.failure {
        Some(failure) => Finding::new(Outcome::Explodes, ratio, format!("{note}; {failure}")),
        None => Finding::new(Outcome::Deviates, ratio, format!("{note}, but no overflow in {}", end.note())),
    }
}

/// √(kinetic + potential energy), which is proportional to the amplitude of a single mode.
fn amplitude(simulation: &Simulator<f64>) -> f64 {
    simulation.energies().total().max(0.0).sqrt()
}

//! Maps: the outcome of a vibrating body for pairs of stiffness and time step, one map for each integrator.

use fem_model::Integrator;
use std::ops::RangeInclusive;

use super::*;
use fem_reference::LINEAR;

/// Young's moduli, from bottom to top: powers of ten, Pa.
pub const EXPONENTS_OF_YOUNG: RangeInclusive<i32> = 2..=12;

/// Time steps per decade, from 10⁻⁵ s to 1 s.
pub const PARTS_OF_DT: i32 = 2;

/// Number of time steps.
pub const TIME_STEPS: usize = 11;

/// Adds a case for the map of each integrator.
pub fn add(cases: &mut Vec<Case>, quick: bool) {
    let omega = unit_omega("linear", LINEAR);
    let count = EXPONENTS_OF_YOUNG.count() * TIME_STEPS;
    for integrator in dynamic() {
        let parameters = format!("{count} pairs, E = 1e2 to 1e12 Pa, dt = 1e-5 to 1 s");
        let setup = clamped(integrator, "neo_hookean", 1.0, 1.0);
        let work = move |_: &Setup, deadline| {
            let map = map(integrator, omega, if quick { 300 } else { 4000 }, deadline);
            let finding = judged(&map);
            Ok(Finding { map: Some(map), ..finding })
        };
        cases.push(Case {
            margin_is: "share of the pairs with an outcome against theory; must be 0",
            ..setup.case("maps of stiffness and time step", "clamped body, vibrating", parameters, work)
        });
    }
}

fn map(integrator: Integrator, omega: f64, most: usize, deadline: Deadline) -> Map {
    let mut cells = Vec::new();
    for exponent in EXPONENTS_OF_YOUNG {
        for part in 0..TIME_STEPS as i32 {
            let (young, dt) = (10f64.powi(exponent), 10f64.powf(f64::from(part) / f64::from(PARTS_OF_DT) - 5.0));
            let z = omega * young.sqrt() * dt;
            let forecast = forecast(integrator, z, most);
            let setup = clamped(integrator, "neo_hookean", young, dt);
            let found = try_forecast(&setup, forecast, deadline).unwrap_or_else(|finding| finding);
            let (steps, expected) = (forecast.steps, forecast.expected);
            cells.push(Cell { young, dt, z, steps, expected, outcome: found.outcome, note: found.note });
        }
    }
    let limit = largest(integrator, most).map(|z| (z / omega).powi(2));
    Map { integrator, limit, most_steps: most, cells }
}

/// ω_max dt below which a run of `most` steps survives.
fn largest(integrator: Integrator, most: usize) -> Option<f64> {
    let limit = theory::limit(integrator)?;
    if limit > 0.0 {
        return Some(limit);
    }
    // Growth increases with z.
    let explodes = |z: &f64| forecast(integrator, *z, most).expected == Outcome::Explodes;
    (0..4000).map(|i| 10f64.powf(f64::from(i) / 1000.0 - 3.0)).find(explodes)
}

fn judged(map: &Map) -> Finding {
    let wrong: Vec<&Cell> = map.cells.iter().filter(|cell| cell.outcome != cell.expected).collect();
    let exploded = map.cells.iter().filter(|cell| cell.outcome == Outcome::Explodes).count();
    let outcome = if wrong.is_empty() { Outcome::Survives } else { Outcome::Deviates };
    let told = |cell: &&Cell| format!("; E = {:e}, dt = {:.2e}: {}", cell.young, cell.dt, cell.outcome);
    let list: String = wrong.iter().map(told).collect();
    Finding::new(outcome, wrong.len() as f64 / map.cells.len() as f64, format!("{exploded} runs diverge{list}"))
}

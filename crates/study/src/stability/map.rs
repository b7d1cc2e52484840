//! What becomes of a vibrating body for each pair of stiffness and time step, method by method.

use std::sync::{Arc, Mutex};

use serde::Serialize;

use super::case::{Case, Clock, Finding, Outcome};
use super::matrix::{clamped, forecast, try_forecast, unit_omega};
use super::scene_text::DYNAMIC;
use super::theory;

/// Young's moduli, from bottom to top: powers of ten, Pa.
pub const EXPONENTS_OF_YOUNG: std::ops::RangeInclusive<i32> = 2..=12;

/// Time steps from left to right: so many parts of a decade, from 10⁻⁵ s to 1 s.
pub const PARTS_OF_DT: i32 = 2;

/// Number of time steps.
pub const TIME_STEPS: usize = 11;

/// All pairs of one method.
#[derive(Clone, Debug, Serialize)]
pub struct Map {
    /// Its name.
    pub integrator: &'static str,
    /// E dt² beyond which it must explode, Pa s²: where ω_max dt reaches its limit; for methods without a stable step where the
    /// fastest vibration grows enough within the run. None where it never must.
    pub limit: Option<f64>,
    /// Steps of the longest run.
    pub most_steps: usize,
    /// Row by row, from the softest up.
    pub cells: Vec<Cell>,
}

/// One pair.
#[derive(Clone, Debug, Serialize)]
pub struct Cell {
    /// Pa
    pub young: f64,
    /// s
    pub dt: f64,
    /// ω_max dt
    pub z: f64,
    /// Steps that were to be taken.
    pub steps: usize,
    /// What theory says.
    pub expected: Outcome,
    /// What happened.
    pub outcome: Outcome,
    /// What was said.
    pub note: String,
}

/// Maps as they are found, one by one.
pub type Found = Arc<Mutex<Vec<Map>>>;

/// Adds a case for the map of each method, which leaves it in `found`.
pub fn add(cases: &mut Vec<Case>, quick: bool, found: &Found) {
    let omega = unit_omega();
    for integrator in DYNAMIC {
        let found = Arc::clone(found);
        let count = EXPONENTS_OF_YOUNG.count() * TIME_STEPS;
        cases.push(Case {
            family: "maps of stiffness and time step",
            case: "clamped body, vibrating".to_owned(),
            parameters: format!("{count} pairs, E = 1e2 to 1e12 Pa, dt = 1e-5 to 1 s"),
            integrator: integrator.to_owned(),
            material: "neo_hookean".to_owned(),
            expected: Outcome::Survives,
            margin_is: "share of the pairs that end otherwise than theory says; must be 0",
            seed: None,
            work: Box::new(move |clock| {
                let map = map(integrator, omega, if quick { 300 } else { 4000 }, clock);
                let finding = judged(&map);
                if let Ok(mut found) = found.lock() {
                    found.push(map);
                }
                finding
            }),
        });
    }
}

fn map(integrator: &'static str, omega: f64, most: usize, clock: Clock) -> Map {
    let mut cells = Vec::new();
    for exponent in EXPONENTS_OF_YOUNG {
        for part in 0..TIME_STEPS as i32 {
            let (young, dt) = (10f64.powi(exponent), 10f64.powf(f64::from(part) / f64::from(PARTS_OF_DT) - 5.0));
            let z = omega * young.sqrt() * dt;
            let forecast = forecast(integrator, "neo_hookean", z, most);
            let found = try_forecast(&clamped(integrator, "neo_hookean", young, dt), forecast, clock);
            let (steps, expected) = (forecast.steps, forecast.expected);
            cells.push(Cell { young, dt, z, steps, expected, outcome: found.outcome, note: found.note });
        }
    }
    let limit = largest(integrator, most).map(|z| (z / omega).powi(2));
    Map { integrator, limit, most_steps: most, cells }
}

/// ω_max dt below which a run of so many steps survives.
fn largest(integrator: &str, most: usize) -> Option<f64> {
    let limit = theory::limit(integrator)?;
    if limit > 0.0 {
        return Some(limit);
    }
    // Growth rises with z.
    let explodes = |z: &f64| forecast(integrator, "neo_hookean", *z, most).expected == Outcome::Explodes;
    (0..4000).map(|i| 10f64.powf(f64::from(i) / 1000.0 - 3.0)).find(explodes)
}

fn judged(map: &Map) -> Finding {
    let wrong: Vec<&Cell> = map.cells.iter().filter(|cell| cell.outcome != cell.expected).collect();
    let exploded = map.cells.iter().filter(|cell| cell.outcome == Outcome::Explodes).count();
    let told = |cell: &&Cell| format!("E = {:e}, dt = {:.2e}: {}", cell.young, cell.dt, cell.outcome);
    let outcome = if wrong.is_empty() { Outcome::Survives } else { Outcome::Deviates };
    let list: String = wrong.iter().map(|cell| format!("; {}", told(cell))).collect();
    Finding::new(outcome, wrong.len() as f64 / map.cells.len() as f64, format!("{exploded} of them explode{list}"))
}

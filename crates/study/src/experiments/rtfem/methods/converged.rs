//! Marks that iterated methods end where Newton's method does.

use fem_model::Integrator;

use super::bodies::Shape;
use super::case::{Case, LAW, distance};
use crate::study::Mark;

/// Settings of a step that ends when iterations no longer change the velocities.
const CONVERGED: &str = "[iterations]\ncount = 20000\ntolerance = 1e-13\n";

/// Largest distance from the converged steps, over their largest displacement.
const SAME: f64 = 1e-8;

/// One mark for each method that promises the steps of implicit Euler.
///
/// # Errors
/// A motion that fails.
pub fn marks(quick: bool) -> Result<Vec<Mark>, String> {
    let cells = if quick { 1 } else { 3 };
    let case = Case { shape: Shape::Beam, cells, young: 1e5, poisson: 0.25, rate: 60, steps: 6 };
    let end = |integrator: Integrator, tables: &str| {
        let mut simulation = case.simulation(LAW, integrator, tables)?;
        let rest = simulation.positions();
        for _ in 0..case.steps {
            simulation.step().map_err(|failure| failure.to_string())?;
        }
        Ok::<_, String>((rest, simulation.positions()))
    };
    let (rest, converged) = end(Integrator::ImplicitEuler, "[newton]\ntolerance = 1e-14\n")?;
    let mark = |(name, integrator): (&str, Integrator)| {
        let apart = distance(&end(integrator, CONVERGED)?.1, &converged) / distance(&converged, &rest);
        let statement =
            format!("{name}, iterated until nothing changes, ends where implicit Euler does within {SAME:e}");
        Ok(Mark::new(statement, format!("{apart:.1e}"), apart <= SAME))
    };
    [("XPBD", Integrator::Xpbd), ("VBD", Integrator::Vbd), ("PD", Integrator::ProjectiveDynamics)]
        .into_iter()
        .map(mark)
        .collect()
}

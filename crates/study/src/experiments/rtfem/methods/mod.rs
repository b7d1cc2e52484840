//! Comparison of methods: Newton's method and its variants, position-based methods and springs on the same bodies, with separate errors
//! of the solver, of the time step and of the model.

mod case;
mod pages;
mod runs;

use std::path::Path;

use fem_model::{Integrator, IterationSettings, Method};

use super::setting::one_thread;
use crate::study::{Mark, Part, Result};
use case::{Case, Shape, distance};
use runs::{ALL, Compared, Contender, FIRST_AT, Limits, STIFF, Swept, sweep};

pub use case::{LAW, block};

/// Poisson's ratio of central springs in space and in the plane, and that of a nearly incompressible body.
const OF_SPRINGS: [f64; 2] = [0.25, 1.0 / 3.0];
const RUBBER: f64 = 0.45;

/// Young's moduli, Pa.
const YOUNGS: [f64; 4] = [1e4, 1e5, 1e6, 1e7];

/// Duration of a run: this part of a second.
const PART_OF_A_SECOND: usize = 5;

/// Runs all methods on all cases, one after the other on one thread.
pub fn run(_: &Path, quick: bool) -> Result<Part> {
    let limits = match quick {
        true => Limits { milliseconds: 10.0, iterations: 20 },
        false => Limits { milliseconds: 20.0, iterations: usize::MAX },
    };
    let compare = |case: Case| one_thread()?.install(|| compared(case, limits));
    let found = cases(quick).into_iter().map(compare).collect::<Result<Vec<_>>>()?;
    let mut marks = one_thread()?.install(|| converged_ends(quick))?;
    marks.extend(springs_where_they_are_fair(&found));
    marks.push(every_run_is_counted(&found));
    marks.extend(newton_first(&found, quick));
    Ok(Part::new(TEXT).marks(marks).tables(pages::tables(&found)).figures(pages::figures(&found)))
}

const TEXT: &str = "A beam of 4 × 1 × 1 m (body-centred cubic lattice) and a strip of 4 × 1 m (equilateral triangles, plane stress), clamped at one end, \
    fall into their bend for a fifth of a second: corotated law, 1000 kg/m³, lumped mass, double precision, one thread. Central springs have ν = 1/4 in space and 1/3 \
    in the plane and no other; ν = 0.45 is where the comparison is unfair to them. Errors are largest distances of a node at the end, over the largest displacement. The \
    solver error is the distance from implicit Euler with Newton's method to round-off at the same time step, the time error that of this motion from the order-16 \
    reference in time, the model error that of the springs' own reference in time; the total error of a run contains all that it has. Times are medians of the steps after the first. \
    The two parameters without a rule for their choice, the spectral radius of Chebyshev's acceleration and the stiffness of PBD, are the best of five values for each case. \
    Times to an error are interpolated between the runs of iterated methods, and not between Newton iterations.";

/// The cases: Poisson's ratios at which springs are fair, at two time steps, and others.
fn cases(quick: bool) -> Vec<Case> {
    let case = |shape, poisson, rate: usize| {
        move |&young: &f64| Case {
            shape,
            cells: if quick { 2 } else { 4 },
            young,
            poisson,
            rate,
            steps: rate / PART_OF_A_SECOND,
        }
    };
    let youngs = if quick { &YOUNGS[1..2] } else { &YOUNGS[..] };
    let all = |shape, poisson, rate| youngs.iter().map(case(shape, poisson, rate)).collect::<Vec<_>>();
    let mut cases = all(Shape::Beam, OF_SPRINGS[0], 60);
    cases.extend(all(Shape::Beam, RUBBER, 60));
    cases.extend(all(Shape::Strip, OF_SPRINGS[1], 60));
    if !quick {
        cases.extend(all(Shape::Beam, OF_SPRINGS[0], 240));
        cases.extend(all(Shape::Beam, OF_SPRINGS[1], 60));
    }
    cases
}

fn compared(case: Case, limits: Limits) -> Result<Compared> {
    let measures = case.measures()?;
    let methods =
        ALL.iter().map(|contender| Swept { contender, runs: sweep(&case, &measures, contender, limits) }).collect();
    Ok(Compared { time_error: measures.time_error(), model_error: measures.model_error(), case, methods })
}

/// Marks that springs are nearer to the elements at their own Poisson's ratio than at 0.45, for each modulus and dimension.
fn springs_where_they_are_fair(found: &[Compared]) -> Option<Mark> {
    let beams = |poisson: f64| {
        found.iter().filter(move |of| of.case.shape == Shape::Beam && of.case.rate == 60 && of.case.poisson == poisson)
    };
    let pairs: Vec<(f64, f64)> =
        beams(OF_SPRINGS[0]).zip(beams(RUBBER)).map(|(fair, unfair)| (fair.model_error, unfair.model_error)).collect();
    let shown: Vec<String> =
        pairs.iter().map(|(fair, unfair)| format!("{:.2} % → {:.2} %", 100.0 * fair, 100.0 * unfair)).collect();
    let statement = "the model error of springs is smaller at ν = 1/4 than at 0.45, for each modulus";
    let holds = pairs.iter().all(|(fair, unfair)| fair < unfair);
    (!pairs.is_empty()).then(|| Mark::new(statement, shown.join(", "), holds))
}

/// A mark with the number of failed runs, each of which has a row.
fn every_run_is_counted(found: &[Compared]) -> Mark {
    let runs = || found.iter().flat_map(|of| &of.methods).flat_map(|swept| &swept.runs);
    let failed = runs().filter(|run| run.has_failed()).count();
    let is_told = runs().all(|run| run.has_failed() != (run.outcome == "done"));
    Mark::new("every run has a row with its outcome", format!("{} runs, {failed} failed", runs().count()), is_told)
}

/// The claim about times, one mark for each method, which a short run does not judge.
fn newton_first(found: &[Compared], quick: bool) -> Vec<Mark> {
    let stiff: Vec<&Compared> = found.iter().filter(|of| of.case.young >= STIFF).collect();
    let iterated = ALL.iter().filter(|contender| contender.is_iterated() && contender.has_solver_error());
    let mark = |contender: &Contender| {
        let before = |of: &&Compared| of.before_newton().into_iter().find(|(name, _)| *name == contender.name);
        let exceptions: Vec<String> = stiff
            .iter()
            .filter_map(|of| before(of).map(|(_, part)| format!("{} ({part:.2} of its time)", of.case.name())))
            .collect();
        let statement = format!(
            "Newton's method reaches a solver error of {FIRST_AT:e} sooner than {} at E ≥ {STIFF:e} Pa",
            contender.name
        );
        let ours = match exceptions.is_empty() {
            true => format!("in all {} cases", stiff.len()),
            false => format!("not in {} of {} cases: {}", exceptions.len(), stiff.len(), exceptions.join("; ")),
        };
        let holds = exceptions.is_empty() && stiff.iter().all(|of| of.newton_arrives());
        Mark::new(statement, ours, holds).unless(quick)
    };
    iterated.map(mark).collect()
}

/// Largest distance from the converged steps, over their largest displacement.
const SAME: f64 = 1e-8;

/// One mark for each method that promises the steps of implicit Euler.
fn converged_ends(quick: bool) -> Result<Vec<Mark>> {
    let cells = if quick { 1 } else { 3 };
    let case = Case { shape: Shape::Beam, cells, young: 1e5, poisson: 0.25, rate: 60, steps: 6 };
    let [rest, converged] = case.converged()?;
    // A step ends when iterations no longer change the velocities.
    let iterations = IterationSettings { count: 20_000, tolerance: Some(1e-13), ..IterationSettings::default() };
    let mark = |(name, integrator): (&str, Integrator)| {
        let [_, end] = case.ends(&Method { iterations, ..Method::new(integrator, case.dt()) })?;
        let apart = distance(&end, &converged) / distance(&converged, &rest);
        let statement =
            format!("{name}, iterated until nothing changes, ends where implicit Euler does within {SAME:e}");
        Ok(Mark::at_most(statement, apart, SAME))
    };
    let promising = [("XPBD", Integrator::Xpbd), ("VBD", Integrator::Vbd), ("PD", Integrator::ProjectiveDynamics)];
    promising.into_iter().map(mark).collect()
}

//! All trials of a function and their results.

use std::collections::{BTreeMap, BTreeSet};

use super::compare::{Check, compare};
use super::random::Random;
use super::trial::{Observed, Trial};
use super::{REFERENCE, elements, meshes, picks, steps};
use grader::implementation::{Answer, Implementation, Local, Trouble};
use grader_child::Exercise;

/// Result of the comparison of a function with the reference.
#[derive(Clone, Debug, Default)]
pub struct Judgement {
    /// Number of calls that were made.
    pub trials: usize,
    /// Worst relative error; `None` if no answer has finite numbers in the right places.
    pub worst_error: Option<f64>,
    /// Failures in the order of the trials.
    pub failures: Vec<Failure>,
    /// Reasons why the function did not answer, by the check of the trial; the first reason of each check.
    pub troubles: BTreeMap<Check, Trouble>,
    /// Number of calls that were answered.
    pub answers: usize,
}

/// One trial that went wrong.
#[derive(Clone, Debug)]
pub struct Failure {
    /// Index of the trial and its name.
    pub trial: (usize, &'static str),
    /// The check that it fails.
    pub check: Check,
    /// The broken rule without figures, which students may read.
    pub rule: &'static str,
    /// The observed and the expected figures, for the instructor.
    pub figures: String,
    /// The input, for the instructor.
    pub input: String,
}

/// Reason why a check of the comparison fails.
#[derive(Clone, Copy, Debug)]
pub enum Reason<'a> {
    /// The function did not answer in one of its trials.
    Trouble(&'a Trouble),
    /// The answer is wrong.
    Wrong(&'a Failure),
}

impl Judgement {
    /// The checks of this function, each with the reason why it fails.
    pub fn checks(&self, function: &str) -> Vec<(Check, Option<Reason<'_>>)> {
        checks(function).into_iter().map(|check| (check, self.reason(check))).collect()
    }

    fn reason(&self, check: Check) -> Option<Reason<'_>> {
        let trouble = match check {
            // Calls are counted in all trials that are answered.
            Check::Calls if self.answers == 0 => self.troubles.values().next(),
            _ => self.troubles.get(&check),
        };
        let failure = || self.failures.iter().find(|failure| failure.check == check);
        trouble.map(Reason::Trouble).or_else(|| failure().map(Reason::Wrong))
    }
}

/// The checks that the comparison of a function makes.
pub fn checks(function: &str) -> Vec<Check> {
    let has_edges = trials(function, 0).iter().any(|trial| trial.edge);
    let has_calls = matches!(function, "linearly_implicit_euler" | "implicit_euler" | "newtons_method");
    let more = [(has_edges, Check::EdgeCases), (has_calls, Check::Calls)];
    let more = more.into_iter().filter(|(is_made, _)| *is_made).map(|(_, check)| check);
    std::iter::once(Check::Agrees).chain(more).collect()
}

/// The trials of a function, drawn anew from a seed; empty if no function has this name.
pub fn trials(function: &str, seed: u64) -> Vec<Trial> {
    let Some(function) = Exercise::from_name(function) else { return Vec::new() };
    let draw = match function {
        Exercise::phi_linear_tetrahedron | Exercise::dphi_linear_tetrahedron_dX => elements::shapes,
        Exercise::psi_neo_hookean | Exercise::dpsi_neo_hookean_dF | Exercise::d2psi_neo_hookean_dF2 => {
            elements::densities
        }
        Exercise::T_linear_tetrahedron => elements::kinetic,
        Exercise::quadrature_single_point => elements::quadratures,
        Exercise::V_linear_tetrahedron | Exercise::dV_linear_tetrahedron_dq | Exercise::d2V_linear_tetrahedron_dq2 => {
            elements::elastic
        }
        Exercise::V_spring_particle_particle | Exercise::dV_spring_particle_particle_dq => elements::springs,
        Exercise::mass_matrix_linear_tetrahedron => elements::masses,
        Exercise::mass_matrix_mesh => meshes::masses,
        Exercise::assemble_forces | Exercise::assemble_stiffness => meshes::assembled,
        Exercise::build_skinning_matrix => meshes::skinnings,
        Exercise::fixed_point_constraints => meshes::constraints,
        Exercise::pick_nearest_vertices => picks::picks,
        Exercise::linearly_implicit_euler | Exercise::implicit_euler => steps::steps,
        Exercise::newtons_method => steps::minima,
    };
    draw(function.name(), &mut Random::new(seed, function))
}

/// Compares a function with the reference. A check ends at the first call that is never answered; after a panic it goes on.
///
/// An error means that the reference itself did not answer: the grader failed, and there is no judgement.
pub fn judge(function: &str, seed: u64, subject: &dyn Implementation, tolerance: f64) -> Answer<Judgement> {
    let mut judgement = Judgement::default();
    let mut ended = BTreeSet::new();
    for (index, trial) in trials(function, seed).iter().enumerate() {
        let check = Check::of(trial);
        if ended.contains(&check) {
            continue;
        }
        judgement.trials += 1;
        let expected = trial.run(&Local(REFERENCE))?;
        match trial.run(subject) {
            Ok(observed) => judgement.add(index, trial, &observed, &expected, tolerance),
            Err(trouble) => {
                if !matches!(trouble, Trouble::Panicked { .. } | Trouble::Missing) {
                    ended.insert(check);
                    subject.begin_check();
                }
                judgement.troubles.entry(check).or_insert(trouble);
            }
        }
    }
    Ok(judgement)
}

impl Judgement {
    fn add(&mut self, index: usize, trial: &Trial, observed: &Observed, expected: &Observed, tolerance: f64) {
        self.answers += 1;
        let verdict = compare(trial, observed, expected, tolerance);
        if let Some(error) = verdict.error {
            self.worst_error = Some(self.worst_error.map_or(error, |worst| worst.max(error)));
        }
        self.failures.extend(verdict.wrongs.into_iter().map(|wrong| Failure {
            trial: (index, trial.name),
            check: wrong.check,
            rule: wrong.rule,
            figures: wrong.figures,
            input: format!("{}: {:?}", trial.name, trial.input),
        }));
    }
}

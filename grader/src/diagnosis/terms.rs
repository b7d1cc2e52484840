//! The terms of the formulas, and of wrong formulas in their place.

mod densities;
mod hessians;
mod masses;
mod springs;
mod stresses;

use super::fit::Formula;
use super::{Candidate, Case, fit};
use crate::reference::TOLERANCE;

/// A part of a formula that may be another one: the name of the mistake, a sentence, and the part. Both texts are empty for the
/// right one.
type Part<T> = (&'static str, &'static str, T);

/// The mistakes that are wrong terms of a function's formula.
pub fn candidates<'a>(function: &str, cases: &[&Case]) -> Vec<Candidate<'a>> {
    let Some((all, wrong)) = entries(cases) else { return Vec::new() };
    let fitted = |among: &[bool]| {
        formulas(function).into_iter().filter_map(|formula| fit::candidate(formula, cases, among)).collect()
    };
    let mut candidates: Vec<Candidate<'a>> = fitted(&all);
    if let Some(wrong) = wrong {
        candidates.extend::<Vec<_>>(fitted(&wrong));
    }
    candidates
}

fn formulas<'a>(function: &str) -> Vec<Formula<'a>> {
    match function {
        "psi_neo_hookean" => densities::formulas(),
        "dpsi_neo_hookean_dF" => stresses::formulas(),
        "d2psi_neo_hookean_dF2" => hessians::formulas(),
        "V_spring_particle_particle" => springs::energies(),
        "dV_spring_particle_particle_dq" => springs::forces(),
        "T_linear_tetrahedron" => masses::kinetic_energies(),
        "mass_matrix_linear_tetrahedron" => masses::mass_matrices(),
        _ => Vec::new(),
    }
}

/// All entries, and those that are wrong somewhere if they are few; `None` if the answers have different shapes.
fn entries(cases: &[&Case]) -> Option<(Vec<bool>, Option<Vec<bool>>)> {
    let n = cases.first()?.expected.numbers.len();
    let fits = |case: &&&Case| case.observed.numbers.len() == n && case.expected.numbers.len() == n;
    if cases.iter().filter(fits).count() < cases.len() {
        return None;
    }
    let off = |case: &Case, k: usize| (case.observed.numbers[k] - case.expected.numbers[k]).abs() / case.trial.scale(k);
    let wrong: Vec<bool> = (0..n).map(|k| cases.iter().any(|case| off(case, k) > TOLERANCE)).collect();
    let is_part = 3 * wrong.iter().filter(|wrong| **wrong).count() <= n;
    Some((vec![true; n], is_part.then_some(wrong)))
}

/// The first of these parts that is wrong.
fn wrong(parts: &[(&'static str, &'static str)]) -> Option<(&'static str, &'static str)> {
    parts.iter().copied().find(|(name, _)| !name.is_empty())
}

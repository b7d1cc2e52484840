//! The terms of the formulas, and of formulas that are taken for them.

mod densities;
mod hessians;
mod masses;
mod springs;
mod stresses;

use super::{Candidate, Case, fit};

/// A part of a formula that may be another one: the name of the mistake, a sentence, and the part. Both texts are empty for the
/// right one.
type Part<T> = (&'static str, &'static str, T);

/// The mistakes that are wrong terms of a function's formula.
pub fn candidates<'a>(function: &str, cases: &[&Case]) -> Vec<Candidate<'a>> {
    let formulas = match function {
        "psi_neo_hookean" => densities::formulas(),
        "dpsi_neo_hookean_dF" => stresses::formulas(),
        "d2psi_neo_hookean_dF2" => hessians::formulas(),
        "V_spring_particle_particle" => springs::energies(),
        "dV_spring_particle_particle_dq" => springs::forces(),
        "T_linear_tetrahedron" => masses::kinetic_energies(),
        "mass_matrix_linear_tetrahedron" => masses::mass_matrices(),
        _ => Vec::new(),
    };
    formulas.into_iter().filter_map(|formula| fit::candidate(formula, cases)).collect()
}

/// The first of these parts that is wrong.
fn wrong(parts: &[(&'static str, &'static str)]) -> Option<(&'static str, &'static str)> {
    parts.iter().copied().find(|(name, _)| !name.is_empty())
}

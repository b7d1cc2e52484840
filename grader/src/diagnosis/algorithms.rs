//! The functions that are algorithms rather than formulas, written with switches for the mistakes of students.

mod assembly;
mod constraints;
mod elements;
mod implicit_euler;
mod linearly_implicit_euler;
mod newton;
mod picking;
mod quadrature;
mod shapes;
mod skinning;

use super::{Candidate, switches};

/// The mistakes in the algorithm of a function; empty if it is a formula.
pub fn candidates<'a>(function: &str) -> Vec<Candidate<'a>> {
    match function {
        "phi_linear_tetrahedron" | "dphi_linear_tetrahedron_dX" => {
            switches::candidates(shapes::RIGHT, shapes::SWITCHES, shapes::run)
        }
        "quadrature_single_point" => switches::candidates(quadrature::RIGHT, quadrature::SWITCHES, quadrature::run),
        "V_linear_tetrahedron" | "dV_linear_tetrahedron_dq" | "d2V_linear_tetrahedron_dq2" => {
            switches::candidates(elements::RIGHT, elements::SWITCHES, elements::run)
        }
        "mass_matrix_mesh" | "assemble_forces" | "assemble_stiffness" => {
            switches::candidates(assembly::RIGHT, assembly::SWITCHES, assembly::run)
        }
        "build_skinning_matrix" => {
            let of = |right| switches::candidates(right, skinning::SWITCHES, skinning::run);
            skinning::RIGHT.into_iter().flat_map(of).collect()
        }
        "fixed_point_constraints" => switches::candidates(constraints::RIGHT, constraints::SWITCHES, constraints::run),
        "pick_nearest_vertices" => switches::candidates(picking::RIGHT, picking::SWITCHES, picking::run),
        "linearly_implicit_euler" => switches::candidates(
            linearly_implicit_euler::RIGHT,
            linearly_implicit_euler::SWITCHES,
            linearly_implicit_euler::run,
        ),
        "newtons_method" => switches::candidates(newton::RIGHT, newton::SWITCHES, newton::run),
        "implicit_euler" => switches::candidates(implicit_euler::RIGHT, implicit_euler::SWITCHES, implicit_euler::run),
        _ => Vec::new(),
    }
}

//! The properties that each function must have, written once: `cargo test`, `check`, `grade` and the grader's own tests use
//! them.
//!
//! A property calls the function that it judges on [`Course::subject`] and, where it needs other functions, those of
//! [`Course::trusted`]: the reference when a submission is graded, the student's own functions on a student's machine.

/// The checks of these names, as data.
macro_rules! checks {
    ($($name:ident),* $(,)?) => { &[$($crate::properties::Check { name: stringify!($name), run: $name }),*] };
}

pub mod bodies;
pub mod double_double;
pub mod finite_differences;
#[cfg(test)]
mod hostile;
pub mod meshes;
pub mod outcome;
pub mod random;
pub mod scales;

pub mod T_linear_tetrahedron;
pub mod V_linear_tetrahedron;
pub mod V_spring_particle_particle;
pub mod assemble_forces;
pub mod assemble_stiffness;
pub mod build_skinning_matrix;
pub mod d2V_linear_tetrahedron_dq2;
pub mod d2psi_neo_hookean_dF2;
pub mod dV_linear_tetrahedron_dq;
pub mod dV_spring_particle_particle_dq;
pub mod dphi_linear_tetrahedron_dX;
pub mod dpsi_neo_hookean_dF;
pub mod fixed_point_constraints;
pub mod implicit_euler;
pub mod linearly_implicit_euler;
pub mod mass_matrix_linear_tetrahedron;
pub mod mass_matrix_mesh;
pub mod newtons_method;
pub mod phi_linear_tetrahedron;
pub mod pick_nearest_vertices;
pub mod psi_neo_hookean;
pub mod quadrature_single_point;

use crate::implementation::Implementation;
use outcome::Outcome;

/// The implementations that a property calls.
pub struct Course<'a> {
    /// The implementation that is judged.
    pub subject: &'a dyn Implementation,
    /// An implementation for the functions that a check needs beside the one that it judges.
    pub trusted: &'a dyn Implementation,
    /// Seed of the random inputs.
    pub seed: u64,
}

/// One property of one function.
#[derive(Clone, Copy)]
pub struct Check {
    /// The property as a sentence, in snake case.
    pub name: &'static str,
    /// Checks an implementation.
    pub run: fn(&Course) -> Outcome,
}

/// The name of a check as a sentence: `it_ends_at_1e_10` is "it ends at 1e-10".
pub fn sentence(check: &str) -> String {
    check.replace("_1e_", " 1e-").replace('_', " ")
}

macro_rules! list {
    ($($kind:ident $name:ident($($argument:ident: $type:ty),*) -> $result:ty;)*) => {
        /// The functions of the course in teaching order, each with its checks.
        pub const FUNCTIONS: [(&str, &[Check]); 22] = [$((stringify!($name), $name::CHECKS)),*];
    };
}
grader_child::course_functions!(list);

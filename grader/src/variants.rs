//! Wrong implementations of every function, as students write them. They test the grader, and the diagnosis compares answers with
//! theirs.

use grader_child::Functions;

/// Makes a [`Variant`]: the function, the name of the mistake, what the student is told, and the wrong body.
macro_rules! variant {
    ($name:ident, $diagnosis:literal, $sentence:literal, $body:expr $(,)?) => {
        $crate::variants::Variant {
            function: stringify!($name),
            diagnosis: Some($diagnosis),
            sentence: $sentence,
            functions: grader_child::Functions { $name: $body, ..$crate::reference::REFERENCE },
        }
    };
}

mod T_linear_tetrahedron;
mod V_linear_tetrahedron;
mod V_spring_particle_particle;
mod assemble_forces;
mod assemble_stiffness;
mod build_skinning_matrix;
mod d2V_linear_tetrahedron_dq2;
mod d2psi_neo_hookean_dF2;
mod dV_linear_tetrahedron_dq;
mod dV_spring_particle_particle_dq;
mod dphi_linear_tetrahedron_dX;
mod dpsi_neo_hookean_dF;
mod fixed_point_constraints;
mod implicit_euler;
mod linearly_implicit_euler;
mod mass_matrix_linear_tetrahedron;
mod mass_matrix_mesh;
mod newtons_method;
mod phi_linear_tetrahedron;
mod pick_nearest_vertices;
mod psi_neo_hookean;
mod quadrature_single_point;
mod scatter;
#[cfg(test)]
mod tests;

/// One mistake in one function.
pub struct Variant {
    /// The function that is wrong.
    pub function: &'static str,
    /// Name of the diagnosis, such as `negated` or `columns for rows`; `None` if no short name explains the mistake.
    pub diagnosis: Option<&'static str>,
    /// Sentence for the student: it teaches and does not give the answer.
    pub sentence: &'static str,
    /// The reference with this mistake in it.
    pub functions: Functions,
}

macro_rules! list {
    ($($kind:ident $name:ident($($argument:ident: $type:ty),*) -> $result:ty;)*) => {
        /// The variants of each function, in teaching order.
        pub const ALL: [&[Variant]; 22] = [$($name::VARIANTS),*];
    };
}
grader_child::course_functions!(list);

/// The variants of one function; empty if no function has this name.
pub fn of(function: &str) -> &'static [Variant] {
    ALL.into_iter().find(|variants| variants.iter().any(|variant| variant.function == function)).unwrap_or(&[])
}

/// All variants of all functions.
#[cfg(test)]
pub fn all() -> impl Iterator<Item = &'static Variant> {
    ALL.into_iter().flatten()
}

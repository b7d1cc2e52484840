//! A body's parts in double precision, for studies that call them one by one.
//!
//! The generic functions of the same names are compiled anew in each crate that calls them, with all forces of a body; these
//! are compiled here, once.

use fem_model::Body;
use fem_model::simulation::Cause;

use crate::forces::{Energy, HessianKind, Moment};
use crate::integrators::MassInverse;
use crate::model::system;
use fem_elements::materials::{AnyLaw, Law};
use fem_elements::sparse::Block;
use fem_solvers::SolverChoice;

/// A body in double precision.
pub type System = system::System<f64>;

/// Builds the parts of a body, and the pattern of its stiffness matrix.
pub fn system(body: Body, choice: SolverChoice) -> System {
    let law = AnyLaw::new(&body.material);
    System::new(body, law, choice)
}

/// [`System::potential`](system::System::potential)
pub fn potential(system: &System, u: &[[f64; 3]], moment: Moment) -> Energy {
    system.potential(u, moment)
}

/// [`System::gradient`](system::System::gradient)
pub fn gradient(system: &System, u: &[[f64; 3]], moment: Moment, gradient: &mut [[f64; 3]]) {
    system.gradient(u, moment, gradient);
}

/// [`System::potential_and_gradient`](system::System::potential_and_gradient)
pub fn potential_and_gradient(system: &System, u: &[[f64; 3]], moment: Moment, gradient: &mut [[f64; 3]]) -> Energy {
    system.potential_and_gradient(u, moment, gradient)
}

/// [`System::force`](system::System::force), with damping by the stiffness at `u`.
pub fn force(system: &System, u: &[[f64; 3]], v: &[[f64; 3]], moment: Moment, force: &mut [[f64; 3]]) {
    system.force(u, v, u, moment, force);
}

/// [`System::add_stiffness`](system::System::add_stiffness), not projected.
pub fn add_stiffness(system: &System, u: &[[f64; 3]], values: &mut [Block<f64, 3>]) {
    system.add_stiffness(1.0, u, HessianKind::Exact, values);
}

/// [`System::add_external_hessian`](system::System::add_external_hessian) at the start, not projected.
pub fn add_external_hessian(system: &System, u: &[[f64; 3]], values: &mut [Block<f64, 3>]) {
    system.add_external_hessian(u, Moment::at(0.0), HessianKind::Exact, values);
}

/// [`System::add_stiffness_times`](system::System::add_stiffness_times)
pub fn add_stiffness_times(system: &System, u: &[[f64; 3]], d: &[[f64; 3]], product: &mut [[f64; 3]]) {
    system.add_stiffness_times(1.0, u, d, product);
}

/// [`MassInverse::solve`]
pub fn solve_mass(
    inverse: &mut MassInverse<f64>,
    system: &System,
    f: &mut [[f64; 3]],
    a: &mut [[f64; 3]],
) -> Result<(), Cause> {
    inverse.solve(system, f, a)
}

/// A law by reference, whose functions are compiled.
pub fn law(law: &AnyLaw<f64>) -> &dyn Law<f64> {
    <f64 as fem_elements::Real>::law(law)
}

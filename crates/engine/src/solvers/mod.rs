//! Linear solvers of A x = b for symmetric block matrices.
//!
//! [`Solver`] splits the work by what it depends on: the pattern alone ([`Solver::new`]), the values ([`Solver::prepare`]) or
//! the right-hand side ([`Solver::solve`]). Behind it, each method implements one trait, `ApproximateInverse`.

mod assembly;
mod block;
mod choice;
mod device;
mod direct;
mod fallback;
mod inverse;
pub mod krylov;
pub mod lanczos;
mod memory;
mod parts;
mod preconditioners;
mod solver;

#[cfg(test)]
pub(crate) mod beam;
#[cfg(test)]
mod slender_tests;
#[cfg(test)]
mod tests;

pub use assembly::Assembly;
pub use choice::{Preconditioner, SolverChoice};
pub use device::{is_software as device_is_software, name as device_name};
pub(crate) use direct::Ldlt;
pub use solver::{Solver, SolverCounters};

#[cfg(feature = "gpu")]
pub(crate) use assembly::DeviceElements;
#[cfg(feature = "gpu")]
pub use device::device as open_device;
pub(crate) use device::unusable as unusable_device;
pub(crate) use inverse::{ApproximateInverse, Memory, Memoryless};
pub(crate) use memory::factor_fits;

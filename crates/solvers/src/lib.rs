//! Linear solvers of A x = b for the block matrices of bodies, and orders of the nodes that suit them. Knows matrices, not what they are of.
//!
//! [`Solver`] splits the work by what it depends on: the pattern alone ([`Solver::new`]), the values ([`Solver::prepare`]) or
//! the right-hand side ([`Solver::solve`]). Behind it, each method implements one trait, `ApproximateInverse`. Kernels are compiled
//! here, once for each number type ([`Real`]) and instruction set.

#![deny(missing_docs)]
#![allow(non_snake_case)] // A, L and P are the names that the mathematics uses
#![allow(clippy::needless_range_loop)] // indices of matrices are the notation of the field
#![allow(clippy::neg_cmp_op_on_partial_ord)] // written so that NaN fails

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
pub mod numbering;
pub mod parts;
mod preconditioners;
mod solver;

pub use assembly::Assembly;
#[cfg(feature = "gpu")]
pub use assembly::DeviceElements;
pub use choice::{Preconditioner, SolverChoice};
#[cfg(feature = "gpu")]
pub use device::device as open_device;
pub use device::{is_software as device_is_software, name as device_name, unusable as unusable_device};
pub use direct::Ldlt;
pub use memory::factor_fits;
pub use solver::{Real, Solver, SolverCounters};

use inverse::{ApproximateInverse, Memory, Memoryless};

//! Conjugate gradients, iterative refinement, and the matrix–vector product that both need.

mod cg;
mod product;
mod progress;
mod refine;

pub(super) use product::{parts, product};

pub use cg::{Workspace, conjugate_gradients};
pub use progress::{LinearSystem, Progress, max_iterations};
pub(super) use refine::refine;

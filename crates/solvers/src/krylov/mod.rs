//! Conjugate gradients, iterative refinement, and the matrix–vector product that both need.

mod cg;
mod product;
mod progress;
mod refine;

pub use cg::{Workspace, conjugate_gradients};
pub use product::{parts, product};
pub use progress::{LinearSystem, Progress, max_iterations};
pub(super) use refine::refine;

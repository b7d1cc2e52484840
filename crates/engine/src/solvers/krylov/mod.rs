//! Conjugate gradients, their simpler relatives for teaching, iterative refinement, and the matrix–vector product that all need.

mod cg;
mod conjugate_directions;
mod product;
mod progress;
mod refine;
mod steepest_descent;

pub(super) use product::{parts, product};

pub(super) use cg::{Workspace, conjugate_gradients};
pub(super) use conjugate_directions::conjugate_directions;
pub(super) use progress::LinearSystem;
pub(super) use refine::refine;
pub(super) use steepest_descent::steepest_descent;

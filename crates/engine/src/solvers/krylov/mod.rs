//! Conjugate gradients, iterative refinement, and the matrix–vector product that both need.

mod cg;
mod product;
mod refine;

pub(super) use product::{parts, product};

pub(super) use cg::{Workspace, conjugate_gradients};
pub(super) use refine::refine;

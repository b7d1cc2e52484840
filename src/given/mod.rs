mod assembly;
mod cholesky;
mod eigen;
mod kinematics;
mod ordering;
mod project;
mod solve;

pub use assembly::{add_block, add_scaled, select, sparsity};
pub use cholesky::{Cholesky, NotPositiveDefinite};
pub use kinematics::{deformation_gradient, volumes};
#[doc = include_str!("../../include-docs/given_project.md")]
#[cfg_attr(doc, doc = include_str!("../../include-docs/math.html"))]
pub use project::project;
pub use solve::Solver;
#[doc = include_str!("../../include-docs/given_solve.md")]
#[cfg_attr(doc, doc = include_str!("../../include-docs/math.html"))]
pub use solve::solve;

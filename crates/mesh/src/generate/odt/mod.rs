//! Optimal Delaunay triangulation: variational smoothing with reconnection.

mod improve;
mod plane;
pub(crate) mod space;

pub use improve::{ImprovedTriangles, NotManifold, improve_triangles};
pub use plane::OdtStep;
pub(crate) use plane::relax;
pub use space::{Improved, Iteration};
pub use space::{improve_inside, improve_tetrahedra};

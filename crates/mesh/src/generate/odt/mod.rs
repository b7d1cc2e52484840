//! Optimal Delaunay triangulation: variational smoothing with reconnection.

pub(crate) mod space;

pub use space::{Improved, Iteration, improve_graded, improve_inside, improve_tetrahedra};

//! Meshes from points, from surfaces and from pictures.

mod cage;
pub mod delaunay;
mod features;
pub mod odt;
mod outline;
pub mod picture;
mod solid;
mod stuffing;
mod triangulation;

pub use crate::error::StuffingError;
pub use cage::cage;
pub use features::{Featured, keep_features};
pub use solid::Solid;
pub use stuffing::{Implicit, stuff, stuff_graded, stuff_implicit};

/// Receives the share of the work that is done, from 0 to 1, a few hundred times at most.
pub type Progress<'a> = &'a dyn Fn(f64);

//! Meshes from points and from surfaces.

pub mod delaunay;
mod solid;
mod stuffing;

pub use solid::Solid;
pub use stuffing::{StuffingError, stuff};

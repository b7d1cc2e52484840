//! Meshes from points and from surfaces.

pub mod delaunay;
pub mod odt;
mod solid;
mod stuffing;

pub use solid::Solid;
pub use stuffing::{StuffingError, stuff, stuff_graded, stuff_sized};

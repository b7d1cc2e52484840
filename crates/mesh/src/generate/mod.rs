//! Meshes from points and from surfaces.

pub mod delaunay;
mod features;
pub mod odt;
mod solid;
mod stuffing;

pub use features::{Featured, keep_features};
pub use solid::Solid;
pub use stuffing::{StuffingError, stuff, stuff_graded, stuff_sized};

//! Meshes from points: Delaunay triangulations and tetrahedralizations.

pub mod delaunay;

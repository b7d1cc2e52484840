//! Errors in space: exact solutions, extrapolation over nested meshes, and the norms that measure them.

pub mod closed_forms;
pub mod conditioning;
pub mod locking;
pub mod manufactured;
pub mod nested;
pub mod norms;
pub mod points;

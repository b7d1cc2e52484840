//! Errors in space: exact solutions, extrapolation over nested meshes, the norms that measure them, and extreme eigenvalues.

pub mod closed_forms;
pub mod conditioning;
pub mod highest_mode;
pub mod locking;
pub mod manufactured;
pub mod nested;
pub mod norms;
pub mod points;

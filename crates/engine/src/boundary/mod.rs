//! Dirichlet conditions: fixed nodes and prescribed motions.

pub mod dirichlet;
mod kinematics;
pub mod rigid_modes;

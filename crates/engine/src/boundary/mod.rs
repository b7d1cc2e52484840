//! Dirichlet conditions: fixed nodes, prescribed motions, and the reactions at both.

pub mod dirichlet;
mod kinematics;
pub mod reactions;
pub mod rigid_modes;

//! Forces on a body beside its own elasticity.

pub mod acting;
pub mod dead_load;
pub mod pressure;
pub mod pulls;
pub mod springs;

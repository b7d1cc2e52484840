//! A body in the engine's form: the data that are constant in a run ([`system`]), and the state ([`state`]).

pub mod damping;
pub mod mass;
mod obstacles;
pub mod reactions;
pub mod state;
mod stiffness_pattern;
pub mod system;

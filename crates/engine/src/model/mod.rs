//! A body as the engine computes with it: what never changes in a run ([`system`]), and what does ([`state`]).

pub mod damping;
pub mod mass;
pub mod numbering;
mod obstacles;
pub mod state;
mod stiffness_pattern;
pub mod system;

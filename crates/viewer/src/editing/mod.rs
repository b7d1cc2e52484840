//! Changes of the scene of a simulation: what the user asks for, the keys that it sets, and the simulation of the changed scene.

pub mod change;
pub mod editor;
pub mod edits;
pub mod parameters;
pub mod tables;

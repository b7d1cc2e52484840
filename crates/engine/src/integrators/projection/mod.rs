//! Position-based methods: nodes move where inertia takes them, and sweeps over constraints correct their places one constraint at a time.
//!
//! A step is algorithm 1 of Müller, Heidelberger, Hennix and Ratcliff, Position based dynamics (2007), with the multipliers of Macklin,
//! Müller and Chentanez, XPBD: position-based simulation of compliant constrained dynamics (2016). [`Rule`] is what tells the methods
//! apart. Constraints of elements are coloured, so that the result does not depend on the number of threads.

mod anchor_constraints;
mod batch;
mod coloring;
mod contact;
mod distances;
mod elements;
mod kernel;
mod particles;
mod rule;
mod scalar;
mod stress;
mod sweeps;

pub use batch::shape;
pub use contact::{ContactStep, PlaneContacts};
pub use particles::{Particles, largest_difference};
pub use rule::Rule;
pub use sweeps::Sweeps;

//! Position-based methods: a sweep corrects the positions of the nodes one constraint at a time.
//!
//! Constraints are those of Müller, Heidelberger, Hennix and Ratcliff, Position based dynamics (2007), with the multipliers of Macklin,
//! Müller and Chentanez, XPBD: position-based simulation of compliant constrained dynamics (2016). [`Rule`] is the difference between the
//! methods. Constraints of elements are coloured, so that the result does not depend on the number of threads.

mod batch;
mod constraints;
mod distances;
mod drag_constraints;
mod elements;
mod kernel;
mod rule;
mod scalar;
mod stress;

pub use constraints::Constraints;
pub use rule::Rule;

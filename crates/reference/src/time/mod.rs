//! Reference solutions in time: the semi-discrete equations of motion, integrated to round-off.

mod equations;
mod extrapolation;
mod ldl;
mod mass;

pub use equations::{Equations, Phase, Scratch};
pub use extrapolation::{Reference, SELF_CHECK, reference};
pub use ldl::Ldl;

//! Linear systems on a graphics device, through wgpu's compute shaders.
//!
//! [`Device`] is a card, or a program that stands in for one; [`ConjugateGradients`] solves systems of 3×3 blocks on it. This crate knows
//! matrices and vectors, and nothing of bodies.

mod conjugate_gradients;
mod device;
mod matrix;
mod number;
mod program;
mod quiet;

pub use conjugate_gradients::{CoarseGrid, ConjugateGradients, Outcome, Solved};
pub use device::Device;
pub use matrix::BlockPattern;
pub use number::Number;

use thiserror::Error;

/// A device cannot be used, or no longer.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
pub enum DeviceError {
    /// There is none.
    #[error("no graphics adapter: {0}")]
    NoAdapter(String),
    /// It does not compute in double precision.
    #[error("{0} does not compute in double precision")]
    NoDoublePrecision(String),
    /// An array does not fit.
    #[error("{what} take {bytes} bytes, and {adapter} has room for {limit} in an array")]
    TooLarge {
        /// What the array holds.
        what: &'static str,
        /// Its size.
        bytes: u64,
        /// The largest size.
        limit: u64,
        /// Name of the adapter.
        adapter: String,
    },
    /// It was lost, ran out of memory, or refused a command.
    #[error("{adapter} failed: {message}")]
    Failed {
        /// Name of the adapter.
        adapter: String,
        /// What it said.
        message: String,
    },
}

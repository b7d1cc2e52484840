//! Linear systems and time steps on a graphics device, through wgpu's compute shaders.
//!
//! [`Device`] is a card, or a program that stands in for one. [`ConjugateGradients`] solves systems of 3×3 blocks on it, [`Stiffness`]
//! assembles their matrix there, and [`Bodies`] are many bodies of one mesh that step there. This crate works on arrays of numbers,
//! and is independent of scenes.

mod conjugate_gradients;
mod device;
mod elements;
mod matrix;
mod number;
mod program;
mod quiet;
mod steps;
mod stiffness;

pub use conjugate_gradients::{CoarseGrid, ConjugateGradients, Outcome, Solved};
pub use device::Device;
pub use elements::{Law, Tetrahedra};
pub use matrix::BlockPattern;
pub use number::Number;
pub use steps::{Bodies, Body, Cause, Environment, Method, Scheme, Trouble};
pub use stiffness::{Matrix, Stiffness};

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
        /// Content of the array.
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
        /// Message of the device.
        message: String,
    },
}

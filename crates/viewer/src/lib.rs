//! The window and the pictures. They read a [`Simulation`](fem_scene::simulation::Simulation) and give back drags.
//!
//! - [`open`] shows a simulation in a window until it is closed; the simulation runs on a thread of its own.
//! - [`Photographer`] takes the same pictures without any window or display server.
//! - [`display_available`] says beforehand whether a window can be opened, and if not, why.

#![deny(missing_docs)]

mod camera;
mod display;
mod geometry;
mod hand;
mod history;
mod matte;
mod pacing;
mod panel;
mod photograph;
mod pictures;
mod plot;
mod session;
mod stage;
mod theme;
mod window;
mod worker;

pub use display::display_available;
pub use photograph::{NoAdapter, Photographer};
pub use pictures::{FRAMES_PER_SECOND, NotWritten, Photograph, Recorder};
pub use stage::Shown;
pub use window::{NoWindow, Outcome, WindowError, WindowOptions, open};
pub use worker::Stop;

//! An interactive window and offscreen pictures of a [`Simulation`](fem_model::simulation::Simulation).
//!
//! - [`open`] shows a simulation in a window until it is closed; the simulation runs on a thread of its own.
//! - [`Editing`] lets the window's panel change the scene; the simulation is built anew on its own thread. [`SceneEditor`] makes and saves
//!   such changes, also without a window; [`scene_edits`] has those that are set up by hand.
//! - [`OffscreenRenderer`] draws the same pictures without a window or a display server.
//! - [`display_available`] tells in advance whether a window can be opened, and if not, why.
//!
//! ```no_run
//! use std::error::Error;
//!
//! use fem_model::simulation::Simulation;
//! use fem_viewer::{DisplayedSurface, OffscreenRenderer, WindowOptions};
//!
//! /// `simulation` comes, for example, from `fem_engine::simulator::build`.
//! fn show(mut simulation: Box<dyn Simulation>) -> Result<(), Box<dyn Error>> {
//!     let mut renderer = OffscreenRenderer::new(1280, 800)?;
//!     simulation.step()?;
//!     renderer.render(&*simulation, DisplayedSurface::Skinned)?.save("step.png".as_ref())?;
//!     fem_viewer::open(simulation, WindowOptions::default())?;
//!     Ok(())
//! }
//! ```

#![deny(missing_docs)]

mod editing;
mod panel;
mod panics;
mod picture;
mod setup;
mod window;
mod worker;

pub use editing::change::{Change, Edit, Effect};
pub use editing::editor::{Builder, Editing, Motion, SceneEditor, SceneSetup};
pub use editing::edits as scene_edits;
pub use editing::tables::TableOffer;
pub use picture::display::display_available;
pub use picture::files::{FRAMES_PER_SECOND, NotWritten, Picture, Recorder};
pub use picture::offscreen::{NoAdapter, OffscreenRenderer};
pub use picture::scene_view::DisplayedSurface;
pub use window::options::WindowOptions;
pub use window::{NoWindow, WindowError, open};
pub use worker::{Outcome, Stop};

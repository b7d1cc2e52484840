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

mod camera;
mod change;
mod color_scale;
mod display;
mod facets;
mod frame;
mod geometry;
mod history;
mod interaction;
mod legend;
mod obstacles;
mod offscreen;
mod options;
mod pacing;
mod paint;
mod panel;
mod panics;
mod parameter_rows;
mod pictures;
mod plot;
mod request;
mod scene_changes;
pub mod scene_edits;
mod scene_parameters;
mod scene_view;
mod session;
mod setup;
mod shader;
mod surface;
mod texture;
mod theme;
mod window;
mod worker;

pub use change::{Change, Edit, Effect};
pub use display::display_available;
pub use offscreen::{NoAdapter, OffscreenRenderer};
pub use options::{Builder, Editing, WindowOptions};
pub use pictures::{FRAMES_PER_SECOND, NotWritten, Picture, Recorder};
pub use scene_view::DisplayedSurface;
pub use window::{NoWindow, Outcome, WindowError, open};
pub use worker::Stop;
pub use worker::scene_editor::{Motion, SceneEditor, SceneSetup};

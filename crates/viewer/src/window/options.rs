//! Options of a window.

use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::AtomicUsize;

use fem_output::ElementField;
use nalgebra::Vector3;

use crate::editing::editor::Editing;

/// Options of a window.
#[derive(Clone)]
pub struct WindowOptions {
    /// Width and height, logical pixels.
    pub size: (u32, u32),
    /// Upward direction in the picture.
    pub up: Vector3<f64>,
    /// The field that colours the elements at the start; `None` for plain colours.
    pub color: Option<ElementField>,
    /// Path of a PNG file of the window, written after the last step or when it closes.
    pub screenshot: Option<PathBuf>,
    /// Folder for recorded frames, [`FRAMES_PER_SECOND`](crate::FRAMES_PER_SECOND) of simulated time; the simulation then waits for each.
    pub record: Option<PathBuf>,
    /// Number of steps after which the window closes; it closes earlier if the simulation fails.
    pub quit_after_steps: Option<usize>,
    /// Keep the energies of every step for [`Outcome::energies`](crate::Outcome::energies).
    pub log_energies: bool,
    /// The scene, for a panel that changes it; `None` for one with the parameters of the simulation alone.
    pub editing: Option<Editing>,
    /// The window closes once this is not zero, such as after a signal.
    pub close: Arc<AtomicUsize>,
}

impl Default for WindowOptions {
    fn default() -> Self {
        WindowOptions {
            size: (1280, 800),
            up: Vector3::y(),
            color: None,
            screenshot: None,
            record: None,
            quit_after_steps: None,
            log_energies: false,
            editing: None,
            close: Arc::default(),
        }
    }
}

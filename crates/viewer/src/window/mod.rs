//! Opens the window and returns the run's results when it is closed.

mod interaction;
pub mod options;
mod scene_changes;
mod session;

use std::fmt;
use std::sync::atomic::{AtomicBool, Ordering};

use fem_model::simulation::Simulation;
use kiss3d::context::Context;
use kiss3d::window::{CanvasSetup, NumSamples, Window};
use thiserror::Error;

use crate::picture::display::{display_available, without_panic, without_wayland_message};
use crate::picture::files::{FRAMES_PER_SECOND, NotWritten, Recorder, check_writable};
use crate::picture::theme;
use crate::worker::{LoopOptions, Outcome, Stepping};
use options::WindowOptions;
use session::Session;

/// Errors on opening a window.
#[derive(Debug, Error)]
pub enum WindowError {
    /// The machine has no display or no graphics adapter.
    #[error(transparent)]
    NoWindow(#[from] NoWindow),
    /// A screenshot or recording cannot be written.
    #[error(transparent)]
    NotWritten(#[from] NotWritten),
}

/// No window can be opened on this machine. Returns the simulation, so that it can run without one.
#[derive(Error)]
#[error("cannot open a window: {reason}")]
pub struct NoWindow {
    /// The reason, in one line.
    pub reason: String,
    /// The simulation, not yet stepped.
    pub simulation: Box<dyn Simulation>,
}

impl fmt::Debug for NoWindow {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("NoWindow").field("reason", &self.reason).finish_non_exhaustive()
    }
}

/// Shows `simulation` in a window until it is closed. Must be called from the main thread, and once per process: winit
/// allows no second event loop.
pub fn open(simulation: Box<dyn Simulation>, options: WindowOptions) -> Result<Outcome, WindowError> {
    if let Some(path) = &options.screenshot {
        check_writable(path)?;
    }
    let recorder = options.record.as_deref().map(Recorder::new).transpose()?;
    let window = match display_available().and_then(|()| create(simulation.name(), options.size)) {
        Ok(window) => window,
        Err(reason) => return Err(NoWindow { reason, simulation }.into()),
    };
    let loop_options = LoopOptions {
        stepping: if recorder.is_some() { Stepping::Frames(1.0 / FRAMES_PER_SECOND) } else { Stepping::RealTime },
        steps: options.quit_after_steps,
        log_energies: options.log_energies,
    };
    let (worker, not_written) = Session::new(window, simulation, loop_options, recorder, &options).run();
    Ok(Outcome { not_written, ..worker.finish() })
}

fn create(name: &str, (width, height): (u32, u32)) -> Result<Window, String> {
    static OPENED: AtomicBool = AtomicBool::new(false);
    if OPENED.swap(true, Ordering::Relaxed) {
        return Err("a program can open one window, and this one has already done so".into());
    }
    let setup = CanvasSetup { samples: NumSamples::Four, ..CanvasSetup::default() };
    let open = || pollster::block_on(Window::new_with_setup(&title(name), width, height, setup));
    let mut window = without_panic(|| without_wayland_message(open))?;
    if Context::get().adapter.get_info().device_type == wgpu::DeviceType::Cpu {
        window.set_samples(NumSamples::One); // multisampling is too slow in software
    }
    theme::set_style(window.egui_context_mut());
    Ok(window)
}

fn title(name: &str) -> String {
    format!("{name} – finite elements 3d")
}

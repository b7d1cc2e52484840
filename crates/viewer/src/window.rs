//! Opening the window, and what is left when it is closed.

use std::fmt;
use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};

use fem_scene::simulation::{Energies, Simulation};
use kiss3d::context::Context;
use kiss3d::egui::{self, Theme};
use kiss3d::window::{CanvasSetup, NumSamples, Window};
use nalgebra::Vector3;
use thiserror::Error;

use crate::display::{display_available, without_panic};
use crate::pictures::{FRAMES_PER_SECOND, NotWritten, Recorder, check_writable};
use crate::session::Session;
use crate::theme;
use crate::worker::{Plan, Stop, Tempo, Worker};

/// What may be asked of a window.
#[derive(Clone, Debug)]
pub struct WindowOptions {
    /// Width and height, logical pixels.
    pub size: (u32, u32),
    /// The direction that is up in the picture.
    pub up: Vector3<f64>,
    /// Where to leave a picture of the window, taken after the last step or when it closes.
    pub screenshot: Option<PathBuf>,
    /// The folder to record frames into, [`FRAMES_PER_SECOND`] of simulated time. The simulation then waits for each.
    pub record: Option<PathBuf>,
    /// Closes the window after so many steps, or when the simulation fails before that.
    pub quit_after_steps: Option<usize>,
    /// Keeps the energies of every step for [`Outcome::energies`].
    pub log_energies: bool,
}

impl Default for WindowOptions {
    fn default() -> Self {
        WindowOptions {
            size: (1280, 800),
            up: Vector3::y(),
            screenshot: None,
            record: None,
            quit_after_steps: None,
            log_energies: false,
        }
    }
}

/// What is left when the window is closed.
pub struct Outcome {
    /// The simulation; none where it panicked beyond repair.
    pub simulation: Option<Box<dyn Simulation>>,
    /// Wall-clock time of each step since the start or the last reset, the physics alone, s.
    pub step_seconds: Vec<f64>,
    /// Time (s) and energies (J) after each of them, where [`WindowOptions::log_energies`] asked for them.
    pub energies: Vec<(f64, Energies)>,
    /// Why the simulation stood still when the window was closed, if it did.
    pub stop: Option<Stop>,
    /// A picture that could not be written while the window was open.
    pub not_written: Option<NotWritten>,
}

/// Why no window was opened.
#[derive(Debug, Error)]
pub enum WindowError {
    /// There is nothing to open it on.
    #[error(transparent)]
    NoWindow(#[from] NoWindow),
    /// A picture that was asked for could not be written.
    #[error(transparent)]
    NotWritten(#[from] NotWritten),
}

/// No window can be opened here. Gives the simulation back, to run without one.
#[derive(Error)]
#[error("cannot open a window: {reason}")]
pub struct NoWindow {
    /// Why, in one line.
    pub reason: String,
    /// The simulation, untouched.
    pub simulation: Box<dyn Simulation>,
}

impl fmt::Debug for NoWindow {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("NoWindow").field("reason", &self.reason).finish_non_exhaustive()
    }
}

/// Shows `simulation` in a window until that is closed. To be called from the main thread, once: the window system's
/// library allows no second time.
pub fn open(simulation: Box<dyn Simulation>, options: WindowOptions) -> Result<Outcome, WindowError> {
    if let Some(path) = &options.screenshot {
        check_writable(path)?;
    }
    let recorder = options.record.as_deref().map(Recorder::new).transpose()?;
    let window = match display_available().and_then(|()| create(simulation.name(), options.size)) {
        Ok(window) => window,
        Err(reason) => return Err(NoWindow { reason, simulation }.into()),
    };
    let plan = Plan {
        tempo: if recorder.is_some() { Tempo::Frames(1.0 / FRAMES_PER_SECOND) } else { Tempo::RealTime },
        steps: options.quit_after_steps,
        log_energies: options.log_energies,
    };
    let (name, shape) = (simulation.name().to_owned(), simulation.shape());
    let worker = Worker::start(simulation, plan);
    let (worker, not_written) = Session::new(window, worker, name, &shape, recorder, &options).until_closed();
    let finished = worker.finish();
    Ok(Outcome {
        simulation: finished.simulation,
        step_seconds: finished.step_seconds,
        energies: finished.energies,
        stop: finished.stop,
        not_written,
    })
}

fn create(name: &str, (width, height): (u32, u32)) -> Result<Window, String> {
    static OPENED: AtomicBool = AtomicBool::new(false);
    if OPENED.swap(true, Ordering::Relaxed) {
        return Err("this program has had its window; there is one for each run".into());
    }
    let setup = CanvasSetup { samples: NumSamples::Four, ..CanvasSetup::default() };
    let mut window = without_panic(|| pollster::block_on(Window::new_with_setup(&title(name), width, height, setup)))?;
    if Context::get().adapter.get_info().device_type == wgpu::DeviceType::Cpu {
        window.set_samples(NumSamples::One); // smooth edges cost a processor too much
    }
    set_style(window.egui_context_mut());
    Ok(window)
}

fn title(name: &str) -> String {
    format!("{name} – finite elements 3d")
}

/// Dark text on light paper, of one size everywhere.
fn set_style(context: &egui::Context) {
    context.set_theme(Theme::Light);
    context.all_styles_mut(|style| {
        style.visuals.override_text_color = Some(theme::INK);
        style.interaction.selectable_labels = false;
        for (kind, font) in &mut style.text_styles {
            font.size = match kind {
                egui::TextStyle::Small => 12.0,
                egui::TextStyle::Heading => 20.0,
                _ => 14.0,
            };
        }
    });
}

//! The simulation's thread: the window sends it commands and reads its latest snapshot.

#[cfg(test)]
mod editing_tests;
pub mod history;
pub mod pacing;
#[cfg(test)]
mod setup_tests;
pub mod simulation_loop;
pub mod step_timers;
#[cfg(test)]
mod tests;

use std::fmt;
use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Sender, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::JoinHandle;

use fem_model::simulation::{Click, Failure, Parameter, Pull, Shape, Simulation};
use fem_output::{ElementField, EnergyRow};
use fem_scene::Scene;
use nalgebra::Vector3;

use crate::editing::change::Change;
use crate::editing::editor::{SceneEditor, SceneSetup};
use crate::panics::panic_message;
use crate::picture::files::NotWritten;
use crate::picture::frame::{Frame, Wanted};
use step_timers::StepTimer;

/// The reason why a simulation has stopped until it is reset.
#[derive(Clone, Debug, PartialEq)]
pub enum Stop {
    /// A step failed; the state is that before the step.
    Failed(Failure),
    /// The simulation panicked, which is a fault in the program; holds the panic's message.
    Panicked(String),
}

impl fmt::Display for Stop {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Stop::Failed(failure) => failure.fmt(f),
            Stop::Panicked(message) => write!(f, "the simulation has a fault and stopped: {message}"),
        }
    }
}

impl std::error::Error for Stop {}

/// A command from the window to the simulation.
pub enum Command {
    /// Pause or continue.
    TogglePause,
    /// Go back to the initial state.
    Reset,
    /// Continue with the next integrator.
    NextIntegrator,
    /// Set a parameter by its key.
    Set(&'static str, f64),
    /// Change the scene, and build its simulation anew.
    Change(Vec<Change>),
    /// Compute these parts of the frames.
    Want(Wanted),
    /// Pull nodes, or release them.
    Pull(Option<Pull>),
    /// Reply with the nodes that a click picks and their positions.
    Pick(Click, Sender<Anchors>),
    /// Step on to the next frame, in [`Stepping::Frames`].
    NextFrame,
    /// Write the scene as it is set up to a new file.
    Save(PathBuf),
    /// End the thread.
    Quit,
}

/// Nodes and their positions, m.
pub type Anchors = Vec<(usize, Vector3<f64>)>;

/// Timing of the steps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Stepping {
    /// In real time, or as fast as possible if the simulation is slower.
    RealTime,
    /// From frame to frame on request; the value is the simulated time between two frames, s.
    Frames(f64),
}

/// Options of the simulation loop.
#[derive(Clone, Copy, Debug)]
pub struct LoopOptions {
    /// Timing of the steps.
    pub stepping: Stepping,
    /// Number of steps after which the simulation is finished.
    pub steps: Option<usize>,
    /// Keep the energies of every step.
    pub log_energies: bool,
}

/// A copy of the simulation's state for the window.
#[derive(Clone, Debug, Default)]
pub struct Snapshot {
    /// The state as a picture shows it.
    pub frame: Frame,
    /// The undeformed body; `None` before the first snapshot.
    pub shape: Option<Arc<Shape>>,
    /// The fields that the body has.
    pub fields: Vec<ElementField>,
    /// Length of the sum of all forces of obstacles, N; `None` without obstacles.
    pub contact_force: Option<f64>,
    /// Weight of the body, N.
    pub weight: Option<f64>,
    /// Simulated time, s.
    pub time: f64,
    /// Steps since the start or the last reset.
    pub steps: usize,
    /// Median time of the last steps, the physics alone, s.
    pub step_seconds: f64,
    /// Simulated seconds per second of wall clock; `None` until it is measured.
    pub rate: Option<f64>,
    /// Name of the integrator.
    pub integrator: &'static str,
    /// The parameters that the user may change.
    pub parameters: Vec<Parameter>,
    /// The numbers of the scene that the user may change.
    pub scene_parameters: Vec<Parameter>,
    /// The picture of the body, if it is made from one that the user may change.
    pub object: Option<PathBuf>,
    /// The scene with the user's changes and the parts of the body that it names, if it may be changed.
    pub setup: Option<Arc<SceneSetup>>,
    /// The last command [`Command::Save`]: the path of the file, or the reason why it was not written.
    pub saved: Option<Result<PathBuf, String>>,
    /// The parts of a step and their times.
    pub timers: Vec<StepTimer>,
    /// Mean time of the steps of which these are the parts, s.
    pub timed_step: f64,
    /// A changed scene is being built.
    pub is_building: bool,
    /// Number of commands [`Command::Change`] that were executed or refused.
    pub changes: usize,
    /// Time step, s.
    pub dt: f64,
    /// The longest stable time step of an explicit method, s, if the scene may be changed.
    pub critical_time_step: Option<f64>,
    /// Energies of the last simulated seconds.
    pub history: Vec<EnergyRow>,
    /// The simulation is paused.
    pub paused: bool,
    /// [`LoopOptions::steps`] has been reached.
    pub finished: bool,
    /// The failure that stopped the simulation.
    pub stop: Option<Stop>,
    /// The message with which the last change of a parameter was refused.
    pub refusal: Option<String>,
}

/// Results of a run in a window.
pub struct Outcome {
    /// The simulation; `None` if its thread panicked.
    pub simulation: Option<Box<dyn Simulation>>,
    /// Wall-clock time of each step since the start or the last reset, the physics alone, s.
    pub step_seconds: Vec<f64>,
    /// Time and energies after each of these steps, if [`WindowOptions::log_energies`](crate::WindowOptions::log_energies) is set.
    pub energies: Vec<EnergyRow>,
    /// The failure that had stopped the simulation at the end.
    pub stop: Option<Stop>,
    /// The scene with the changes of its user, if it could be changed.
    pub scene: Option<Scene>,
    /// A picture that could not be written while the window was open.
    pub not_written: Option<NotWritten>,
}

/// Shared storage for the latest snapshot.
#[derive(Default)]
pub struct Slot {
    latest: Mutex<Option<Snapshot>>,
    /// Set when the window has taken a snapshot: the thread copies its state only on demand.
    wanted: AtomicBool,
}

impl Slot {
    fn put(&self, snapshot: Snapshot) {
        *self.latest.lock().unwrap_or_else(PoisonError::into_inner) = Some(snapshot);
    }
}

/// A simulation on its own thread.
pub struct Worker {
    commands: Sender<Command>,
    slot: Arc<Slot>,
    thread: JoinHandle<Outcome>,
}

impl Worker {
    /// Starts the thread of `simulation`. `editor` changes its scene; without one, the scene stays.
    pub fn start(simulation: Box<dyn Simulation>, options: LoopOptions, editor: Option<SceneEditor>) -> Self {
        let (commands, received) = channel();
        let slot = Arc::new(Slot::default());
        let shared_slot = Arc::clone(&slot);
        let thread = std::thread::spawn(move || {
            simulation_loop::SimulationLoop::new(simulation, options, editor, received, shared_slot).run()
        });
        Worker { commands, slot, thread }
    }

    /// Sends a command, which has no effect if the thread has ended.
    pub fn send(&self, command: Command) {
        let _ = self.commands.send(command);
    }

    /// The latest snapshot, if it has not been taken yet.
    pub fn latest(&self) -> Option<Snapshot> {
        let snapshot = self.slot.latest.lock().unwrap_or_else(PoisonError::into_inner).take()?;
        self.slot.wanted.store(true, Ordering::Release);
        Some(snapshot)
    }

    /// Ends the thread after its current step, and returns its results.
    pub fn finish(self) -> Outcome {
        self.send(Command::Quit);
        self.thread.join().unwrap_or_else(|panic| Outcome {
            simulation: None,
            step_seconds: Vec::new(),
            energies: Vec::new(),
            stop: Some(Stop::Panicked(panic_message(panic.as_ref()))),
            scene: None,
            not_written: None,
        })
    }
}

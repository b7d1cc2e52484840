//! The thread that the simulation runs on, seen from the window: commands go in, the latest snapshot comes out.

pub mod run;
#[cfg(test)]
mod tests;

use std::fmt;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Sender, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::JoinHandle;

use fem_scene::simulation::{Click, Energies, Failure, Parameter, Pull, Simulation};
use kiss3d::glamx::Vec3;
use nalgebra::Vector3;

use crate::history::Sample;

/// Why a simulation stands still until it is reset.
#[derive(Clone, Debug, PartialEq)]
pub enum Stop {
    /// A step failed; the state is the last good one.
    Failed(Failure),
    /// The simulation panicked: a fault in the program. What it said.
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

/// What the window asks of the simulation.
pub enum Command {
    /// Stop stepping, or go on.
    TogglePause,
    /// Back to the start.
    Reset,
    /// Go on with the next integrator.
    NextIntegrator,
    /// Set a parameter by its key.
    Set(&'static str, f64),
    /// Hold nodes, or let go.
    Pull(Option<Pull>),
    /// Tell which nodes a click meets, and where they are.
    Pick(Click, Sender<Anchors>),
    /// In [`Tempo::Frames`]: the frame was taken, go on to the next one.
    NextFrame,
    /// End the thread.
    Quit,
}

/// Nodes and where they are, m.
pub type Anchors = Vec<(usize, Vector3<f64>)>;

/// When the next step is taken.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Tempo {
    /// As fast as the clock on the wall, or as fast as it can.
    RealTime,
    /// From frame to frame, so many seconds of simulated time apart, each when it is asked for.
    Frames(f64),
}

/// How a simulation is run.
#[derive(Clone, Copy, Debug)]
pub struct Plan {
    /// When the next step is taken.
    pub tempo: Tempo,
    /// Steps after which the simulation is finished.
    pub steps: Option<usize>,
    /// Whether the energies of every step are kept.
    pub log_energies: bool,
}

/// The simulation at one moment: all that the window shows.
#[derive(Clone, Debug, Default)]
pub struct Snapshot {
    /// Positions of the nodes, m.
    pub positions: Vec<Vec3>,
    /// Positions of the display surface's vertices, m.
    pub display: Vec<Vec3>,
    /// Simulated time, s.
    pub time: f64,
    /// Steps since the start or the last reset.
    pub steps: usize,
    /// Median time of the last steps, the physics alone, s.
    pub step_seconds: f64,
    /// Simulated seconds per second of wall clock; none while it cannot be told.
    pub rate: Option<f64>,
    /// Name of the integrator.
    pub integrator: &'static str,
    /// What a person may change.
    pub parameters: Vec<Parameter>,
    /// Energies of the last seconds.
    pub history: Vec<Sample>,
    /// Whether it pauses.
    pub paused: bool,
    /// Whether the number of steps asked for was reached.
    pub finished: bool,
    /// Why it stands still, if it does.
    pub stop: Option<Stop>,
    /// Why the last change of a parameter was refused.
    pub refusal: Option<String>,
}

/// What is left when the thread has ended.
pub struct Finished {
    /// The simulation; none where it panicked beyond repair.
    pub simulation: Option<Box<dyn Simulation>>,
    /// Wall-clock time of each step since the start or the last reset, the physics alone, s.
    pub step_seconds: Vec<f64>,
    /// Time and energies after each of them, where they were asked for.
    pub energies: Vec<(f64, Energies)>,
    /// Why it stood still at the end, if it did.
    pub stop: Option<Stop>,
}

/// Where the thread leaves its latest snapshot.
#[derive(Default)]
pub struct Slot {
    latest: Mutex<Option<Snapshot>>,
    /// Set when a snapshot was taken, so that no snapshot is made that nobody looks at.
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
    thread: JoinHandle<Finished>,
}

impl Worker {
    /// Starts `simulation`.
    pub fn start(simulation: Box<dyn Simulation>, plan: Plan) -> Self {
        let (commands, received) = channel();
        let slot = Arc::new(Slot::default());
        let theirs = Arc::clone(&slot);
        let thread = std::thread::spawn(move || run::Run::new(simulation, plan, received, theirs).until_told());
        Worker { commands, slot, thread }
    }

    /// Sends a command. One that comes after the end of the thread has no effect.
    pub fn send(&self, command: Command) {
        let _ = self.commands.send(command);
    }

    /// The latest snapshot, if there is a new one.
    pub fn latest(&self) -> Option<Snapshot> {
        let snapshot = self.slot.latest.lock().unwrap_or_else(PoisonError::into_inner).take()?;
        self.slot.wanted.store(true, Ordering::Release);
        Some(snapshot)
    }

    /// Ends the thread, after the step that it is in.
    pub fn finish(self) -> Finished {
        self.send(Command::Quit);
        self.thread.join().unwrap_or_else(|panic| Finished {
            simulation: None,
            step_seconds: Vec::new(),
            energies: Vec::new(),
            stop: Some(Stop::Panicked(run::panic_message(panic.as_ref()))),
        })
    }
}

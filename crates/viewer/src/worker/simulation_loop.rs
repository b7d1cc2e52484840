//! The loop that runs on the simulation's thread.

mod changes;

use std::collections::VecDeque;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::sync::mpsc::{Receiver, RecvTimeoutError};
use std::time::{Duration, Instant};

use fem_model::simulation::Simulation;
use fem_output::EnergyRow;
use fem_output::quantile;
use nalgebra::Vector3;

use super::history::History;
use super::pacing::{Pace, Rate};
use super::step_timers::StepTimers;
use super::{Command, LoopOptions, Outcome, Slot, Snapshot, Stepping, Stop};
use crate::editing::editor::SceneEditor;
use crate::panics::panic_message;
use crate::picture::frame::{Frame, Wanted};

const STEPS_IN_MEDIAN: usize = 61;

/// The simulation and the state of its loop.
pub struct SimulationLoop {
    simulation: Box<dyn Simulation>,
    options: LoopOptions,
    editor: Option<SceneEditor>,
    commands: Receiver<Command>,
    slot: Arc<Slot>,
    started: Instant,
    pace: Pace,
    rate: Rate,
    history: History,
    recent: VecDeque<f64>,
    step_seconds: Vec<f64>,
    energies: Vec<EnergyRow>,
    /// Simulated time of the last frame, s, in [`Stepping::Frames`].
    last_frame: f64,
    frame_requested: bool,
    wanted: Wanted,
    timers: StepTimers,
    /// The last snapshot, whose flags, messages and inspected values hold until they change.
    last: Snapshot,
}

impl SimulationLoop {
    /// A loop that has not started.
    pub fn new(
        simulation: Box<dyn Simulation>,
        options: LoopOptions,
        editor: Option<SceneEditor>,
        commands: Receiver<Command>,
        slot: Arc<Slot>,
    ) -> Self {
        SimulationLoop {
            simulation,
            options,
            editor,
            commands,
            slot,
            started: Instant::now(),
            pace: Pace::default(),
            rate: Rate::default(),
            history: History::default(),
            recent: VecDeque::new(),
            step_seconds: Vec::new(),
            energies: Vec::new(),
            last_frame: 0.0,
            frame_requested: false,
            wanted: Wanted::default(),
            timers: StepTimers::default(),
            last: Snapshot::default(),
        }
    }

    /// Steps and executes commands until it is told to quit or the channel of commands is closed.
    pub fn run(mut self) -> Outcome {
        self.guarded(Self::begin);
        loop {
            match self.next_command() {
                Err(RecvTimeoutError::Disconnected) | Ok(Command::Quit) => break,
                Ok(command) => self.guarded(|this| this.execute(command)),
                Err(RecvTimeoutError::Timeout) => self.guarded(Self::step),
            }
        }
        Outcome {
            simulation: Some(self.simulation),
            step_seconds: self.step_seconds,
            energies: self.energies,
            stop: self.last.stop,
            scene: self.editor.map(|editor| editor.scene().clone()),
            not_written: None,
        }
    }

    fn begin(&mut self) {
        self.inspect();
        self.sample();
        self.publish();
    }

    /// Calls `part`. A panic in it stops the simulation and is published with the last snapshot.
    fn guarded(&mut self, part: impl FnOnce(&mut Self)) {
        if let Err(panic) = catch_unwind(AssertUnwindSafe(|| part(self))) {
            self.last.stop = Some(Stop::Panicked(panic_message(panic.as_ref())));
            self.slot.put(self.last.clone());
        }
    }

    /// Waits for the next command; returns a timeout when a step is due.
    fn next_command(&mut self) -> Result<Command, RecvTimeoutError> {
        if !self.is_running() {
            self.pace.restart();
            self.rate.restart();
            return self.commands.recv().map_err(|_| RecvTimeoutError::Disconnected);
        }
        let wait = match self.options.stepping {
            Stepping::RealTime => self.pace.wait(self.started.elapsed().as_secs_f64(), self.simulation.time()),
            Stepping::Frames(_) => 0.0,
        };
        self.commands.recv_timeout(Duration::from_secs_f64(wait))
    }

    fn is_running(&self) -> bool {
        let waits_for_frame = matches!(self.options.stepping, Stepping::Frames(_)) && !self.frame_requested;
        self.last.stop.is_none() && !self.last.paused && !self.is_finished() && !waits_for_frame
    }

    fn is_finished(&self) -> bool {
        self.options.steps.is_some_and(|steps| self.step_seconds.len() >= steps)
    }

    fn execute(&mut self, command: Command) {
        if matches!(command, Command::NextIntegrator | Command::Change(_) | Command::Set(..)) {
            self.recent.clear(); // steps of another kind
        }
        match command {
            Command::TogglePause => self.last.paused = !self.last.paused,
            Command::Reset => self.reset(),
            Command::NextIntegrator => {
                self.simulation.next_integrator();
                self.inspect();
            }
            Command::Change(changes) => self.change(&changes),
            Command::Set(key, value) => self.last.refusal = self.simulation.set_parameter(key, value).err(),
            Command::Save(path) => self.save(path),
            Command::Want(wanted) => self.wanted = wanted,
            Command::Pull(pull) => return self.pull(pull),
            Command::Pick(click, reply) => {
                let positions = self.simulation.positions();
                let place = |node: usize| (node, positions.fixed_rows::<3>(3 * node).into_owned());
                let _ = reply.send(self.simulation.pick(&click).into_iter().map(place).collect());
                return;
            }
            Command::NextFrame => return self.frame_requested = true,
            Command::Quit => return,
        }
        self.publish();
    }

    fn reset(&mut self) {
        self.simulation.reset();
        self.last.stop = None;
        self.last.refusal = None;
        self.forget_run();
    }

    /// Drops the results of a run that starts again.
    fn forget_run(&mut self) {
        self.history.clear();
        self.step_seconds.clear();
        self.energies.clear();
        self.last_frame = 0.0;
        self.pace.restart();
        self.rate.restart();
        self.sample();
    }

    fn step(&mut self) {
        let before = Instant::now();
        let outcome = self.simulation.step();
        let seconds = before.elapsed().as_secs_f64();
        match outcome {
            Ok(()) => self.after_step(seconds),
            Err(failure) => {
                let critical = self.simulation.critical_time_step();
                self.last.stop = Some(Stop::Failed(failure.with_critical_time_step(critical)));
            }
        }
        let show = match self.options.stepping {
            Stepping::RealTime => self.slot.wanted.swap(false, Ordering::AcqRel),
            Stepping::Frames(interval) => self.is_frame(interval),
        };
        if show || !self.is_running() {
            self.publish();
        }
    }

    fn after_step(&mut self, seconds: f64) {
        self.step_seconds.push(seconds);
        self.timers.add_step(seconds);
        self.recent.push_back(seconds);
        if self.recent.len() > STEPS_IN_MEDIAN {
            self.recent.pop_front();
        }
        let time = self.simulation.time();
        self.rate.mark(self.started.elapsed().as_secs_f64(), time);
        if self.options.log_energies {
            self.energies.push(EnergyRow::of(&*self.simulation));
        }
        self.sample();
    }

    /// Returns true if the time of the next frame has been reached; if so, the following frame has to be requested.
    fn is_frame(&mut self, interval: f64) -> bool {
        let time = self.simulation.time();
        let due = time >= self.last_frame + interval - 1e-9;
        if due {
            // A multiple of the interval: time steps that do not divide it would add up to a drift.
            self.last_frame += interval * ((time - self.last_frame) / interval + 1e-6).floor();
            self.frame_requested = false;
        }
        due
    }

    fn sample(&mut self) {
        let time = self.simulation.time();
        if self.history.wants(time) {
            self.history.push(EnergyRow::of(&*self.simulation));
        }
    }

    fn publish(&mut self) {
        self.timers.update(&*self.simulation);
        let simulation = &self.simulation;
        self.last = Snapshot {
            frame: Frame::of(&**simulation, self.wanted),
            shape: Some(simulation.shape()),
            contact_force: contact_force(&**simulation),
            weight: simulation.weight(),
            time: simulation.time(),
            steps: self.step_seconds.len(),
            step_seconds: quantile(self.recent.make_contiguous(), 0.5).unwrap_or(0.0),
            rate: self.rate.factor(),
            integrator: simulation.integrator(),
            parameters: simulation.parameters(),
            scene_parameters: self.editor.as_ref().map_or_else(Vec::new, |editor| editor.parameters()),
            object: self.editor.as_ref().and_then(|editor| editor.object()),
            setup: self.editor.as_ref().and_then(SceneEditor::setup),
            timers: self.timers.rows().to_vec(),
            timed_step: self.timers.step(),
            is_building: false,
            dt: simulation.dt(),
            history: self.history.to_vec(),
            finished: self.is_finished(),
            ..std::mem::take(&mut self.last)
        };
        self.slot.put(self.last.clone());
    }
}

/// Length of the sum of all forces of obstacles, N; `None` without obstacles.
fn contact_force(simulation: &dyn Simulation) -> Option<f64> {
    let contacts = simulation.contacts();
    let sum: Vector3<f64> = contacts.iter().map(|contact| Vector3::from(contact.force)).sum();
    (!contacts.is_empty()).then(|| sum.norm())
}

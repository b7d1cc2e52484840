//! Batches: many environments of one body, which step together.
//!
//! On the processor each environment is a [`Simulator`](crate::simulator::Simulator) of its own, spread over the threads. With
//! `solver.kind = "gpu"` whole steps run on a graphics device, and states are read on request.

#[cfg(feature = "gpu")]
mod device;
mod processor;

use fem_model::simulation::Failure;
use fem_model::{Batch as Values, Body, EnvironmentValues, Method, Refusal, SolverKind};

use fem_solvers::unusable_device;
use processor::OnProcessor;

/// Positions (m) and velocities (m/s) of all nodes, in the mesh's numbering.
#[derive(Clone, Debug, PartialEq)]
pub struct EnvironmentState {
    /// m
    pub positions: Vec<[f64; 3]>,
    /// m/s
    pub velocities: Vec<[f64; 3]>,
}

/// An environment that has failed. Its motion ends, and the others continue.
#[derive(Clone, Debug, PartialEq)]
pub struct EnvironmentFailure {
    /// Number of the environment, from 0.
    pub environment: usize,
    /// The step that failed.
    pub failure: Failure,
}

/// The environments of a batch, on the processor or on a device.
trait Environments: Send {
    /// Takes steps.
    fn advance(&mut self, steps: usize) -> Result<(), String>;

    /// The state of an environment now.
    fn state(&mut self, environment: usize) -> Result<EnvironmentState, String>;

    /// The environments that have failed so far.
    fn failures(&mut self) -> Result<Vec<EnvironmentFailure>, String>;

    /// Checks the present states for what no step has seen yet.
    fn check_ends(&mut self) -> Result<(), String>;

    /// Steps of all environments together that have not converged.
    fn unconverged_steps(&self) -> usize {
        0
    }

    /// Number of reads from a device so far.
    fn reads(&self) -> usize {
        0
    }

    /// Words that follow `on`.
    fn place(&self) -> String;
}

/// Many environments of one body.
pub struct Batch {
    environments: Box<dyn Environments>,
    values: Values,
    /// Failures after the number of steps at which they were asked for.
    failures: Option<Vec<EnvironmentFailure>>,
    dt: f64,
    steps: usize,
}

impl Batch {
    /// Builds all environments of a body.
    ///
    /// Returns an error that names the quantity if the engine, or the device that the method asks for, does not know something in it.
    pub fn new(body: Body, method: &Method, values: Values) -> Result<Self, Refusal> {
        let environments: Box<dyn Environments> = match on_device(&body, method, &values)? {
            Some(environments) => environments,
            None => Box::new(OnProcessor::new(&body, method, &values)?),
        };
        Ok(Self { environments, dt: method.dt, values, failures: None, steps: 0 })
    }

    /// Number of environments.
    pub fn count(&self) -> usize {
        self.values.0.len()
    }

    /// The varied quantities of an environment.
    pub fn values(&self, environment: usize) -> EnvironmentValues {
        self.values.0[environment]
    }

    /// Steps so far.
    pub fn steps(&self) -> usize {
        self.steps
    }

    /// Simulated time so far, s.
    pub fn time(&self) -> f64 {
        self.steps as f64 * self.dt
    }

    /// Advances all environments. The motion of one that fails ends, see [`failures`](Self::failures). Returns an error if the
    /// device is lost.
    pub fn advance(&mut self, steps: usize) -> Result<(), String> {
        self.failures = None;
        self.steps += steps;
        self.environments.advance(steps)
    }

    /// The state of an environment now. Returns an error if it has failed, or if the device is lost.
    pub fn state(&mut self, environment: usize) -> Result<EnvironmentState, String> {
        let failure = self.failures()?.iter().find(|failure| failure.environment == environment);
        match failure {
            Some(failure) => Err(failure.failure.to_string()),
            None => self.environments.state(environment),
        }
    }

    /// The environments that have failed so far, in their order. Returns an error if the device is lost.
    pub fn failures(&mut self) -> Result<&[EnvironmentFailure], String> {
        if self.failures.is_none() {
            self.failures = Some(self.environments.failures()?);
        }
        Ok(self.failures.as_deref().unwrap_or_default())
    }

    /// Checks the end of a run. On the processor each step has been checked, but for what is looked for every few steps. A device computes no energies: here all its states are
    /// read, and one more step of each is taken on the processor, which compares the energy with the supplied energy of loads and
    /// initial state. A motion that has grown without bound is then among the [`failures`](Self::failures), and a step that ends far
    /// from its solution among the [`unconverged_steps`](Self::unconverged_steps). Returns an error if the device is lost.
    pub fn check_ends(&mut self) -> Result<(), String> {
        self.failures = None;
        self.environments.check_ends()
    }

    /// Steps of all environments together that have not converged; on a device those that [`check_ends`](Self::check_ends) has found.
    pub fn unconverged_steps(&self) -> usize {
        self.environments.unconverged_steps()
    }

    /// Number of reads from a graphics device: one for each state, and one for the failures after some steps.
    pub fn reads(&self) -> usize {
        self.environments.reads()
    }

    /// The processor or the device, as words that follow `on`.
    pub fn place(&self) -> String {
        self.environments.place()
    }
}

/// The environments on the device that the method asks for.
fn on_device(body: &Body, method: &Method, values: &Values) -> Result<Option<Box<dyn Environments>>, Refusal> {
    let Some(solver) = method.solver.as_ref().filter(|solver| solver.kind == SolverKind::Gpu) else { return Ok(None) };
    if let Some(problem) = unusable_device(solver.precision) {
        return Err(Refusal::new("solver.kind", format!("is \"gpu\", and {problem}; leave the table out")));
    }
    #[cfg(feature = "gpu")]
    return device::build(body, method, values, solver.precision).map(Some);
    #[cfg(not(feature = "gpu"))]
    {
        let _ = (body, values);
        Ok(None)
    }
}

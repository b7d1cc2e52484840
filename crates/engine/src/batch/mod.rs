//! Batches: many environments of one scene, `[batch]`, which step together.
//!
//! On the processor each environment is a [`Simulator`](crate::simulator::Simulator) of its own, spread over the threads. With
//! `solver.kind = "gpu"` whole steps run on a graphics device, and states are read on request.

#[cfg(feature = "gpu")]
mod device;
mod processor;

use fem_scene::simulation::Failure;
use fem_scene::{Body, EnvironmentValues, Scene, SceneError, SolverKind};
use nalgebra::Vector3;

use crate::solvers::unusable_device;
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

    /// Checks the present states, if steps are not checked one by one.
    fn check_ends(&mut self) -> Result<(), String> {
        Ok(())
    }

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

/// Many environments of one scene.
pub struct Batch {
    environments: Box<dyn Environments>,
    scene: Scene,
    /// Failures after the number of steps at which they were asked for.
    failures: Option<Vec<EnvironmentFailure>>,
    dt: f64,
    steps: usize,
}

impl Batch {
    /// Builds all environments of a scene; a scene without `[batch]` is one. `body` is that of the scene itself.
    ///
    /// Returns an error that names the field if the engine, or the device that the scene asks for, does not know something in it.
    pub fn new(scene: &Scene, body: Body) -> Result<Self, SceneError> {
        let environments: Box<dyn Environments> = match on_device(scene, &body)? {
            Some(environments) => environments,
            None => Box::new(OnProcessor::new(scene, &body)?),
        };
        Ok(Self { environments, dt: scene.method().dt, scene: scene.clone(), failures: None, steps: 0 })
    }

    /// Number of environments.
    pub fn count(&self) -> usize {
        self.scene.environments()
    }

    /// The varied quantities of an environment.
    pub fn values(&self, environment: usize) -> EnvironmentValues {
        self.scene.batch.as_ref().map_or_else(EnvironmentValues::default, |batch| batch.values(environment))
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

    /// Checks the end of a run. On the processor each step has been checked. A device computes no energies: here all its states are
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

/// The environments on the device that the scene asks for.
fn on_device(scene: &Scene, body: &Body) -> Result<Option<Box<dyn Environments>>, SceneError> {
    let Some(solver) = scene.method().solver.filter(|solver| solver.kind == SolverKind::Gpu) else { return Ok(None) };
    if let Some(problem) = unusable_device(solver.precision) {
        let problem = format!("is \"gpu\", and {problem}; leave the table out");
        return Err(scene.refuse("solver.kind", &problem));
    }
    #[cfg(feature = "gpu")]
    return device::build(scene, body, solver.precision).map(Some);
    #[cfg(not(feature = "gpu"))]
    {
        let _ = body;
        Ok(None)
    }
}

/// The body of an environment of a scene whose own body is `body`.
fn body_of(environment: &Scene, body: &Body) -> Body {
    Body {
        material: environment.material.clone(),
        gravity: environment.gravity.as_ref().map(|gravity| Vector3::from(gravity.acceleration)),
        ..body.clone()
    }
}

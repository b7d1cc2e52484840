//! Environments on a graphics device: whole steps run there.

mod arrays;
mod refusals;

use std::sync::Arc;

use fem_gpu::{Bodies, DeviceError, Environment, Method as DeviceMethod, Number, Scheme};
use fem_model::simulation::{Cause, Failure};
use fem_model::{Batch as Values, Body, Method, Precision, Refusal};
use nalgebra::Vector3;

use super::{EnvironmentFailure, EnvironmentState, Environments};
use crate::model::system::System;
use crate::simulator::{Compiled, Simulator};
use fem_elements::materials::AnyLaw;
use fem_solvers::numbering::Numbering;
use fem_solvers::open_device;

/// Builds the environments of a body on the device in a precision.
pub(super) fn build(
    body: &Body,
    method: &Method,
    values: &Values,
    precision: Precision,
) -> Result<Box<dyn Environments>, Refusal> {
    Ok(match precision {
        Precision::F32 => Box::new(OnDevice::<f32>::new(body, method, values)?),
        Precision::F64 => Box::new(OnDevice::<f64>::new(body, method, values)?),
    })
}

/// The environments on the device.
struct OnDevice<N: Number> {
    bodies: Bodies<N>,
    adapter: String,
    numbering: Numbering,
    /// Undeformed positions in the mesh's numbering, m.
    rest: Vec<Vector3<f64>>,
    /// Nodes of the elements in the mesh's numbering.
    body: Body,
    values: Values,
    method: Method,
    /// Steps so far.
    steps: usize,
    /// Result of the check of each environment's end, if it was made after the last step.
    ends: Vec<Option<Result<bool, Failure>>>,
}

impl<N: Number> OnDevice<N> {
    fn new(body: &Body, method: &Method, values: &Values) -> Result<Self, Refusal> {
        let (law, mut scheme) = refusals::check(body, method)?;
        let system = System::<f64>::without_matrix(body, AnyLaw::<f64>::new(&body.material), &|_| Vec::new());
        if let Scheme::VertexBlockDescent { colors, .. } = &mut scheme {
            *colors = arrays::colors(&system, body);
        }
        let environments: Vec<Environment> = values.0.iter().map(|values| arrays::environment(body, values)).collect();
        let failed = |error: &DeviceError| match error {
            DeviceError::TooLarge { .. } => {
                let problem = format!("is {}: {error}; give fewer environments, or a coarser mesh", environments.len());
                Refusal::new("batch.count", problem)
            }
            _ => Refusal::new("solver.kind", format!("is \"gpu\": {error}; leave the table out")),
        };
        let device = open_device().map_err(failed)?;
        let dt = method.dt / method.substeps as f64;
        let alpha = body.damping.map_or(0.0, |damping| damping.alpha);
        let arrays = arrays::arrays(&system, body);
        let bodies = Bodies::new(&Arc::clone(device), &arrays, law, &DeviceMethod { scheme, dt, alpha }, &environments);
        Ok(Self {
            bodies: bodies.map_err(|error| failed(&error))?,
            adapter: device.adapter().to_owned(),
            numbering: system.numbering,
            rest: body.shape.mesh.vertices().to_vec(),
            body: body.clone(),
            values: values.clone(),
            method: method.clone(),
            steps: 0,
            ends: Vec::new(),
        })
    }

    /// det F of an element of an environment now.
    fn det_F(&mut self, environment: usize, element: usize) -> Result<f64, DeviceError> {
        let [u, _] = self.bodies.state(environment)?;
        let u = self.numbering.to_mesh(&u);
        let displacement = |node: usize| Vector3::from(u[node].map(N::as_f64));
        let G = self.body.shape.mesh.displacement_gradient(element, displacement);
        Ok((nalgebra::Matrix3::identity() + G).determinant())
    }

    fn failure(&mut self, environment: usize, trouble: fem_gpu::Trouble) -> Result<EnvironmentFailure, DeviceError> {
        let cause = match trouble.cause {
            fem_gpu::Cause::NotFinite { node } => Cause::NotFinite { node: self.numbering.mesh_node[node] as usize },
            fem_gpu::Cause::Inverted { element } => {
                Cause::Inverted { element, J: self.det_F(environment, element)?.min(0.0) }
            }
        };
        let Method { dt, substeps, integrator, .. } = self.method;
        // The device counts substeps.
        let step = trouble.step.div_ceil(substeps).saturating_sub(1);
        let failure = Failure::of_step(step, step as f64 * dt, dt, integrator, cause);
        Ok(EnvironmentFailure { environment, failure })
    }

    fn all_failures(&mut self) -> Result<Vec<EnvironmentFailure>, DeviceError> {
        let troubles = self.bodies.troubles()?.into_iter().enumerate();
        let troubled = troubles.filter_map(|(environment, trouble)| Some((environment, trouble?)));
        let mut failures: Vec<_> =
            troubled.map(|(environment, trouble)| self.failure(environment, trouble)).collect::<Result<_, _>>()?;
        failures.extend(self.ends.iter().enumerate().filter_map(|(environment, end)| match end {
            Some(Err(failure)) => Some(EnvironmentFailure { environment, failure: failure.clone() }),
            _ => None,
        }));
        failures.sort_by_key(|failure| failure.environment);
        Ok(failures)
    }

    /// Displacements, m, and velocities, m/s, of an environment in the mesh's numbering.
    fn motion(&mut self, environment: usize) -> Result<[Vec<[f64; 3]>; 2], DeviceError> {
        let vectors = self.bodies.state(environment)?;
        let in_mesh = |vector: Vec<[N; 3]>| self.numbering.to_mesh(&vector).into_iter().map(|x| x.map(N::as_f64));
        Ok(vectors.map(|vector| in_mesh(vector).collect()))
    }

    /// Takes one more step on the processor from the end of an environment.
    fn step_on_processor(&mut self, environment: usize) -> Result<Result<bool, Failure>, String> {
        let [u, v] = self.motion(environment).map_err(lost)?;
        let body = self.body.environment(&self.values.0[environment]);
        let method = Method { solver: None, ..self.method.clone() };
        Ok(match method.precision {
            Precision::F64 => end::<f64>(body, &method, (self.steps, &u, &v))?,
            Precision::F32 => end::<f32>(body, &method, (self.steps, &u, &v))?,
        })
    }
}

impl<N: Number> Environments for OnDevice<N> {
    fn advance(&mut self, steps: usize) -> Result<(), String> {
        self.ends.clear();
        self.steps += steps;
        self.bodies.advance(steps * self.method.substeps).map_err(lost)
    }

    fn state(&mut self, environment: usize) -> Result<EnvironmentState, String> {
        let [u, velocities] = self.motion(environment).map_err(lost)?;
        let positions = self.rest.iter().zip(u).map(|(X, u)| [0, 1, 2].map(|i| X[i] + u[i]));
        Ok(EnvironmentState { positions: positions.collect(), velocities })
    }

    fn check_ends(&mut self) -> Result<(), String> {
        let failed = self.failures()?;
        let has_failed = |environment| failed.iter().any(|failure| failure.environment == environment);
        let ends = (0..self.values.0.len()).map(|environment| {
            if self.steps == 0 || has_failed(environment) {
                Ok(None)
            } else {
                self.step_on_processor(environment).map(Some)
            }
        });
        self.ends = ends.collect::<Result<_, String>>()?;
        Ok(())
    }

    fn unconverged_steps(&self) -> usize {
        self.ends.iter().filter(|end| matches!(end, Some(Ok(false)))).count()
    }

    fn failures(&mut self) -> Result<Vec<EnvironmentFailure>, String> {
        self.all_failures().map_err(lost)
    }

    fn reads(&self) -> usize {
        self.bodies.reads()
    }

    fn place(&self) -> String {
        format!("the graphics device {}", self.adapter)
    }
}

fn lost(error: DeviceError) -> String {
    format!("{error}; use fewer environments, or leave solver.kind = \"gpu\" out")
}

/// One step on the processor from displacements and velocities after so many steps; whether it has converged.
fn end<T: Compiled>(
    body: Body,
    method: &Method,
    (steps, u, v): (usize, &[[f64; 3]], &[[f64; 3]]),
) -> Result<Result<bool, Failure>, String> {
    let mut simulator = Simulator::<T>::new(body, method).map_err(|error| error.to_string())?;
    Ok(simulator.step_from(steps, u, v))
}

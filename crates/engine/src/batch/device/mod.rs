//! Environments on a graphics device: whole steps run there.

mod arrays;
mod refusals;

use std::sync::Arc;

use fem_gpu::{Bodies, DeviceError, Environment, Method as DeviceMethod, Number, Scheme};
use fem_scene::simulation::{Cause, Failure};
use fem_scene::{Body, Method, Precision, Scene, SceneError};
use nalgebra::Vector3;

use super::{EnvironmentFailure, EnvironmentState, Environments};
use crate::materials::AnyLaw;
use crate::model::numbering::Numbering;
use crate::model::system::System;
use crate::number::Real;
use crate::solvers::open_device;

/// Builds the environments of a scene on the device in a precision.
pub(super) fn build(scene: &Scene, body: &Body, precision: Precision) -> Result<Box<dyn Environments>, SceneError> {
    Ok(match precision {
        Precision::F32 => Box::new(OnDevice::<f32>::new(scene, body)?),
        Precision::F64 => Box::new(OnDevice::<f64>::new(scene, body)?),
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
    method: Method,
}

impl<N: Number> OnDevice<N> {
    fn new(scene: &Scene, body: &Body) -> Result<Self, SceneError> {
        let refuse = |(field, problem): (&str, String)| scene.refuse(field, &problem);
        let method = scene.method();
        let (law, mut scheme) = refusals::check(scene, body).map_err(refuse)?;
        let system =
            System::<f64>::without_matrix(body, AnyLaw::<<f64 as Real>::Lanes>::new(&body.material), &|_| Vec::new());
        if let Scheme::VertexBlockDescent { colors, .. } = &mut scheme {
            *colors = arrays::colors(&system, body);
        }
        let environments: Vec<Environment> =
            (0..scene.environments()).map(|number| arrays::environment(scene, number)).collect();
        let failed = |error: &DeviceError| match error {
            DeviceError::TooLarge { .. } => {
                let problem = format!("is {}: {error}; give fewer environments, or a coarser mesh", environments.len());
                scene.refuse("batch.count", &problem)
            }
            _ => scene.refuse("solver.kind", &format!("is \"gpu\": {error}; leave the table out")),
        };
        let device = open_device().map_err(failed)?;
        let dt = method.dt / method.substeps as f64;
        let alpha = body.damping.map_or(0.0, |damping| damping.alpha);
        let arrays = arrays::tetrahedra(&system, body);
        let bodies = Bodies::new(&Arc::clone(device), &arrays, law, &DeviceMethod { scheme, dt, alpha }, &environments);
        Ok(Self {
            bodies: bodies.map_err(|error| failed(&error))?,
            adapter: device.adapter().to_owned(),
            numbering: system.numbering,
            rest: body.shape.mesh.vertices().to_vec(),
            body: body.clone(),
            method,
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
        troubled.map(|(environment, trouble)| self.failure(environment, trouble)).collect()
    }
}

impl<N: Number> Environments for OnDevice<N> {
    fn advance(&mut self, steps: usize) -> Result<(), String> {
        self.bodies.advance(steps * self.method.substeps).map_err(lost)
    }

    fn state(&mut self, environment: usize) -> Result<EnvironmentState, String> {
        let [u, v] = self.bodies.state(environment).map_err(lost)?;
        let in_mesh = |vectors: &[[N; 3]]| -> Vec<[f64; 3]> {
            self.numbering.to_mesh(vectors).into_iter().map(|vector| vector.map(N::as_f64)).collect()
        };
        let positions = self.rest.iter().zip(in_mesh(&u)).map(|(X, u)| [0, 1, 2].map(|i| X[i] + u[i]));
        Ok(EnvironmentState { positions: positions.collect(), velocities: in_mesh(&v) })
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

//! The default of `contact.transition_speed`, from the speeds of the scene.

use nalgebra::Vector3;

use super::planes::{ContactPlane, PlaneMotion};
use crate::{BodyMesh, DirichletCondition, Scene};

/// Largest default, in lengths of the body per second; Li et al., Incremental Potential Contact (2020).
const PER_SECOND: f64 = 1e-3;

/// The same in speeds √(g L) of a fall through the body's length: large bodies move by fewer lengths per second.
const OF_FALL: f64 = 1e-3;

/// The same in the slowest of the given speeds, which has to be a sliding speed.
const OF_SLIDING: f64 = 0.1;

/// Least sliding in a step at these speeds, in lengths of the body: less is lost in the tolerance of Newton's method.
const RESOLVED: f64 = 1e-8;

/// Part of a speed along a plane that is a rounding error.
const ROUNDING: f64 = 1e-9;

/// The motions of a scene that let a body slide along its obstacles.
pub(super) struct Moving<'a> {
    pub mesh: &'a BodyMesh,
    pub planes: &'a [ContactPlane],
    pub dirichlet: &'a [DirichletCondition],
    pub initial_velocity: &'a [Vector3<f64>],
}

impl Moving<'_> {
    /// The smallest of the speeds that these constants name, m/s, so that what the scene moves slides at its full friction.
    pub fn transition_speed(&self, scene: &Scene) -> f64 {
        let length = self.mesh.length();
        let gravity = scene.gravity.as_ref().map(|gravity| Vector3::from(gravity.acceleration).norm());
        let fall = gravity.filter(|g| *g > 0.0).map(|g| OF_FALL * (g * length).sqrt());
        let sliding = self.sliding_speeds().into_iter().filter(|speed| *speed > 0.0);
        let method = scene.method();
        let resolved = RESOLVED * length * method.substeps as f64 / method.dt;
        let speeds = sliding.map(|speed| OF_SLIDING * speed).chain(fall);
        speeds.map(|speed| speed.max(resolved)).fold(PER_SECOND * length, f64::min)
    }

    /// The largest speed of each motion along the planes with friction, m/s: of prescribed motions, the initial velocity and the planes.
    fn sliding_speeds(&self) -> Vec<f64> {
        let x = self.mesh.vertices();
        let mut all = Vec::new();
        for plane in self.planes.iter().filter(|plane| plane.friction > 0.0) {
            let along = |v: Vector3<f64>| {
                let speed = (v - plane.normal * plane.normal.dot(&v)).norm();
                if speed > ROUNDING * v.norm() { speed } else { 0.0 }
            };
            all.push(self.initial_velocity.iter().map(|v| along(*v)).fold(0.0, f64::max));
            all.push(match &plane.motion {
                PlaneMotion::AtRest => 0.0,
                PlaneMotion::Uniform { velocity, .. } => along(*velocity),
                PlaneMotion::Curve { displacement, curve } => along(*displacement) * curve.largest_rate(),
            });
            for condition in self.dirichlet {
                let Some(motion) = &condition.motion else { continue };
                let rate = motion.curve.as_ref().map_or(0.0, |curve| curve.largest_rate());
                let speed = |&node: &usize| {
                    let velocity = motion.derivatives(&x[node], 0.0)[0] * rate;
                    along(Vector3::from_fn(|i, _| if condition.components[i] { velocity[i] } else { 0.0 }))
                };
                all.push(condition.nodes.iter().map(speed).fold(0.0, f64::max));
            }
        }
        all
    }
}

//! The obstacles of a scene.

use nalgebra::Vector3;

use super::transition::Moving;
use crate::check::contact::check;
use crate::tables::PlaneTable;
use crate::{BodyMesh, DirichletCondition, Integrator, LoadCurve, Scene, SceneError};

/// Obstacles, and how the body is kept outside.
#[derive(Clone, Debug, PartialEq)]
pub struct Contact {
    /// One for each `[[planes]]`.
    pub planes: Vec<ContactPlane>,
    /// How a step keeps the body outside.
    pub treatment: ContactTreatment,
    /// True if a plane stands back from a body that is nearer at the start than the distance at which its barrier bears the
    /// body. A load step finds its balance by itself.
    pub may_stand_back: bool,
    /// Distance below which a barrier repels the body, m.
    pub activation_distance: f64,
    /// Speed of sliding from which friction has its full size, m/s.
    pub transition_speed: f64,
}

/// How a time step keeps a body outside its obstacles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ContactTreatment {
    /// A barrier energy, in implicit methods.
    Barrier,
    /// Impulses at the end of a step, in explicit methods.
    Impulses,
    /// Nodes put onto the planes as the iterations of a step go on, with Coulomb's bound on the way along them.
    Projection,
}

/// A half-space that the body does not enter.
#[derive(Clone, Debug, PartialEq)]
pub struct ContactPlane {
    /// A point of the plane before its motion, m.
    pub point: Vector3<f64>,
    /// Unit normal, towards the body.
    pub normal: Vector3<f64>,
    /// Coefficient of Coulomb friction.
    pub friction: f64,
    /// How the plane moves.
    pub motion: PlaneMotion,
}

/// Motion of an obstacle.
#[derive(Clone, Debug, PartialEq)]
pub enum PlaneMotion {
    /// The plane stays where it is.
    AtRest,
    /// A constant velocity.
    Uniform {
        /// m/s
        velocity: Vector3<f64>,
        /// Time at which the motion ends, s; infinite for a motion without end.
        until: f64,
    },
    /// A displacement times a factor of time.
    Curve {
        /// m
        displacement: Vector3<f64>,
        /// Its factor, without jumps.
        curve: LoadCurve,
    },
}

impl ContactPlane {
    /// Displacement of the plane at a time (s), m.
    pub fn displacement(&self, time: f64) -> Vector3<f64> {
        match &self.motion {
            PlaneMotion::AtRest => Vector3::zeros(),
            PlaneMotion::Uniform { velocity, until } => velocity * time.min(*until),
            PlaneMotion::Curve { displacement, curve } => displacement * curve.factor(time),
        }
    }

    /// Its mean velocity between two times (s), m/s.
    pub fn mean_velocity(&self, [from, to]: [f64; 2]) -> Vector3<f64> {
        match &self.motion {
            PlaneMotion::AtRest => Vector3::zeros(),
            PlaneMotion::Uniform { velocity, until } if to <= *until => *velocity,
            _ => (self.displacement(to) - self.displacement(from)) / (to - from),
        }
    }

    /// Returns true if the plane never moves.
    pub fn is_at_rest(&self) -> bool {
        self.motion == PlaneMotion::AtRest
    }

    fn new(table: &PlaneTable) -> Self {
        Self {
            point: table.point.into(),
            normal: unit(table.normal.into()),
            friction: table.friction,
            motion: PlaneMotion::new(table),
        }
    }
}

impl PlaneMotion {
    fn new(table: &PlaneTable) -> Self {
        let curve = table.curve.as_ref().map(|curve| curve.curve());
        match (table.velocity, table.displacement.zip(curve)) {
            (_, Some((displacement, curve))) => Self::Curve { displacement: displacement.into(), curve },
            (Some(velocity), None) if velocity != [0.0; 3] => {
                Self::Uniform { velocity: velocity.into(), until: table.until.unwrap_or(f64::INFINITY) }
            }
            _ => Self::AtRest,
        }
    }
}

/// Activation distance where the scene gives none, in lengths of the body.
const ACTIVATION_DISTANCE: f64 = 1e-3;

/// Depth at the start that counts as touching, in lengths of the body: a sum of rounding errors.
const TOUCHING: f64 = 1e-9;

/// The obstacles of `[[planes]]`, if there are some. Refuses a body that lies behind a plane at the start.
pub(crate) fn contact(
    scene: &Scene,
    mesh: &BodyMesh,
    (dirichlet, initial_velocity): (&[DirichletCondition], &[Vector3<f64>]),
) -> Result<Option<Contact>, SceneError> {
    if scene.planes.is_empty() {
        return Ok(None);
    }
    // The integrator may be another one than that of the file.
    check(scene).map_err(|(field, problem)| scene.refuse(&field, &problem))?;
    let planes: Vec<_> = scene.planes.iter().map(ContactPlane::new).collect();
    let length = mesh.length();
    for (number, plane) in planes.iter().enumerate() {
        let gaps =
            mesh.vertices().iter().map(|x| plane.normal.dot(&(x - plane.point - plane.displacement(0.0)))).enumerate();
        let (node, gap) = gaps.fold((0, f64::INFINITY), |least, next| if next.1 < least.1 { next } else { least });
        // NaN fails the comparison.
        if !(gap >= -TOUCHING * length) {
            let text = format!(
                "has the body behind it at the start: node {node} is {:.3e} m deep; move planes[{number}].point back, or the body away",
                -gap
            );
            return Err(scene.refuse(&format!("planes[{number}]"), &text));
        }
    }
    let table = scene.contact.clone().unwrap_or_default();
    let treatment = match scene.time.integrator {
        method if method.is_explicit() => ContactTreatment::Impulses,
        method if method.projects_contact() => ContactTreatment::Projection,
        _ => ContactTreatment::Barrier,
    };
    let moving = Moving { mesh, planes: &planes, dirichlet, initial_velocity };
    let transition_speed = table.transition_speed.unwrap_or_else(|| moving.transition_speed(scene));
    Ok(Some(Contact {
        planes,
        treatment,
        may_stand_back: treatment == ContactTreatment::Barrier && scene.time.integrator != Integrator::Static,
        activation_distance: table.activation_distance.unwrap_or(ACTIVATION_DISTANCE * length),
        transition_speed,
    }))
}

/// A vector of length 1, without overflow on the way.
fn unit(vector: Vector3<f64>) -> Vector3<f64> {
    (vector / vector.amax()).normalize()
}

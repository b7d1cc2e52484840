//! The obstacles of a scene.

use nalgebra::Vector3;

use super::planes::ContactPlane;
use super::transition::Moving;
use crate::check::contact::check;
use crate::{BodyMesh, DirichletCondition, Integrator, Scene, SceneError};

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

//! Contact with obstacles.

use nalgebra::Vector3;

use crate::{Body, ContactPlane, Integrator, Method, PlaneMotion, Refusal};

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

/// Default of the activation distance, in lengths of the body.
const ACTIVATION_DISTANCE: f64 = 1e-3;

/// Depth at the start that counts as touching, in lengths of the body: a sum of rounding errors.
const TOUCHING: f64 = 1e-9;

/// Largest default of the transition speed, in lengths of the body per second; Li et al., Incremental Potential Contact (2020).
const PER_SECOND: f64 = 1e-3;

/// The same in speeds √(g L) of a fall through the body's length: large bodies move by fewer lengths per second.
const OF_FALL: f64 = 1e-3;

/// The same in the slowest of the given speeds, which has to be a sliding speed.
const OF_SLIDING: f64 = 0.1;

/// Least sliding in a step at these speeds, in lengths of the body: less is lost in the tolerance of Newton's method.
const RESOLVED: f64 = 1e-8;

/// Part of a speed along a plane that is a rounding error.
const ROUNDING: f64 = 1e-9;

impl Contact {
    /// Planes that keep a body outside, as the method treats them. Refuses a body that lies behind one of them at the start.
    pub fn new(planes: Vec<ContactPlane>, body: &Body, method: &Method) -> Result<Self, Refusal> {
        let length = body.shape.mesh.length();
        check_outside(&planes, body.shape.mesh.vertices(), TOUCHING * length)?;
        let treatment = match method.integrator {
            integrator if integrator.is_explicit() => ContactTreatment::Impulses,
            integrator if integrator.projects_contact() => ContactTreatment::Projection,
            _ => ContactTreatment::Barrier,
        };
        Ok(Self {
            treatment,
            may_stand_back: treatment == ContactTreatment::Barrier && method.integrator != Integrator::Static,
            activation_distance: ACTIVATION_DISTANCE * length,
            transition_speed: transition_speed(&planes, body, method, length),
            planes,
        })
    }
}

/// Refuses planes behind which a node is deeper than a tolerance, m.
fn check_outside(planes: &[ContactPlane], x: &[Vector3<f64>], tolerance: f64) -> Result<(), Refusal> {
    for (number, plane) in planes.iter().enumerate() {
        let gaps = x.iter().map(|x| plane.normal.dot(&(x - plane.point - plane.displacement(0.0)))).enumerate();
        let (node, gap) = gaps.fold((0, f64::INFINITY), |least, next| if next.1 < least.1 { next } else { least });
        // NaN fails the comparison.
        if !(gap >= -tolerance) {
            let text = format!(
                "has the body behind it at the start: node {node} is {:.3e} m deep; move planes[{number}].point back, or the body away",
                -gap
            );
            return Err(Refusal::new(format!("planes[{number}]"), text));
        }
    }
    Ok(())
}

/// The smallest of the speeds that the constants above name, m/s, so that all that moves slides at its full friction.
fn transition_speed(planes: &[ContactPlane], body: &Body, method: &Method, length: f64) -> f64 {
    let gravity = body.gravity.map(|gravity| gravity.norm());
    let fall = gravity.filter(|g| *g > 0.0).map(|g| OF_FALL * (g * length).sqrt());
    let sliding = sliding_speeds(planes, body).into_iter().filter(|speed| *speed > 0.0);
    let resolved = RESOLVED * length * method.substeps as f64 / method.dt;
    let speeds = sliding.map(|speed| OF_SLIDING * speed).chain(fall);
    speeds.map(|speed| speed.max(resolved)).fold(PER_SECOND * length, f64::min)
}

/// The largest speed of each motion along the planes with friction, m/s: of prescribed motions, the initial velocity and the planes.
fn sliding_speeds(planes: &[ContactPlane], body: &Body) -> Vec<f64> {
    let x = body.shape.mesh.vertices();
    let mut all = Vec::new();
    for plane in planes.iter().filter(|plane| plane.friction > 0.0) {
        let along = |v: Vector3<f64>| {
            let speed = (v - plane.normal * plane.normal.dot(&v)).norm();
            if speed > ROUNDING * v.norm() { speed } else { 0.0 }
        };
        all.push(body.initial_velocity.iter().map(|v| along(*v)).fold(0.0, f64::max));
        all.push(match &plane.motion {
            PlaneMotion::AtRest => 0.0,
            PlaneMotion::Uniform { velocity, .. } => along(*velocity),
            PlaneMotion::Curve { displacement, curve } => along(*displacement) * curve.largest_rate(),
        });
        for condition in &body.dirichlet {
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

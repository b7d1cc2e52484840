//! The obstacles of a body, and the defaults of their numbers.

use nalgebra::Vector3;

use crate::numbers::{check_not_negative, check_vector, problem};
use crate::{Body, Contact, ContactPlane, ContactTreatment, Integrator, Method, PlaneMotion, Refusal};

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

/// Relative rounding error of a speed along a plane, and of the length of its normal.
const ROUNDING: f64 = 1e-9;

impl Body {
    /// Adds obstacles, which the method treats in its way. Constraints, gravity and initial velocity come before, since the speed at
    /// which friction has its full size follows from them.
    pub fn obstacles(mut self, planes: Vec<ContactPlane>, method: &Method) -> Result<Self, Refusal> {
        self.contact = Some(self.contact_with(planes, method)?);
        Ok(self)
    }

    /// The contact with planes, as the method treats them. Refuses a body that lies behind one of them at the start.
    pub fn contact_with(&self, planes: Vec<ContactPlane>, method: &Method) -> Result<Contact, Refusal> {
        let length = self.shape.mesh.length();
        check_outside(&planes, self.shape.mesh.vertices(), TOUCHING * length)?;
        let Some(treatment) = method.integrator.facts().contact else {
            let name = method.integrator.name();
            let text =
                format!("stand beside {name}, whose steps cannot keep a body outside an obstacle; use implicit_euler");
            return Err(Refusal::new("planes", text));
        };
        Ok(Contact {
            treatment,
            may_stand_back: treatment == ContactTreatment::Barrier && method.integrator != Integrator::Static,
            activation_distance: ACTIVATION_DISTANCE * length,
            transition_speed: transition_speed(&planes, self, method, length),
            planes,
        })
    }
}

/// Refuses planes without a direction, and those behind which a node is deeper than a tolerance, m.
fn check_outside(planes: &[ContactPlane], x: &[Vector3<f64>], tolerance: f64) -> Result<(), Refusal> {
    for (number, plane) in planes.iter().enumerate() {
        let table = format!("planes[{number}]");
        check_vector(&format!("{table}.point"), &plane.point.into())?;
        // NaN fails the comparison.
        if !((plane.normal.norm() - 1.0).abs() <= ROUNDING) {
            return problem(&format!("{table}.normal"), "has no length of 1; give a direction that is not zero");
        }
        check_not_negative(&format!("{table}.friction"), plane.friction, "(no friction)")?;
        let gaps = x.iter().map(|x| plane.normal.dot(&(x - plane.point - plane.displacement(0.0)))).enumerate();
        let (node, gap) = gaps.fold((0, f64::INFINITY), |least, next| if next.1 < least.1 { next } else { least });
        // NaN fails the comparison.
        if !(gap >= -tolerance) {
            let text = format!(
                "has the body behind it at the start: node {node} is {:.3e} m deep; move planes[{number}].point back, or the body away",
                -gap
            );
            return problem(&table, text);
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

//! Kinematics of prescribed motion: position, velocity and acceleration of a node in closed form.

use std::f64::consts::TAU;

use fem_scene::Motion;
use nalgebra::Vector3;

/// Returns true if the motion is not at rest.
pub(super) fn moves(motion: &Motion) -> bool {
    motion.rotation.as_ref().is_some_and(|rotation| rotation.turns != 0.0) || motion.displacement != Vector3::zeros()
}

/// Position, m, velocity, m/s, and acceleration, m/s², at a time, s, of a node with the undeformed position X. `begin` is the start of
/// the interval between two velocity jumps that holds `time`.
pub(super) fn kinematics(motion: &Motion, X: &Vector3<f64>, begin: f64, time: f64) -> [Vector3<f64>; 3] {
    let over = motion.over.unwrap_or(f64::INFINITY);
    let fraction = if over.is_finite() { motion.fraction(time) } else { 0.0 };
    let place = motion.position(X, fraction);
    if begin >= over {
        return [place, Vector3::zeros(), Vector3::zeros()];
    }
    let displacement = motion.displacement;
    let (mut velocity, mut acceleration) = (displacement / over, Vector3::zeros());
    if let Some(rotation) = &motion.rotation {
        let rate = (TAU * rotation.turns / over) * rotation.axis.into_inner();
        let arm = place - fraction * displacement - rotation.center;
        velocity += rate.cross(&arm);
        acceleration = rate.cross(&rate.cross(&arm));
    }
    [place, velocity, acceleration]
}

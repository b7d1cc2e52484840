//! Kinematics of prescribed motion: position, velocity and acceleration of a node in closed form.

use std::f64::consts::TAU;

use fem_model::Motion;
use nalgebra::Vector3;

/// Returns true if the motion is not at rest.
pub(super) fn moves(motion: &Motion) -> bool {
    motion.rotation.as_ref().is_some_and(|rotation| rotation.turns != 0.0) || motion.displacement != Vector3::zeros()
}

/// Position, m, velocity, m/s, and acceleration, m/s², at a time, s, of a node with the undeformed position X. `begin` is the start of
/// the interval between two velocity jumps that holds `time`.
pub(super) fn kinematics(motion: &Motion, X: &Vector3<f64>, begin: f64, time: f64) -> [Vector3<f64>; 3] {
    let Some(curve) = &motion.curve else { return [*X, Vector3::zeros(), Vector3::zeros()] };
    let fraction = curve.factor(time);
    // Between two kinks the curve is linear: its rate at the end of the interval is that at its begin.
    let [rate, change] = curve.derivatives(if curve.kinks().is_empty() { time } else { begin });
    let place = motion.position(X, fraction);
    let displacement = motion.displacement;
    let (mut first, mut second) = (displacement, Vector3::zeros());
    if let Some(rotation) = &motion.rotation {
        let angle = TAU * rotation.turns * rotation.axis.into_inner();
        let arm = place - fraction * displacement - rotation.center;
        first += angle.cross(&arm);
        second = angle.cross(&angle.cross(&arm));
    }
    [place, rate * first, rate * rate * second + change * first]
}

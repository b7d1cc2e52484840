//! Velocities and accelerations of prescribed motions.

use std::f64::consts::TAU;

use fem_model::{LoadCurve, Motion};
use nalgebra::Vector3;

use super::dirichlet::DirichletConditions;
use fem_solvers::Real;

impl DirichletConditions {
    /// Overwrites the constrained entries with velocities (m/s) and accelerations (m/s²) of the prescribed motions at a time, s. At a
    /// kink they are the one-sided values on the side of `inside`, a time beside the kink. They are zero for a motion that jumps, and for
    /// a fixed node. `rest` are the undeformed positions, m.
    pub fn write_rates<T: Real>(
        &self,
        rest: &[Vector3<f64>],
        (time, inside): (f64, f64),
        velocity: &mut [[T; 3]],
        acceleration: &mut [[T; 3]],
    ) {
        self.clear_constrained(velocity);
        self.clear_constrained(acceleration);
        for (condition, motion) in self.motions() {
            let Some(curve) = &motion.curve else { continue };
            for &node in &condition.nodes {
                let rates = rates(motion, curve, &rest[node], (time, inside));
                for i in (0..3).filter(|&i| condition.components[i]) {
                    velocity[node][i] = T::of(rates[0][i]);
                    acceleration[node][i] = T::of(rates[1][i]);
                }
            }
        }
    }
}

/// Velocity and acceleration of a node with the undeformed position X. With the fraction f of the motion, its angle θ = 2π · turns · f
/// and the rotated arm r, x = c + r + f d, ẋ = ḟ (θ' × r + d), ẍ = f̈ (θ' × r + d) + ḟ² θ' × (θ' × r), θ' = dθ/df.
fn rates(motion: &Motion, curve: &LoadCurve, X: &Vector3<f64>, (time, inside): (f64, f64)) -> [Vector3<f64>; 2] {
    // All curves but a sine are linear between kinks.
    let [rate, change] = curve.derivatives(if matches!(curve, LoadCurve::Sine { .. }) { time } else { inside });
    let (mut first, mut second) = (motion.displacement, Vector3::zeros());
    if let Some(rotation) = &motion.rotation {
        let fraction = curve.factor(time);
        let angle = TAU * rotation.turns * rotation.axis.into_inner();
        let arm = motion.position(X, fraction) - fraction * motion.displacement - rotation.center;
        first += angle.cross(&arm);
        second = angle.cross(&angle.cross(&arm));
    }
    [rate * first, rate * rate * second + change * first]
}

#[cfg(test)]
mod tests {
    use fem_model::Rotation;

    use super::*;

    #[test]
    fn rates_of_a_turning_motion_are_the_differences_of_its_positions() {
        let rotation = Rotation { axis: Vector3::y_axis(), center: Vector3::new(0.1, 0.2, -0.3), turns: 0.4 };
        let displacement = Vector3::new(0.3, -0.1, 0.2);
        let X = Vector3::new(1.0, 0.5, 2.0);
        for curve in [LoadCurve::Ramp(2.0), LoadCurve::Sine { frequency: 0.7, phase: 0.3 }] {
            let motion = Motion { displacement, rotation: Some(rotation.clone()), curve: Some(curve.clone()) };
            let (time, h) = (0.7, 1e-4);
            let [before, at, after] = [-h, 0.0, h].map(|h| motion.position(&X, motion.fraction(time + h)));
            let [velocity, acceleration] = rates(&motion, &curve, &X, (time, time));
            // The differences have errors of h² times derivatives of third and fourth order.
            let tolerance = 1e-6 * acceleration.norm();
            assert!((velocity - (after - before) / (2.0 * h)).amax() < tolerance);
            assert!((acceleration - (after - 2.0 * at + before) / (h * h)).amax() < tolerance);
        }
    }
}

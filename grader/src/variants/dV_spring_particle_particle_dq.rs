//! Mistakes in `dV_spring_particle_particle_dq`.

use finite_elements_3d as solved;
use nalgebra::{SVector, Vector3};

use super::Variant;

/// The mistakes that are known.
pub const VARIANTS: &[Variant] = &[
    variant!(
        dV_spring_particle_particle_dq,
        "negated",
        "The sign is reversed: the page asks for the gradient of the energy, not the force. Or are the ends exchanged?",
        |q0, q1, l0, stiffness| -solved::dV_spring_particle_particle_dq(q0, q1, l0, stiffness)
    ),
    variant!(
        dV_spring_particle_particle_dq,
        "NaN at zero length",
        "With both ends in one place something is divided by zero. When do you look at the length?",
        |q0, q1, l0, stiffness| {
            let d = q1 - q0;
            both_ends(&((d - d / d.norm() * l0) * stiffness))
        }
    ),
    variant!(
        dV_spring_particle_particle_dq,
        "small number added to the length",
        "A small number added for safety makes every answer slightly wrong, and that of a short spring very wrong.",
        |q0, q1, l0, stiffness| {
            let d = q1 - q0;
            both_ends(&(d / (d.norm() + 1e-6) * (stiffness * (d.norm() - l0))))
        }
    ),
    variant!(
        dV_spring_particle_particle_dq,
        "direction not normalised",
        "The force has the unit N·m here: a direction has no unit.",
        |q0, q1, l0, stiffness| {
            let d = q1 - q0;
            both_ends(&(d * (stiffness * (d.norm() - l0))))
        }
    ),
    variant!(
        dV_spring_particle_particle_dq,
        "one end only",
        "A spring pulls at both of its ends, equally hard. The energy depends on both.",
        |q0, q1, l0, stiffness| {
            let mut gradient = solved::dV_spring_particle_particle_dq(q0, q1, l0, stiffness);
            gradient.fixed_rows_mut::<3>(0).fill(0.0);
            gradient
        }
    ),
    variant!(
        dV_spring_particle_particle_dq,
        "short springs cut off",
        "Very short springs pull too. Only a length of exactly zero has no direction.",
        |q0, q1, l0, stiffness| {
            if (q1 - q0).norm() < 1e-6 {
                SVector::zeros()
            } else {
                solved::dV_spring_particle_particle_dq(q0, q1, l0, stiffness)
            }
        }
    ),
    variant!(
        dV_spring_particle_particle_dq,
        "missing rest length",
        "A spring at its rest length does not pull. Where does the rest length enter?",
        |q0, q1, _, stiffness| solved::dV_spring_particle_particle_dq(q0, q1, 0.0, stiffness)
    ),
    variant!(
        dV_spring_particle_particle_dq,
        "scaled by 0.5",
        "The answer is half of what it should be: think of the derivative of a square.",
        |q0, q1, l0, stiffness| solved::dV_spring_particle_particle_dq(q0, q1, l0, stiffness) * 0.5
    ),
];

fn both_ends(on_q1: &Vector3<f64>) -> SVector<f64, 6> {
    SVector::from_fn(|row, _| if row < 3 { -on_q1[row] } else { on_q1[row - 3] })
}

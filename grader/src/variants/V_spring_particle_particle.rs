//! Mistakes in `V_spring_particle_particle`.

use finite_elements_3d as solved;

use super::Variant;

/// The mistakes that are known.
pub const VARIANTS: &[Variant] = &[
    variant!(
        V_spring_particle_particle,
        "squared lengths",
        "Lengths are compared, not their squares. Look at the unit of the answer.",
        |q0, q1, l0, stiffness| 0.5 * stiffness * ((q1 - q0).norm_squared() - l0 * l0).powi(2)
    ),
    variant!(
        V_spring_particle_particle,
        "difference of squares",
        "The square of a difference is not the difference of the squares. At the rest length it cannot tell.",
        |q0, q1, l0, stiffness| 0.5 * stiffness * ((q1 - q0).norm_squared() - l0 * l0)
    ),
    variant!(
        V_spring_particle_particle,
        "scaled by 2",
        "The energy is twice too large: integrate the tension from the rest length on.",
        |q0, q1, l0, stiffness| 2.0 * solved::V_spring_particle_particle(q0, q1, l0, stiffness)
    ),
    variant!(
        V_spring_particle_particle,
        "only under tension",
        "This spring resists compression too.",
        |q0, q1, l0, stiffness| 0.5 * stiffness * ((q1 - q0).norm() - l0).max(0.0).powi(2)
    ),
    variant!(
        V_spring_particle_particle,
        "zero at zero length",
        "With both ends in one place the spring is compressed, and its energy is finite and not zero.",
        |q0, q1, l0, stiffness| {
            if q0 == q1 { 0.0 } else { solved::V_spring_particle_particle(q0, q1, l0, stiffness) }
        }
    ),
    variant!(
        V_spring_particle_particle,
        "missing rest length",
        "A spring at its rest length stores nothing. Where does the rest length enter?",
        |q0, q1, _, stiffness| solved::V_spring_particle_particle(q0, q1, 0.0, stiffness)
    ),
    variant!(
        V_spring_particle_particle,
        "not squared",
        "Stretch the spring twice as far: how much more work is that?",
        |q0, q1, l0, stiffness| 0.5 * stiffness * ((q1 - q0).norm() - l0).abs()
    ),
];

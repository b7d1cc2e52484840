//! Timers of the parts of a body.

use fem_model::Timer;

/// Timers of a body's parts; their times do not overlap. Each force has a timer of its own beside it.
#[derive(Debug, Default)]
pub struct Profile {
    /// Elastic forces without their energy.
    pub forces: Timer,
    /// Elastic energies, each with the forces of the same state.
    pub energies: Timer,
    /// Assembly of the exact stiffness.
    pub stiffness: Timer,
    /// Assembly of the projected stiffness.
    pub projection: Timer,
    /// Products with the mass matrix.
    pub mass: Timer,
    /// Prescribed motions.
    pub prescribed: Timer,
    /// Damping forces.
    pub damping: Timer,
    /// Plastic flow, once in every accepted step.
    pub plasticity: Timer,
}

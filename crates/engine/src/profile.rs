//! How often each part of a body is used, and for how long. A part that a scene leaves out has a meter that never turns.

pub use fem_scene::Timer;

/// The meters of a body's parts. Their times do not overlap.
#[derive(Debug, Default)]
#[allow(missing_docs)] // the names are those of the parts
pub struct Work {
    pub forces: Timer,
    /// Energies, each with the forces of the same state.
    pub energies: Timer,
    /// Element stiffnesses as they are.
    pub stiffness: Timer,
    /// Element stiffnesses with their projection.
    pub projection: Timer,
    pub mass: Timer,
    pub dead_load: Timer,
    pub prescribed: Timer,
    pub springs: Timer,
    pub pressure: Timer,
    pub damping: Timer,
    pub drag: Timer,
}

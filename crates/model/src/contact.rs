//! Contact with obstacles.

use crate::ContactPlane;

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

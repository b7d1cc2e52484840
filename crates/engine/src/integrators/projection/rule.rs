//! Rules by which constraints correct the nodes.

/// Rule by which a constraint corrects the nodes of its element.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Rule {
    /// The stress of the material is the unknown, and the equation of motion holds at all times.
    Stress,
    /// XPBD with the constraint C = √(2ψ) and compliance 1/V: Macklin, Müller and Chentanez 2016, algorithm 1.
    Energy,
    /// PBD with the constraint C = J − 1, corrected by a fraction of it: Müller et al. 2007, equation 8.
    Volume {
        /// Stiffness of one iteration, 0 to 1.
        stiffness: f64,
    },
}

/// Time and stiffness of a sweep.
#[derive(Clone, Copy)]
pub struct Sweep {
    /// Rule by which constraints correct the nodes.
    pub rule: Rule,
    /// Square of the time that forces have to move nodes, s².
    pub dt2: f64,
}

impl Rule {
    /// Returns true if the multiplier of a constraint is a force or a stress, which moves nodes by Δt²/m of it.
    pub(super) fn has_force(self) -> bool {
        match self {
            Self::Stress | Self::Energy => true,
            Self::Volume { .. } => false,
        }
    }
}

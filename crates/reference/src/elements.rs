//! Elements and the forms of their volume energy, side by side.

use std::fmt;

use fem_model::Volumetric;

/// The elements of a body, and the form of their volume energy.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Elements {
    /// Order of the shape functions.
    pub order: usize,
    /// Evaluation of the energy of the volume.
    pub volumetric: Volumetric,
}

/// Linear elements with the energy of their law.
pub const LINEAR: Elements = Elements { order: 1, volumetric: Volumetric::Standard };

/// Quadratic ones with the energy of their law.
pub const QUADRATIC: Elements = Elements { order: 2, volumetric: Volumetric::Standard };

/// Elements that do not lock near ν = ½, or hardly.
pub const WITHOUT_LOCKING: [Elements; 5] = [
    LINEAR.with(Volumetric::Averaged),
    LINEAR.with(Volumetric::Mixed),
    QUADRATIC,
    QUADRATIC.with(Volumetric::Averaged),
    QUADRATIC.with(Volumetric::Mixed),
];

impl Elements {
    /// The same elements with another form of their volume energy.
    pub const fn with(self, volumetric: Volumetric) -> Self {
        Self { volumetric, ..self }
    }
}

impl fmt::Display for Elements {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let order = if self.order == 1 { "linear" } else { "quadratic" };
        match self.volumetric {
            Volumetric::Standard => write!(f, "{order} elements"),
            form => write!(f, "{order} elements, {}", form.name()),
        }
    }
}

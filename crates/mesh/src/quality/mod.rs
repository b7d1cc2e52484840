//! Sizes and shapes of elements, and faults of surfaces.

mod surface;
mod tetrahedra;
mod triangles;

pub use surface::{SurfaceQuality, surface_quality};
pub(crate) use tetrahedra::smallest_dihedral_angle;
pub use tetrahedra::{Quality, quality};

/// An extreme value and its element, counted from 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extreme {
    /// The value; infinite for a mesh without elements.
    pub value: f64,
    /// The first element with this value.
    pub element: usize,
}

impl Extreme {
    fn negated(self) -> Self {
        Self { value: -self.value, ..self }
    }
}

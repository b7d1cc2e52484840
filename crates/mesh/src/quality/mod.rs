//! Sizes and shapes of elements, and faults of surfaces.

mod distribution;
mod distributions;
mod intersections;
mod surface;
mod tetrahedra;
mod triangles;

pub use distribution::Distribution;
pub use distributions::{tetrahedron_distributions, triangle_distributions};
pub use intersections::{SelfIntersections, self_intersections};
pub(crate) use intersections::{Triangle, meet, segment_meets};
pub(crate) use surface::branching_places;
pub use surface::{SurfaceQuality, surface_quality};
pub(crate) use tetrahedra::extreme_dihedral_angles;
pub use tetrahedra::{Quality, quality, tetrahedron_radius_to_edge};
pub use triangles::{TriangleQuality, triangle_quality, triangle_radius_to_edge};

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

fn extreme<S>(shapes: &[S], value: impl Fn(&S) -> f64) -> Extreme {
    let mut worst = Extreme { value: f64::INFINITY, element: 0 };
    for (element, shape) in shapes.iter().enumerate() {
        if value(shape) < worst.value {
            worst = Extreme { value: value(shape), element };
        }
    }
    worst
}

/// The smallest value that a share of sorted values does not exceed; NaN without values.
fn quantile(sorted: &[f64], share: f64) -> f64 {
    let rank = (share * sorted.len() as f64).ceil() as usize;
    sorted.get(rank.saturating_sub(1)).copied().unwrap_or(f64::NAN)
}

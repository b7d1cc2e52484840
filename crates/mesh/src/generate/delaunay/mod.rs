//! Delaunay meshes of points: no point lies inside the circumscribed circle or sphere of an element.
//!
//! Every decision is exact: the signs of determinants come from the adaptive predicates of Shewchuk, Adaptive Precision Floating-Point
//! Arithmetic and Fast Robust Geometric Predicates (1997). Grids, cospherical, collinear and repeated points need no perturbation.

mod cavity;
mod hilbert;
mod plane;
mod refinement;
mod tetrahedra;

use nalgebra::SVector;
use spade::{MAX_ALLOWED_VALUE, MIN_ALLOWED_VALUE};
use thiserror::Error;

use crate::Mesh;

pub use hilbert::insertion_order;
pub(crate) use plane::triangulate_with;
pub use plane::{triangulate, triangulate_region};
pub(crate) use refinement::{Bounds, cut_encroached, refine};
pub use tetrahedra::tetrahedralize;

/// The Delaunay mesh of points.
#[derive(Clone, Debug, PartialEq)]
pub struct Delaunay<const D: usize, const N: usize> {
    /// Positively oriented elements that fill the convex hull. Its vertices are the distinct points, in their order.
    pub mesh: Mesh<D, N>,
    /// Vertex of each point; points at one place share a vertex.
    pub vertices: Vec<usize>,
}

/// Reason why points have no Delaunay mesh.
#[derive(Clone, Debug, Error, PartialEq)]
#[allow(missing_docs)] // the messages are the documentation of the fields
pub enum DelaunayError {
    /// A coordinate is NaN, infinite or out of range.
    #[error(
        "point {point} (counted from 0) has a coordinate that is not finite, or beyond 3e60 in size; give it a finite position"
    )]
    NotFinite { point: usize },
    /// All points lie in one plane, or on one line in two dimensions.
    #[error("all {points} points lie {in_what}; add a point outside of it")]
    Flat { points: usize, in_what: &'static str },
    /// Polygons cross or touch each other or themselves.
    #[error(
        "the edge from point {} to point {} (counted from 0) crosses or touches another edge or point; part the polygons there", points[0], points[1]
    )]
    Crossing { points: [usize; 2] },
}

/// The points with coordinates for which the predicates neither overflow nor underflow: those below 2⁻¹⁴² in size become zero, and those
/// beyond 2²⁰¹ are refused.
fn in_range<const D: usize>(points: &[SVector<f64, D>]) -> Result<Vec<SVector<f64, D>>, DelaunayError> {
    if let Some(point) = points.iter().position(|x| !x.iter().all(|x| x.abs() <= MAX_ALLOWED_VALUE)) {
        return Err(DelaunayError::NotFinite { point });
    }
    Ok(points.iter().map(|x| x.map(|x| if x.abs() < MIN_ALLOWED_VALUE { 0.0 } else { x })).collect())
}

/// Numbers the distinct points in their order. `first` holds for each point the first one at its place.
fn number_distinct(first: &[usize]) -> (Vec<usize>, Vec<usize>) {
    let (mut vertices, mut kept) = (vec![0; first.len()], Vec::new());
    for (point, &first) in first.iter().enumerate() {
        if first == point {
            vertices[point] = kept.len();
            kept.push(point);
        } else {
            vertices[point] = vertices[first];
        }
    }
    (vertices, kept)
}

//! Delaunay tetrahedralization of points in space.

use nalgebra::Vector3;
use robust::{Coord3D, orient3d};

use super::cavity::Growing;
use super::hilbert::insertion_order;
use super::{Delaunay, DelaunayError, in_range, number_distinct};
use crate::Mesh;
use crate::generate::Progress;

/// Times that the progress is told.
const TOLD: usize = 200;

/// The Delaunay tetrahedralization of points, m. Where five and more points lie on an empty sphere, one of the possible ones. Tells how
/// many of the points are inserted.
///
/// # Errors
/// A coordinate that is not finite, or points in one plane.
///
/// ```
/// use fem_mesh::generate::delaunay::tetrahedralize;
/// use nalgebra::Vector3;
///
/// let corners = (0..8).map(|i| Vector3::new((i & 1) as f64, (i >> 1 & 1) as f64, (i >> 2) as f64));
/// let cube = tetrahedralize(&corners.collect::<Vec<_>>(), &|_| ())?.mesh;
/// let volume: f64 = fem_mesh::volumes(&cube).iter().sum();
/// assert!((volume - 1.0).abs() < 1e-14);
/// # Ok::<(), fem_mesh::generate::delaunay::DelaunayError>(())
/// ```
pub fn tetrahedralize(points: &[Vector3<f64>], progress: Progress) -> Result<Delaunay<3, 4>, DelaunayError> {
    let points = &in_range(points)?;
    let order = insertion_order(points);
    let flat = DelaunayError::Flat { points: points.len(), in_what: "in one plane" };
    let start = first_tetrahedron(points, &order).ok_or(flat)?;
    let mut growing = Growing::new(points, start);
    let mut first: Vec<usize> = (0..points.len()).collect();
    let told_after = points.len().div_ceil(TOLD);
    for (done, &point) in order.iter().filter(|&&point| !start.contains(&(point as u32))).enumerate() {
        if done % told_after == 0 {
            progress(done as f64 / points.len() as f64);
        }
        if let Some(vertex) = growing.insert(point as u32) {
            first[point] = vertex as usize;
        }
    }
    keep_the_earliest(&mut first);
    let (vertices, kept) = number_distinct(&first);
    let elements = growing.tetrahedra().into_iter().map(|cell| cell.map(|point| vertices[point as usize])).collect();
    Ok(Delaunay { mesh: Mesh::new(kept.into_iter().map(|point| points[point]).collect(), elements), vertices })
}

/// Four points that are not in one plane: the first in the order, and the earliest that add a dimension each.
fn first_tetrahedron(points: &[Vector3<f64>], order: &[usize]) -> Option<[u32; 4]> {
    let at = |point: usize| {
        let [x, y, z] = points[point].into();
        Coord3D { x, y, z }
    };
    let a = *order.first()?;
    let b = *order.iter().find(|&&b| points[b] != points[a])?;
    let c = *order.iter().find(|&&c| !are_collinear([a, b, c].map(|point| points[point])))?;
    let d = *order.iter().find(|&&d| orient3d(at(a), at(b), at(c), at(d)) != 0.0)?;
    Some([a, b, c, d].map(|point| point as u32))
}

/// Three points are collinear if their projections on all three coordinate planes are.
fn are_collinear([a, b, c]: [Vector3<f64>; 3]) -> bool {
    (0..3).all(|i| {
        let j = (i + 1) % 3;
        let [a, b, c] = [a, b, c].map(|x| robust::Coord { x: x[i], y: x[j] });
        robust::orient2d(a, b, c) == 0.0
    })
}

/// Points at one place shall share the vertex of the one with the smallest index, whichever was inserted first.
fn keep_the_earliest(first: &mut [usize]) {
    let mut earliest: Vec<usize> = (0..first.len()).collect();
    for point in 0..first.len() {
        earliest[first[point]] = earliest[first[point]].min(point);
    }
    for point in 0..first.len() {
        first[point] = earliest[first[point]];
    }
}

//! Delaunay triangulation of points in the plane, by the library spade.

use std::collections::HashMap;

use nalgebra::Vector2;
use spade::{DelaunayTriangulation, Point2, Triangulation};

use super::{Delaunay, DelaunayError, in_range, number_distinct};
use crate::Mesh;

/// The Delaunay triangulation of points, m; triangles are counter-clockwise. Where four and more points lie on an empty circle, one of
/// the possible ones.
///
/// # Errors
/// A coordinate that is not finite, or points on one line.
pub fn triangulate(points: &[Vector2<f64>]) -> Result<Delaunay<2, 3>, DelaunayError> {
    let points = in_range(points)?;
    let (vertices, kept) = number_distinct(&first_at_each_place(&points));
    let flat = DelaunayError::Flat { points: points.len(), in_what: "on one line" };
    let places = kept.iter().map(|&point| Point2::new(points[point].x, points[point].y)).collect();
    // The coordinates are in the range that spade takes.
    let triangulation = DelaunayTriangulation::<Point2<f64>>::bulk_load_stable(places).map_err(|_| flat.clone())?;
    if triangulation.all_vertices_on_line() {
        return Err(flat);
    }
    let elements = triangulation.inner_faces().map(|face| face.vertices().map(|vertex| vertex.index())).collect();
    Ok(Delaunay { mesh: Mesh::new(kept.into_iter().map(|point| points[point]).collect(), elements), vertices })
}

/// Index of the first point at the place of each point.
fn first_at_each_place(points: &[Vector2<f64>]) -> Vec<usize> {
    let mut places: HashMap<[u64; 2], usize> = HashMap::with_capacity(points.len());
    // Adding zero turns −0 into 0.
    let key = |x: &Vector2<f64>| [x.x, x.y].map(|x| (x + 0.0).to_bits());
    points.iter().enumerate().map(|(point, x)| *places.entry(key(x)).or_insert(point)).collect()
}

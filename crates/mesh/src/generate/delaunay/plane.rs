//! Delaunay triangulation of points in the plane, and of a region that closed polygons bound, by the library spade.

use std::collections::VecDeque;

use nalgebra::Vector2;
use spade::handles::{FixedFaceHandle, FixedVertexHandle, InnerTag};
use spade::{ConstrainedDelaunayTriangulation, DelaunayTriangulation, Point2, Triangulation};

use super::{Delaunay, DelaunayError, in_range, number_distinct};
use crate::Mesh;
use crate::connectivity::first_at_each_place;
use crate::generate::triangulation::Triangulation as Connected;

type Constrained = ConstrainedDelaunayTriangulation<Point2<f64>>;

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

/// The constrained Delaunay triangulation of the region inside closed polygons, m: of the points with an odd winding number, so that a
/// polygon within another is a hole, whichever way it runs. Vertices are those of the polygons, one after the other; triangles are
/// counter-clockwise, and no other vertex that a triangle sees lies inside its circumscribed circle.
///
/// # Errors
/// A coordinate that is not finite, polygons that cross or touch, and polygons without area.
///
/// ```
/// use fem_mesh::generate::delaunay::triangulate_region;
/// use nalgebra::Vector2;
///
/// let square = |size: f64| [[-size, -size], [size, -size], [size, size], [-size, size]].map(Vector2::from).to_vec();
/// let frame = triangulate_region(&[square(2.0), square(1.0)])?;
/// assert!((fem_mesh::triangle_quality(&frame).area - 12.0).abs() < 1e-14); // m²
/// assert_eq!(frame.elements.len(), 8);
/// # Ok::<(), fem_mesh::generate::delaunay::DelaunayError>(())
/// ```
pub fn triangulate_region(polygons: &[Vec<Vector2<f64>>]) -> Result<Mesh<2, 3>, DelaunayError> {
    Ok(triangulate_with(polygons, &[])?.into_mesh())
}

/// As [`triangulate_region`], with the triangles' neighbours, and with vertices at these points inside as well; they follow those of the polygons.
pub(crate) fn triangulate_with(
    polygons: &[Vec<Vector2<f64>>],
    inner: &[Vector2<f64>],
) -> Result<Connected, DelaunayError> {
    let mut points = polygons.concat();
    points.extend(inner);
    let points = in_range(&points)?;
    let flat = DelaunayError::Flat { points: points.len(), in_what: "on one line" };
    let mut triangulation = Constrained::new();
    let mut handles = Vec::with_capacity(points.len());
    for (point, x) in points.iter().enumerate() {
        // The coordinates are in the range that spade takes.
        let vertex = triangulation.insert(Point2::new(x.x, x.y)).map_err(|_| DelaunayError::NotFinite { point })?;
        if vertex.index() != point {
            return Err(DelaunayError::Crossing { points: [vertex.index(), point] });
        }
        handles.push(vertex);
    }
    constrain(&mut triangulation, polygons, &handles)?;
    let is_inside = inside(&triangulation);
    let faces = triangulation.inner_faces().filter(|face| is_inside[face.index()]);
    let triangles: Vec<_> = faces.map(|face| face.vertices().map(|vertex| vertex.index() as u32)).collect();
    if triangles.is_empty() {
        return Err(flat);
    }
    Connected::new(points, triangles, &[]).map_err(|points| DelaunayError::Crossing { points })
}

fn constrain(
    triangulation: &mut Constrained,
    polygons: &[Vec<Vector2<f64>>],
    handles: &[FixedVertexHandle],
) -> Result<(), DelaunayError> {
    let mut first = 0;
    for polygon in polygons {
        for i in 0..polygon.len() {
            let ends = [first + i, first + (i + 1) % polygon.len()];
            let [a, b] = ends.map(|point| handles[point]);
            // An edge that runs through another vertex would become several.
            let made = triangulation.try_add_constraint(a, b);
            if made.len() != 1 {
                return Err(DelaunayError::Crossing { points: ends });
            }
        }
        first += polygon.len();
    }
    Ok(())
}

/// True for each face that is reached from outside across an odd number of constrained edges.
fn inside(triangulation: &Constrained) -> Vec<bool> {
    let mut known: Vec<Option<bool>> = vec![None; triangulation.num_all_faces()];
    let mut queue: VecDeque<(FixedFaceHandle<InnerTag>, bool)> = VecDeque::new();
    for edge in triangulation.convex_hull() {
        if let Some(face) = edge.rev().face().as_inner() {
            queue.push_back((face.fix(), edge.is_constraint_edge()));
        }
    }
    while let Some((face, is_inside)) = queue.pop_front() {
        if known[face.index()].replace(is_inside).is_some() {
            continue;
        }
        for edge in triangulation.face(face).adjacent_edges() {
            if let Some(next) = edge.rev().face().as_inner()
                && known[next.index()].is_none()
            {
                queue.push_back((next.fix(), is_inside != edge.is_constraint_edge()));
            }
        }
    }
    known.into_iter().map(|inside| inside.unwrap_or(false)).collect()
}

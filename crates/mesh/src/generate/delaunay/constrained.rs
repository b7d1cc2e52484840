//! Constrained Delaunay triangulation of a region that closed polygons bound, by the library spade.

use std::collections::VecDeque;

use nalgebra::Vector2;
use spade::handles::{FixedFaceHandle, FixedVertexHandle, InnerTag};
use spade::{ConstrainedDelaunayTriangulation, Point2, Triangulation};

use super::{DelaunayError, in_range};
use crate::Mesh;
use crate::generate::triangulation::{OUTSIDE, Triangulation as Connected};

type Constrained = ConstrainedDelaunayTriangulation<Point2<f64>>;

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
    let connected = connect(points, &triangulation);
    if connected.triangles.is_empty() { Err(flat) } else { Ok(connected) }
}

/// The triangles inside the polygons, with their neighbours there.
fn connect(points: Vec<Vector2<f64>>, triangulation: &Constrained) -> Connected {
    let is_inside = inside(triangulation);
    let mut number = vec![OUTSIDE; is_inside.len()];
    let faces = || triangulation.inner_faces().filter(|face| is_inside[face.index()]);
    faces().zip(0..).for_each(|(face, triangle)| number[face.index()] = triangle);
    let (mut triangles, mut neighbours) = (Vec::new(), Vec::new());
    for face in faces() {
        let edges = face.adjacent_edges();
        triangles.push(edges.map(|edge| edge.from().index() as u32));
        // The edge opposite a corner is the one after the edge that leaves the corner.
        neighbours.push([1, 2, 0].map(|i| number[edges[i].rev().face().index()]));
    }
    Connected::of(points, triangles, neighbours)
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

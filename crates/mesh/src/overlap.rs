//! Bodies that lie in one another.

use nalgebra::Vector3;

use super::area_vector;
use super::boundary::FACES;
use super::boxes::{Bounds, BoxTree};

/// Depth below which two elements touch and do not overlap, relative to their size.
const TOUCHING: f64 = 1e-4;

/// Least and largest corner of a box around the volume that two sets of elements have in common, m; `None` if they share no more than their
/// surfaces. Elements have a positive volume.
pub fn overlap(
    vertices: &[Vector3<f64>],
    tetrahedra: &[[usize; 4]],
    a: &[usize],
    b: &[usize],
) -> Option<[Vector3<f64>; 2]> {
    let corners = |element: usize| tetrahedra[element].map(|node| vertices[node]);
    let tree = BoxTree::new(a.iter().map(|&element| (element, Bounds::of(&corners(element)))).collect());
    let mut points: Option<Bounds> = None;
    for &element in b {
        let of_b = corners(element);
        tree.touching(&Bounds::of(&of_b), |other| {
            let of_a = corners(other);
            for point in common(of_a, of_b).chain(common(of_b, of_a)) {
                let more = Bounds::of(&[point]);
                points = Some(points.map_or(more, |points| points.join(&more)));
            }
        });
    }
    points.map(|points| [points.least, points.largest])
}

/// Corners of the faces of one tetrahedron, which is made smaller by the depth of a touch, cut by another one.
fn common(smaller: [Vector3<f64>; 4], solid: [Vector3<f64>; 4]) -> impl Iterator<Item = Vector3<f64>> {
    let centre = smaller.iter().sum::<Vector3<f64>>() / 4.0;
    let smaller = smaller.map(|x| x + TOUCHING * (centre - x));
    let planes = FACES.map(|face| {
        let corners = face.map(|corner| solid[corner]);
        (corners[0], area_vector(corners))
    });
    let cut = move |face: [usize; 3]| {
        planes.iter().fold(face.map(|corner| smaller[corner]).to_vec(), |polygon, (point, normal)| {
            clipped(&polygon, |x| normal.dot(&(x - point)))
        })
    };
    FACES.into_iter().flat_map(cut)
}

/// The part of a polygon where a linear function is negative. Source: Sutherland and Hodgman, Reentrant Polygon Clipping (1974).
fn clipped(polygon: &[Vector3<f64>], outside: impl Fn(&Vector3<f64>) -> f64) -> Vec<Vector3<f64>> {
    let mut kept = Vec::with_capacity(polygon.len() + 1);
    for (i, x) in polygon.iter().enumerate() {
        let next = &polygon[(i + 1) % polygon.len()];
        let (here, there) = (outside(x), outside(next));
        if here < 0.0 {
            kept.push(*x);
        }
        if (here < 0.0) != (there < 0.0) {
            kept.push(x + (next - x) * (here / (here - there)));
        }
    }
    kept
}

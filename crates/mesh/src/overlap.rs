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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Pattern, box_mesh, join};

    /// Two boxes, the second one scaled and moved.
    fn two(scale: f64, shift: Vector3<f64>) -> Option<[Vector3<f64>; 2]> {
        let first = box_mesh([2.0, 1.0, 1.0], 2, Pattern::Alternating).unwrap();
        let mut second = first.clone();
        second.vertices.iter_mut().for_each(|x| *x = scale * *x + shift);
        let count = first.elements.len();
        let mesh = join([("a".to_owned(), first), ("b".to_owned(), second)]);
        overlap(
            &mesh.vertices,
            &mesh.elements,
            &(0..count).collect::<Vec<_>>(),
            &(count..2 * count).collect::<Vec<_>>(),
        )
    }

    #[test]
    fn the_box_of_an_overlap_is_that_of_the_common_volume() {
        let [least, largest] = two(1.0, Vector3::new(1.3, 0.2, -0.4)).unwrap();
        assert!((least - Vector3::new(1.3, 0.2, 0.0)).amax() < 1e-3, "{least}");
        assert!((largest - Vector3::new(2.0, 1.0, 0.6)).amax() < 1e-3, "{largest}");
        let [least, largest] = two(1.0, Vector3::zeros()).unwrap();
        assert!(least.amax() < 1e-3 && (largest - Vector3::new(2.0, 1.0, 1.0)).amax() < 1e-3, "equal bodies");
        let [least, largest] = two(0.1, Vector3::repeat(0.3)).unwrap();
        assert!((least - Vector3::repeat(0.3)).amax() < 1e-3 && (largest - Vector3::new(0.5, 0.4, 0.4)).amax() < 1e-3);
    }

    #[test]
    fn bodies_that_touch_or_are_apart_do_not_overlap() {
        assert_eq!(two(1.0, Vector3::new(2.0, 0.0, 0.0)), None);
        assert_eq!(two(1.0, Vector3::new(0.3, 1.0, 0.1)), None);
        assert_eq!(two(1.0, Vector3::new(0.0, 0.0, 1.5)), None);
    }
}

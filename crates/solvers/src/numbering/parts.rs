//! The ordering for sweeps over the rows: from one end of the body to the other, or, for large bodies, from the ends of parts to
//! the separators between them, so that several threads sweep side by side.

use nalgebra::Vector3;

use super::bisection::{Bisection, Halves};
use super::longest_axes;

/// Smallest number of nodes of a part. With smaller parts more of the sweeps' error remains at the separators, and threads
/// wait for each other.
const PART: usize = 1500;

/// Largest number of bisections, one inside the other.
const DEPTH: usize = 4;

/// The nodes part by part: two halves, between which there is no element, then the separator between them. Each half is divided
/// in the same way or sorted towards the separator.
pub(super) fn by_parts<const N: usize>(
    mut nodes: Vec<u32>,
    vertices: &[Vector3<f64>],
    elements: &[[usize; N]],
) -> Vec<u32> {
    if nodes.len() >= 2 * PART {
        divide(&mut nodes, &mut Bisection::new(vertices, elements), None, DEPTH);
    } else {
        sort(&mut nodes, vertices, None);
    }
    nodes
}

/// A half: on which side of a cut across an axis.
type Half = (usize, bool);

fn divide(nodes: &mut [u32], bisection: &mut Bisection, half: Option<Half>, depth: usize) {
    let x = bisection.vertices;
    if depth == 0 || nodes.len() < 2 * PART {
        return sort(nodes, x, half);
    }
    match bisection.cut(nodes) {
        Some(Halves { left, right, separator, axis }) => {
            divide(left, bisection, Some((axis, false)), depth - 1);
            divide(right, bisection, Some((axis, true)), depth - 1);
            sort(separator, x, None);
        }
        None => sort(nodes, x, half),
    }
}

/// Sorts along the longest axis, in a half towards the cut if that is across the same axis; ties along the next axes, and at
/// last by number.
fn sort(nodes: &mut [u32], vertices: &[Vector3<f64>], half: Option<Half>) {
    let Some(axes) = longest_axes(nodes, vertices) else { return };
    nodes.sort_unstable_by(|&a, &b| {
        let (x, y) = (&vertices[a as usize], &vertices[b as usize]);
        let along = |axis: usize| x[axis].total_cmp(&y[axis]);
        along(axes[0]).then(along(axes[1])).then(along(axes[2])).then(a.cmp(&b))
    });
    if half == Some((axes[0], true)) {
        nodes.reverse();
    }
}

//! Self-intersections of a surface: pairs of triangles that have more in common than their corners and edges.

mod predicates;

use std::ops::ControlFlow;

use crate::SurfaceMesh;
use crate::boxes::{Bounds, BoxTree};
use crate::connectivity::first_at_each_place;
pub(crate) use predicates::{Triangle, meet, segment_meets};
use predicates::{meet_beyond_corner, meet_beyond_edge};

/// Largest numbers of pairs that are counted, and that are tested: all triangles of a surface may cross all others.
const MOST: [usize; 2] = [1_000_000, 200_000_000];

/// The pairs of crossing triangles of a surface.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct SelfIntersections {
    /// Number of pairs.
    pub count: usize,
    /// The first pair: smallest first triangle, then smallest second one, counted from 0.
    pub first: Option<[usize; 2]>,
    /// The search ended early because of too many pairs; there may be more.
    pub has_more: bool,
}

/// Pairs of triangles with a common point that is no common corner and on no common edge, with exact predicates.
///
/// Triangles that share an edge cross if they lie on each other in one plane; equal triangles cross. Corners at one place are one
/// corner, so that a surface of separate triangles has no crossings where it is whole. Triangles whose corners lie on one line are left
/// out. The search ends at 10⁶ crossings, or after 2·10⁸ pairs of triangles whose boxes touch; a clean surface has about 10 for each
/// triangle. Indices have to be in range.
pub fn self_intersections(mesh: &SurfaceMesh) -> SelfIntersections {
    let first = first_at_each_place(&mesh.vertices);
    let corners: Vec<[usize; 3]> = mesh.elements.iter().map(|element| element.map(|i| first[i])).collect();
    let triangles: Vec<Option<Triangle>> =
        mesh.elements.iter().map(|element| Triangle::new(element.map(|i| mesh.vertices[i]))).collect();
    let solid = (0..triangles.len()).filter(|&i| triangles[i].is_some());
    let bounds = |i: usize| Bounds::of(&mesh.elements[i].map(|corner| mesh.vertices[corner]));
    let tree = BoxTree::new(solid.map(|i| (i, bounds(i))).collect());
    let (mut found, mut seen) = (SelfIntersections::default(), 0);
    let end = tree.pairs(|i, j| {
        seen += 1;
        let is_crossing = match (&triangles[i], &triangles[j]) {
            (Some(a), Some(b)) => cross((a, corners[i]), (b, corners[j])),
            _ => false,
        };
        if is_crossing {
            found.count += 1;
            let pair = [i.min(j), i.max(j)];
            found.first = Some(found.first.map_or(pair, |first| first.min(pair)));
        }
        if found.count < MOST[0] && seen < MOST[1] { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
    });
    SelfIntersections { has_more: end.is_break(), ..found }
}

/// Returns true if two triangles, with the places of their corners, cross.
fn cross((a, corners): (&Triangle, [usize; 3]), (b, others): (&Triangle, [usize; 3])) -> bool {
    let is_shared = corners.map(|corner| others.contains(&corner));
    let other = |is_wanted: bool| (0..3).find(|&j| corners.contains(&others[j]) == is_wanted);
    match is_shared.iter().filter(|&&is_shared| is_shared).count() {
        0 => meet(a, b),
        1 => {
            let i = is_shared.iter().position(|&is_shared| is_shared);
            i.zip(other(true)).is_some_and(|(i, j)| meet_beyond_corner(a, i, b, j))
        }
        2 => {
            let i = is_shared.iter().position(|&is_shared| !is_shared);
            i.zip(other(false)).is_some_and(|(i, j)| meet_beyond_edge(a, i, b, j))
        }
        _ => true,
    }
}

//! Flat elements under a smooth part of the boundary, which no move can raise, are taken off.

use super::super::odt::space::Cells;
use crate::boundary::FACES;

/// Sine of a dihedral angle below which an element is flat: 17°.
const FLAT: f64 = 0.3;

/// Takes off the elements with two or three faces on the boundary whose four corners are `on_one_patch`, if they are flat. Their other faces
/// become the boundary, which stays a manifold; a vertex that only three such faces had belongs to no element then.
pub fn peel(cells: &mut Cells, on_one_patch: impl Fn([u32; 4]) -> bool) {
    for cell in 0..cells.corners.len() as u32 {
        if !cells.is_alive(cell) || cells.shape(cell).sine > FLAT {
            continue;
        }
        let corners = cells.corners[cell as usize];
        let (outside, inside): (Vec<usize>, Vec<usize>) =
            (0..4).partition(|&side| cells.neighbour(cell, side).is_none());
        let leaves_a_manifold = match (&outside[..], &inside[..]) {
            // The faces opposite two corners meet in the edge of the others; the new boundary has the edge of the two.
            (&[a, b], _) => !is_on_boundary(cells, [corners[a], corners[b]]),
            (_, &[apex]) => cells.stars[corners[apex] as usize].len() == 1 && !cells.is_kept(corners[apex]),
            _ => false,
        };
        if leaves_a_manifold && on_one_patch(corners) {
            cells.remove(cell);
        }
    }
}

fn is_on_boundary(cells: &Cells, [a, b]: [u32; 2]) -> bool {
    cells.around([a, b]).into_iter().any(|cell| {
        (0..4).any(|side| {
            let face = FACES[side].map(|corner| cells.corners[cell as usize][corner]);
            face.contains(&a) && face.contains(&b) && cells.neighbour(cell, side).is_none()
        })
    })
}

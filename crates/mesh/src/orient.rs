//! Triangles turned alike.

use crate::connectivity::sides_by_edge;
use crate::{SurfaceMesh, area_vector};

/// Triangles that are turned alike wherever two of them share an edge, as most of them by area were in each part that is connected by
/// such edges. Edges of more than two triangles do not connect, and a Möbius strip keeps an edge at which it is turned both ways.
///
/// ```
/// use fem_mesh::{Pattern, SurfaceMesh, boundary, box_mesh, oriented, surface_quality};
///
/// let solid = box_mesh([1.0, 1.0, 1.0], 2, Pattern::Alternating)?;
/// let mut surface = SurfaceMesh::new(solid.vertices.clone(), boundary(&solid));
/// surface.elements.iter_mut().step_by(3).for_each(|triangle| triangle.swap(1, 2));
/// assert_eq!(surface_quality(&surface).is_closed(), false);
/// assert!((surface_quality(&oriented(&surface)).volume - 1.0).abs() < 1e-14);
/// # Ok::<(), fem_mesh::MeshError>(())
/// ```
pub fn oriented(surface: &SurfaceMesh) -> SurfaceMesh {
    let neighbours = neighbours(surface);
    let area = |triangle: usize| area_vector(surface.elements[triangle].map(|i| surface.vertices[i])).norm();
    let mut is_turned: Vec<Option<bool>> = vec![None; surface.elements.len()];
    for first in 0..surface.elements.len() {
        if is_turned[first].is_some() {
            continue;
        }
        is_turned[first] = Some(false);
        let (mut part, mut at) = (vec![first], 0);
        while let Some(&triangle) = part.get(at) {
            for &(other, is_against) in neighbours[triangle].iter().flatten() {
                if is_turned[other].is_none() {
                    is_turned[other] = Some(is_turned[triangle].unwrap_or(false) != is_against);
                    part.push(other);
                }
            }
            at += 1;
        }
        let kept: f64 = part.iter().map(|&i| if is_turned[i] == Some(true) { -area(i) } else { area(i) }).sum();
        if kept < 0.0 {
            part.iter().for_each(|&i| is_turned[i] = is_turned[i].map(|is_turned| !is_turned));
        }
    }
    let mut result = surface.clone();
    for (element, is_turned) in result.elements.iter_mut().zip(is_turned) {
        if is_turned == Some(true) {
            element.swap(1, 2);
        }
    }
    result
}

/// A triangle at the other side of an edge, and whether it is turned the other way.
type Neighbour = Option<(usize, bool)>;

/// The triangles that share an edge of two triangles with each.
fn neighbours(surface: &SurfaceMesh) -> Vec<[Neighbour; 3]> {
    let is_forward =
        |side: usize| surface.elements[side / 3][side % 3] < surface.elements[side / 3][(side % 3 + 1) % 3];
    let mut found = vec![[None; 3]; surface.elements.len()];
    for sides in sides_by_edge(&surface.elements).chunk_by(|a, b| a.0 == b.0) {
        if let &[(_, a), (_, b)] = sides {
            let is_against = is_forward(a) == is_forward(b);
            found[a / 3][a % 3] = Some((b / 3, is_against));
            found[b / 3][b % 3] = Some((a / 3, is_against));
        }
    }
    found
}

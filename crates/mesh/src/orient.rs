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

#[cfg(test)]
mod tests {
    use nalgebra::Vector3;

    use super::*;
    use crate::{Pattern, boundary, box_mesh, surface_quality};

    fn cube() -> SurfaceMesh {
        let mesh = box_mesh([1.0; 3], 4, Pattern::Alternating).unwrap();
        SurfaceMesh::new(mesh.vertices.clone(), boundary(&mesh))
    }

    #[test]
    fn each_part_is_turned_as_most_of_its_area_was() {
        let (mut surface, count) = (cube(), cube().vertices.len());
        // A cavity, whose triangles look inwards.
        surface.vertices.extend(cube().vertices.iter().map(|x| 0.5 * x + Vector3::repeat(0.25)));
        surface.elements.extend(cube().elements.iter().map(|&[a, b, c]| [a + count, c + count, b + count]));
        let whole = surface.clone();
        assert_eq!(oriented(&whole), whole);
        surface
            .elements
            .iter_mut()
            .enumerate()
            .filter(|(i, _)| i % 5 < 2)
            .for_each(|(_, triangle)| triangle.swap(1, 2));
        assert!(surface_quality(&surface).flipped_edges > 50);
        let found = surface_quality(&oriented(&surface));
        assert!(found.is_closed() && (found.volume - 0.875).abs() < 1e-14, "{found}");
    }

    #[test]
    fn edges_of_three_triangles_and_strips_with_a_twist_are_no_obstacle() {
        let mut surface = cube();
        let [a, b, _] = surface.elements[0];
        surface.vertices.push(Vector3::repeat(3.0));
        surface.elements.push([a, b, surface.vertices.len() - 1]);
        assert_eq!(oriented(&surface), surface);
        let strip: Vec<[usize; 3]> = (0..7).map(|i| [i % 7, (i + 1) % 7, (i + 2) % 7]).collect();
        let strip = SurfaceMesh::new((0..7).map(|i| Vector3::new(i as f64, (i * i) as f64, 0.0)).collect(), strip);
        assert_eq!(oriented(&strip).elements.len(), 7);
    }
}

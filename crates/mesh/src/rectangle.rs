//! A rectangle of squares, two triangles to a square.

use std::path::Path;

use nalgebra::Vector3;

use super::box_mesh::{MOST_ELEMENTS, whole_cells};
use super::pattern::{corners, turns};
use super::{MeshError, Pattern, Problem, SurfaceMesh};

/// The rectangle in the plane z = 0 from the origin to `size` (m), in squares of edge 1/`cells_per_unit` that are cut by `pattern`.
///
/// Node (i, j) has the index `i + (nx+1) j` and the position (i/n, j/n). Squares run with j outermost; the diagonal of each runs
/// from its corner nearest the origin, or from another one where the pattern mirrors the square.
///
/// Returns an error for sizes that are not whole numbers of cells, and for more than 50 million triangles.
pub fn rectangle_mesh(size: [f64; 2], cells_per_unit: usize, pattern: Pattern) -> Result<SurfaceMesh, MeshError> {
    let cells = count_cells(size, cells_per_unit);
    let [nx, ny] = cells.map_err(|problem| MeshError::in_file(Path::new("rectangle"), problem))?;
    let coordinate = |i: usize| i as f64 / cells_per_unit as f64;
    let nodes = (0..=ny).flat_map(|j| (0..=nx).map(move |i| Vector3::new(coordinate(i), coordinate(j), 0.0)));
    let square = |i: usize, j: usize| {
        let mirrored = pattern.mirrored([i, j]);
        let [a, b, c, d] = corners([i, j], mirrored, [1, nx + 1]);
        if turns(mirrored) { [[a, d, b], [a, c, d]] } else { [[a, b, d], [a, d, c]] }
    };
    let triangles = (0..ny).flat_map(|j| (0..nx).flat_map(move |i| square(i, j)));
    Ok(SurfaceMesh::new(nodes.collect(), triangles.collect()))
}

fn count_cells(size: [f64; 2], cells_per_unit: usize) -> Result<[usize; 2], Problem> {
    let [x, y] = whole_cells(size, cells_per_unit)?;
    // As floating-point numbers, whose product cannot overflow.
    let elements = 2.0 * x * y;
    if elements > MOST_ELEMENTS as f64 {
        let cells = format!("{x} × {y}");
        return Err(Problem::RectangleTooFine { cells, elements, most: MOST_ELEMENTS });
    }
    Ok([x as usize, y as usize])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{area_vector, check_plane};

    #[test]
    fn a_rectangle_has_two_triangles_to_a_cell_and_its_area() {
        let mesh = rectangle_mesh([2.0, 0.75], 4, Pattern::Alternating).unwrap();
        assert_eq!((mesh.vertices.len(), mesh.elements.len()), (36, 48));
        check_plane(&mesh, "rectangle".as_ref()).unwrap();
        let area: f64 = mesh.elements.iter().map(|e| area_vector(e.map(|i| mesh.vertices[i])).z).sum();
        assert!((area - 1.5).abs() < 1e-14);
    }

    #[test]
    fn the_diagonals_of_four_squares_meet_in_their_common_node_and_those_of_kuhn_s_pattern_are_parallel() {
        let elements = |pattern| rectangle_mesh([2.0, 2.0], 1, pattern).unwrap().elements;
        let kuhn = [[0, 1, 4], [0, 4, 3], [1, 2, 5], [1, 5, 4], [3, 4, 7], [3, 7, 6], [4, 5, 8], [4, 8, 7]];
        assert_eq!(elements(Pattern::Kuhn), kuhn);
        assert!(elements(Pattern::Alternating).iter().all(|triangle| triangle.contains(&4)));
    }

    #[test]
    fn sizes_that_are_no_whole_cells_and_too_many_cells_are_refused_with_their_counts() {
        let error = |size, cells| rectangle_mesh(size, cells, Pattern::Alternating).unwrap_err().to_string();
        assert!(error([1.0, 0.3], 4).contains("along y"));
        assert!(error([1e6, 1e6], 1000).contains("2e18 triangles"));
    }
}

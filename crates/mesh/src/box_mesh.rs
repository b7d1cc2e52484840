//! A box of cubes, six tetrahedra to a cube, and a rectangle of squares, two triangles to a square.

use std::path::Path;

use nalgebra::Vector3;

use super::pattern::{corners, turns};
use super::{MeshError, Pattern, Problem, SurfaceMesh, TetrahedralMesh};

/// Largest number of elements of a box or a refined mesh. The mesh alone then takes about 5 GB.
pub(super) const MOST_ELEMENTS: usize = 50_000_000;

/// Relative distance from a whole number that a size times the cells per unit may have: sizes such as 0.1 are not exact.
const WHOLE: f64 = 1e-9;

/// The permutations of the axes in lexicographic order, which give Kuhn's subdivision of the cube, and whether each is even.
const PERMUTATIONS: [([usize; 3], bool); 6] = [
    ([0, 1, 2], true),
    ([0, 2, 1], false),
    ([1, 0, 2], false),
    ([1, 2, 0], true),
    ([2, 0, 1], true),
    ([2, 1, 0], false),
];

/// The box from the origin to `size` (m), in cubes of edge 1/`cells_per_unit` that are cut by `pattern`.
///
/// Node (i, j, k) has the index `i + (nx+1)(j + (ny+1)k)` and the position (i/n, j/n, k/n). Cells run with k outermost, then
/// j, then i; each gives one tetrahedron per permutation p of the axes: a = (i, j, k), b = a + e_p0, c = b + e_p1,
/// d = c + e_p2, as `[a, b, c, d]` for even p and `[a, b, d, c]` for odd p, so that all are positive. A cell that the pattern
/// mirrors along an axis starts at its far corner there and steps back; with an odd number of such axes the last two nodes change
/// places.
///
/// Returns an error for sizes that are not whole numbers of cells, and for more than 50 million elements.
pub fn box_mesh(size: [f64; 3], cells_per_unit: usize, pattern: Pattern) -> Result<TetrahedralMesh, MeshError> {
    let cells = count_cells(size, cells_per_unit, ["box", "elements"], 6.0)?;
    Ok(TetrahedralMesh::new(nodes(cells, cells_per_unit), tetrahedra(cells, pattern)))
}

/// The rectangle in the plane z = 0 from the origin to `size` (m), in squares of edge 1/`cells_per_unit` that are cut by `pattern`.
///
/// Node (i, j) has the index `i + (nx+1) j` and the position (i/n, j/n). Squares run with j outermost; the diagonal of each runs
/// from its corner nearest the origin, or from another one where the pattern mirrors the square.
///
/// Returns an error for sizes that are not whole numbers of cells, and for more than 50 million triangles.
pub fn rectangle_mesh(size: [f64; 2], cells_per_unit: usize, pattern: Pattern) -> Result<SurfaceMesh, MeshError> {
    let [nx, ny] = count_cells(size, cells_per_unit, ["rectangle", "triangles"], 2.0)?;
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

/// Numbers of cells along the axes, which have to be whole, each of so many elements. The words are the names of the whole and of its elements.
fn count_cells<const D: usize>(
    size: [f64; D],
    cells_per_unit: usize,
    [whole, elements]: [&'static str; 2],
    of_cell: f64,
) -> Result<[usize; D], MeshError> {
    let refused = |problem| Err(MeshError::in_file(Path::new(whole), problem));
    let exact = size.map(|length| length * cells_per_unit as f64);
    let cells = exact.map(f64::round);
    for axis in 0..D {
        // NaN and ∞ fail both
        let fits = cells[axis] >= 1.0 && (exact[axis] - cells[axis]).abs() <= WHOLE * cells[axis];
        if !fits {
            return refused(Problem::BoxCells { axis: ['x', 'y', 'z'][axis], size: size[axis], cells_per_unit });
        }
    }
    // As floating-point numbers, whose product cannot overflow.
    let count = cells.iter().fold(of_cell, |count, cells| count * cells);
    if count > MOST_ELEMENTS as f64 {
        let cells = cells.map(|cells| cells.to_string()).join(" × ");
        return refused(Problem::GridTooFine { whole, cells, count, elements, most: MOST_ELEMENTS });
    }
    Ok(cells.map(|cells| cells as usize))
}

fn nodes([nx, ny, nz]: [usize; 3], n: usize) -> Vec<Vector3<f64>> {
    let coordinate = |i: usize| i as f64 / n as f64;
    let mut nodes = Vec::with_capacity((nx + 1) * (ny + 1) * (nz + 1));
    for k in 0..=nz {
        for j in 0..=ny {
            nodes.extend((0..=nx).map(|i| Vector3::new(coordinate(i), coordinate(j), coordinate(k))));
        }
    }
    nodes
}

fn tetrahedra([nx, ny, nz]: [usize; 3], pattern: Pattern) -> Vec<[usize; 4]> {
    let strides = [1, nx + 1, (nx + 1) * (ny + 1)];
    let mut tetrahedra = Vec::with_capacity(6 * nx * ny * nz);
    for k in 0..nz {
        for j in 0..ny {
            for i in 0..nx {
                let mirrored = pattern.mirrored([i, j, k]);
                let corners: [usize; 8] = corners([i, j, k], mirrored, strides);
                let turned = turns(mirrored);
                tetrahedra.extend(PERMUTATIONS.map(|(axes, even)| tetrahedron(&corners, axes, even != turned)));
            }
        }
    }
    tetrahedra
}

/// The tetrahedron from the cube's corner 0 to corner 7 along its edges, one axis after the other.
fn tetrahedron(corners: &[usize; 8], axes: [usize; 3], even: bool) -> [usize; 4] {
    let [a, b, d] = [0, 1 << axes[0], 7].map(|corner| corners[corner]);
    let c = corners[1 << axes[0] | 1 << axes[1]];
    if even { [a, b, c, d] } else { [a, b, d, c] }
}

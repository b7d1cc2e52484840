//! A box of cubes, six tetrahedra to a cube.

use std::path::Path;

use nalgebra::Vector3;

use super::pattern::{corners, turns};
use super::{MeshError, Pattern, Problem, TetrahedralMesh};

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
    let cells = count_cells(size, cells_per_unit).map_err(|problem| MeshError::in_file(Path::new("box"), problem))?;
    Ok(TetrahedralMesh::new(nodes(cells, cells_per_unit), tetrahedra(cells, pattern)))
}

/// Numbers of cells along the axes, which have to be whole.
pub(super) fn whole_cells<const D: usize>(size: [f64; D], cells_per_unit: usize) -> Result<[f64; D], Problem> {
    let exact = size.map(|length| length * cells_per_unit as f64);
    for axis in 0..D {
        let whole = exact[axis].round();
        // NaN and ∞ fail both
        let fits = whole >= 1.0 && (exact[axis] - whole).abs() <= WHOLE * whole;
        if !fits {
            return Err(Problem::BoxCells { axis: ['x', 'y', 'z'][axis], size: size[axis], cells_per_unit });
        }
    }
    Ok(exact.map(f64::round))
}

fn count_cells(size: [f64; 3], cells_per_unit: usize) -> Result<[usize; 3], Problem> {
    let [x, y, z] = whole_cells(size, cells_per_unit)?;
    // As floating-point numbers, whose product cannot overflow.
    let elements = 6.0 * x * y * z;
    if elements > MOST_ELEMENTS as f64 {
        let cells = format!("{x} × {y} × {z}");
        return Err(Problem::BoxTooFine { cells, elements, most: MOST_ELEMENTS });
    }
    Ok([x as usize, y as usize, z as usize])
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

//! VTK's cell types, in old and new files. Source: VTK file formats, «Cell types».

use super::content::Content;
use crate::Problem;

const TRIANGLE: i64 = 5;
const POLYGON: i64 = 7;
const QUADRANGLE: i64 = 9;
const TETRAHEDRON: i64 = 10;

/// Points and lines, linear and curved, which are skipped.
const CURVES: [i64; 5] = [1, 2, 3, 4, 21];

/// Surface cells that are skipped beside tetrahedra and refused in a surface, by name.
const SURFACES: [(i64, &str); 4] =
    [(6, "strips of triangles"), (8, "pixels"), (22, "triangles with 6 nodes"), (23, "quadrangles with 8 nodes")];

/// Volume cells that are refused, by name.
const VOLUMES: [(i64, &str); 14] = [
    (11, "voxel"),
    (12, "hexahedron"),
    (13, "wedge"),
    (14, "pyramid"),
    (24, "tetrahedron with 10 nodes"),
    (25, "hexahedron with 20 nodes"),
    (26, "wedge with 15 nodes"),
    (27, "pyramid with 13 nodes"),
    (29, "hexahedron with 27 nodes"),
    (42, "polyhedron"),
    (71, "tetrahedron of higher order"),
    (72, "hexahedron of higher order"),
    (78, "tetrahedron of higher order"),
    (79, "hexahedron of higher order"),
];

/// Number of tetrahedra among the types of cells.
pub(super) fn tetrahedra(kinds: &[i64]) -> usize {
    kinds.iter().filter(|&&kind| kind == TETRAHEDRON).count()
}

/// Adds a cell to those found; a polygon becomes a fan of triangles. `cell` is its number, counted from 0, and its corners are
/// points of the last `points` vertices.
pub(super) fn add(
    content: &mut Content,
    cell: usize,
    kind: i64,
    corners: &[i64],
    points: usize,
) -> Result<(), Problem> {
    let first = content.vertices.len() - points;
    let index = |corner: i64| {
        let index = usize::try_from(corner).ok().filter(|&index| index < points);
        let problem = Problem::ElementOutOfRange { element: cell, vertex: corner.into(), count: points };
        index.map(|index| first + index).ok_or(problem)
    };
    match (kind, corners) {
        (TETRAHEDRON, &[a, b, c, d]) => {
            content.tetrahedra.push([index(a)?, index(b)?, index(c)?, index(d)?]);
            // Triangles before the first tetrahedron were those of its surface.
            content.triangles = Vec::new();
        }
        (TRIANGLE, [_, _, _]) | (QUADRANGLE, [_, _, _, _]) | (POLYGON, [_, _, _, ..]) => {
            for pair in corners[1..].windows(2) {
                content.add_triangle([index(corners[0])?, index(pair[0])?, index(pair[1])?]);
            }
        }
        _ if CURVES.contains(&kind) => {}
        _ => match SURFACES.iter().find(|(number, _)| *number == kind) {
            Some((_, name)) => content.skipped = Some(format!("a surface of {name} (VTK's cell type {kind})")),
            None => return Err(unsupported(cell, kind, corners.len())),
        },
    }
    Ok(())
}

fn unsupported(cell: usize, kind: i64, corners: usize) -> Problem {
    let found = match VOLUMES.iter().find(|(number, _)| *number == kind) {
        Some((_, name)) => format!("cell {cell} of VTK's type {kind} ({name})"),
        None => format!("cell {cell} of VTK's type {kind} with {corners} nodes"),
    };
    Problem::Unsupported { found, instead: "split such cells first (ParaView's filter Tetrahedralize does)" }
}

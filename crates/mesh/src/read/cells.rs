//! VTK's cell types, in old and new files. Source: VTK file formats, «Cell types».

use crate::Problem;

const TETRAHEDRON: i64 = 10;

/// Points, lines and polygons, linear and curved: cells without volume, which are skipped.
const SURFACE_CELLS: [i64; 12] = [1, 2, 3, 4, 5, 6, 7, 8, 9, 21, 22, 23];

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

/// A tetrahedron among `points` points; `None` for a cell without volume. `cell` is its number, counted from 0.
pub(super) fn tetrahedron(
    cell: usize,
    kind: i64,
    corners: &[i64],
    points: usize,
) -> Result<Option<[usize; 4]>, Problem> {
    if SURFACE_CELLS.contains(&kind) {
        return Ok(None);
    }
    let &[a, b, c, d] = corners else { return Err(unsupported(cell, kind)) };
    if kind != TETRAHEDRON {
        return Err(unsupported(cell, kind));
    }
    let index = |corner: i64| {
        let index = usize::try_from(corner).ok().filter(|&index| index < points);
        index.ok_or(Problem::ElementOutOfRange { element: cell, vertex: corner.into(), count: points })
    };
    Ok(Some([index(a)?, index(b)?, index(c)?, index(d)?]))
}

fn unsupported(cell: usize, kind: i64) -> Problem {
    let name =
        VOLUMES.iter().find(|(number, _)| *number == kind).map_or("no tetrahedron with 4 nodes", |(_, name)| name);
    let found = format!("cell {cell} of VTK's type {kind} ({name})");
    Problem::Unsupported { found, instead: "split such cells first (ParaView's filter Tetrahedralize does)" }
}

//! Gmsh's element types. Source: Gmsh reference manual, «Low-order elements» and «High-order elements».

use crate::Problem;

const SPLIT: &str = "mesh the volumes with tetrahedra of first order (`gmsh -3 -order 1`)";

/// Dimension, number of nodes, and name of an element type.
#[derive(Clone, Copy, Debug)]
pub(super) struct Kind {
    pub number: i64,
    pub dimension: usize,
    pub nodes: usize,
    pub name: &'static str,
}

/// The tetrahedron with 4 nodes.
pub(super) const TETRAHEDRON: i64 = 4;
/// The triangle with 3 nodes.
pub(super) const TRIANGLE: i64 = 2;
/// The line with 2 nodes.
pub(super) const LINE: i64 = 1;
/// The same shapes with nodes at the middles of their edges.
pub(super) const QUADRATIC_LINE: i64 = 8;
pub(super) const QUADRATIC_TRIANGLE: i64 = 9;
pub(super) const QUADRATIC_TETRAHEDRON: i64 = 11;
/// The point.
pub(super) const POINT: i64 = 15;

/// Number, dimension, nodes, plural name.
const KINDS: [(i64, usize, usize, &str); 33] = [
    (LINE, 1, 2, "lines"),
    (TRIANGLE, 2, 3, "triangles"),
    (3, 2, 4, "quadrangles"),
    (TETRAHEDRON, 3, 4, "tetrahedra"),
    (5, 3, 8, "hexahedra"),
    (6, 3, 6, "prisms"),
    (7, 3, 5, "pyramids"),
    (QUADRATIC_LINE, 1, 3, "lines with 3 nodes"),
    (QUADRATIC_TRIANGLE, 2, 6, "triangles with 6 nodes"),
    (10, 2, 9, "quadrangles with 9 nodes"),
    (QUADRATIC_TETRAHEDRON, 3, 10, "tetrahedra with 10 nodes"),
    (12, 3, 27, "hexahedra with 27 nodes"),
    (13, 3, 18, "prisms with 18 nodes"),
    (14, 3, 14, "pyramids with 14 nodes"),
    (POINT, 0, 1, "points"),
    (16, 2, 8, "quadrangles with 8 nodes"),
    (17, 3, 20, "hexahedra with 20 nodes"),
    (18, 3, 15, "prisms with 15 nodes"),
    (19, 3, 13, "pyramids with 13 nodes"),
    (20, 2, 9, "triangles with 9 nodes"),
    (21, 2, 10, "triangles with 10 nodes"),
    (22, 2, 12, "triangles with 12 nodes"),
    (23, 2, 15, "triangles with 15 nodes"),
    (24, 2, 15, "triangles with 15 nodes"),
    (25, 2, 21, "triangles with 21 nodes"),
    (26, 1, 4, "lines with 4 nodes"),
    (27, 1, 5, "lines with 5 nodes"),
    (28, 1, 6, "lines with 6 nodes"),
    (29, 3, 20, "tetrahedra with 20 nodes"),
    (30, 3, 35, "tetrahedra with 35 nodes"),
    (31, 3, 56, "tetrahedra with 56 nodes"),
    (92, 3, 64, "hexahedra with 64 nodes"),
    (93, 3, 125, "hexahedra with 125 nodes"),
];

/// The element type of a number. Refuses unknown types and volumes other than tetrahedra with 4 or 10 nodes: skipped, they would leave
/// holes in the body.
pub(super) fn kind(number: i64) -> Result<Kind, Problem> {
    let unsupported = |found: String| Problem::Unsupported { found, instead: SPLIT };
    let Some(&(_, dimension, nodes, name)) = KINDS.iter().find(|kind| kind.0 == number) else {
        return Err(unsupported(format!("Gmsh's element type {number}")));
    };
    if dimension == 3 && ![TETRAHEDRON, QUADRATIC_TETRAHEDRON].contains(&number) {
        return Err(unsupported(format!("a mesh of {name} (Gmsh's element type {number})")));
    }
    Ok(Kind { number, dimension, nodes, name })
}

//! Types of elements.

use crate::Problem;

const SPLIT: &str =
    "mesh the volumes with tetrahedra (C3D4) and surfaces with triangles (CPS3, S3), or convert the file with Gmsh";

/// Nodes of an element type, of which the first are its corners.
#[derive(Clone, Copy)]
pub(super) struct Kind {
    pub shape: Shape,
    pub nodes: usize,
}

#[derive(Clone, Copy)]
pub(super) enum Shape {
    Tetrahedron,
    Triangle,
    Quadrangle,
    Line,
}

impl Kind {
    pub(super) fn corners(self) -> usize {
        match self.shape {
            Shape::Tetrahedron | Shape::Quadrangle => 4,
            Shape::Triangle => 3,
            Shape::Line => 2,
        }
    }
}

/// Beginnings of the names of triangles and quadrangles: in plane stress and plane strain, shells, membranes, rotational symmetry.
const SURFACES: [&str; 7] = ["CPS", "CPE", "STRI", "S", "M3D", "CAX", "DS"];

/// Beginnings of the names of elements that fill no space.
const WITHOUT_SPACE: [&str; 7] = ["SPRING", "DASHPOT", "MASS", "GAP", "CONN", "DCOUP", "ROTARYI"];

/// The type of a name, such as `C3D4` or `CPE6H`; `None` for elements that fill no space and are skipped.
pub(super) fn kind(name: &str) -> Result<Option<Kind>, Problem> {
    let name = name.to_uppercase();
    if WITHOUT_SPACE.iter().any(|start| name.starts_with(start)) {
        return Ok(None);
    }
    let of = |shape, nodes| Ok(Some(Kind { shape, nodes }));
    let begins = |list: &[&str], nodes: &str| {
        list.iter().any(|start| {
            name.strip_prefix(start).is_some_and(|rest| rest.trim_end_matches(char::is_alphabetic) == nodes)
        })
    };
    match &name[..] {
        _ if begins(&["C3D", "DC3D"], "4") => of(Shape::Tetrahedron, 4),
        _ if begins(&["C3D", "DC3D"], "10") => of(Shape::Tetrahedron, 10),
        _ if begins(&SURFACES, "3") || name == "STRI3" => of(Shape::Triangle, 3),
        _ if begins(&SURFACES, "6") || name == "STRI65" => of(Shape::Triangle, 6),
        _ if begins(&SURFACES, "4") => of(Shape::Quadrangle, 4),
        _ if begins(&SURFACES, "8") => of(Shape::Quadrangle, 8),
        "T3D2" | "B31" | "B21" | "T2D2" | "R2D2" => of(Shape::Line, 2),
        "T3D3" | "B32" | "T2D3" | "B22" => of(Shape::Line, 3),
        _ => Err(Problem::Unsupported { found: format!("the element type {name}"), instead: SPLIT }),
    }
}

/// Corners of the sides of a tetrahedron, S1 to S4.
pub(crate) const FACES: [[usize; 3]; 4] = [[0, 1, 2], [0, 3, 1], [1, 3, 2], [2, 3, 0]];

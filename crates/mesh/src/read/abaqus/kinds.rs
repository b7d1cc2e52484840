//! Types of elements.

use crate::Problem;

const SPLIT: &str = "mesh the volumes with tetrahedra (C3D4), or convert the file with Gmsh";

/// Nodes of an element type, of which the first are its corners: four of a tetrahedron, three of a triangle, two of a line.
#[derive(Clone, Copy)]
pub(super) struct Kind {
    pub nodes: usize,
    pub corners: usize,
}

/// Beginnings of the names of triangles: in plane stress and plane strain, shells, membranes, rotational symmetry.
const TRIANGLES: [&str; 7] = ["CPS", "CPE", "STRI", "S", "M3D", "CAX", "DS"];

/// Beginnings of the names of elements that fill no space.
const WITHOUT_SPACE: [&str; 7] = ["SPRING", "DASHPOT", "MASS", "GAP", "CONN", "DCOUP", "ROTARYI"];

/// The type of a name, such as `C3D4` or `CPE6H`; `None` for elements that fill no space and are skipped.
pub(super) fn kind(name: &str) -> Result<Option<Kind>, Problem> {
    let name = name.to_uppercase();
    if WITHOUT_SPACE.iter().any(|start| name.starts_with(start)) {
        return Ok(None);
    }
    let of = |nodes, corners| Ok(Some(Kind { nodes, corners }));
    let begins = |list: &[&str], nodes: &str| {
        list.iter().any(|start| {
            name.strip_prefix(start).is_some_and(|rest| rest.trim_end_matches(char::is_alphabetic) == nodes)
        })
    };
    match &name[..] {
        _ if begins(&["C3D", "DC3D"], "4") => of(4, 4),
        _ if begins(&["C3D", "DC3D"], "10") => of(10, 4),
        _ if begins(&TRIANGLES, "3") || name == "STRI3" => of(3, 3),
        _ if begins(&TRIANGLES, "6") || name == "STRI65" => of(6, 3),
        "T3D2" | "B31" | "B21" | "T2D2" | "R2D2" => of(2, 2),
        "T3D3" | "B32" | "T2D3" | "B22" => of(3, 2),
        _ => Err(Problem::Unsupported { found: format!("the element type {name}"), instead: SPLIT }),
    }
}

/// Corners of the sides of a tetrahedron, S1 to S4.
pub(crate) const FACES: [[usize; 3]; 4] = [[0, 1, 2], [0, 3, 1], [1, 3, 2], [2, 3, 0]];

//! VTK's cell types, in old and new files. Source: VTK file formats, «Cell types».

use std::collections::BTreeMap;

use super::content::{Content, EDGES, Entry, MOST_TAGS, Parts};
use crate::Problem;

const POINT: i64 = 1;
const LINE: i64 = 3;
const TRIANGLE: i64 = 5;
pub(super) const STRIP: i64 = 6;
pub(super) const POLYGON: i64 = 7;
const QUADRANGLE: i64 = 9;
const TETRAHEDRON: i64 = 10;
const QUADRATIC_LINE: i64 = 21;
const QUADRATIC_TRIANGLE: i64 = 22;
const QUADRATIC_TETRAHEDRON: i64 = 24;

/// Points and lines, linear and curved, which make at most sets.
const CURVES: [i64; 5] = [1, 2, 3, 4, QUADRATIC_LINE];

/// Surface cells that are skipped beside tetrahedra and refused in a surface, by name.
const SURFACES: [(i64, &str); 3] =
    [(8, "pixels"), (QUADRATIC_TRIANGLE, "triangles with 6 nodes"), (23, "quadrangles with 8 nodes")];

/// Volume cells that are refused, by name.
const VOLUMES: [(i64, &str); 14] = [
    (11, "voxel"),
    (12, "hexahedron"),
    (13, "wedge"),
    (14, "pyramid"),
    (QUADRATIC_TETRAHEDRON, "tetrahedron with 10 nodes"),
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

/// Fields of integers that programs use for parts of a mesh, the most exact first; 0 stands for no part.
const TAGS: [&str; 4] = ["gmsh:physical", "medit:ref", "tetgen:ref", "CellEntityIds"];

/// The beginning of the name of a field that is 1 in the cells of a set, or at its points.
pub(crate) const SET: &str = "set:";

/// Integers of the cells of a piece.
pub(super) struct Field {
    pub name: String,
    pub values: Vec<i64>,
}

/// The cells of a file or piece: the ends of their corners in `connectivity`, and their types.
pub(super) struct Cells<'a> {
    pub ends: &'a [i64],
    pub connectivity: &'a [i64],
    pub kinds: &'a [i64],
}

/// Adds cells to those found, whose corners are points of the last `points` vertices; polygons become fans of triangles. Fields of
/// integers make sets.
pub(super) fn add_all(content: &mut Content, cells: &Cells, points: usize, fields: Vec<Field>) -> Result<(), Problem> {
    let Cells { ends, connectivity, kinds } = cells;
    if ends.len() != kinds.len() {
        return Err(Problem::WrongCount { what: "cells", announced: kinds.len(), found: ends.len() });
    }
    content.tetrahedra.reserve_exact(kinds.iter().filter(|&&kind| kind == TETRAHEDRON).count());
    let mut parts: Vec<BTreeMap<i64, Parts>> = fields.iter().map(|_| BTreeMap::new()).collect();
    let mut start = 0;
    for (cell, (&kind, &end)) in kinds.iter().zip(*ends).enumerate() {
        let corners = usize::try_from(end).ok().and_then(|end| connectivity.get(start..end)).ok_or_else(|| {
            let reason = format!("cell {cell} ends at {end} in a connectivity of {} numbers", connectivity.len());
            Problem::Malformed { reason }
        })?;
        start += corners.len();
        let entry = add(content, cell, kind, corners, points)?;
        for (field, parts) in fields.iter().zip(&mut parts).filter(|(_, parts)| parts.len() <= MOST_TAGS) {
            parts.entry(field.values[cell]).or_default().push(entry);
        }
    }
    if start != connectivity.len() {
        let reason = format!("the last cell ends at {start} in a connectivity of {} numbers", connectivity.len());
        return Err(Problem::Malformed { reason });
    }
    name(content, fields, parts);
    Ok(())
}

/// Makes sets of points from the fields of the last `points` vertices that this library writes. Others are named as not read.
pub(super) fn add_points(content: &mut Content, points: usize, fields: Vec<Field>) {
    let first = content.vertices.len() - points;
    for Field { name, values } in fields {
        match name.strip_prefix(SET) {
            Some(name) => {
                let points = values.iter().enumerate().filter(|(_, value)| **value != 0).map(|(i, _)| first + i);
                content.groups.entry(name.to_owned()).or_default().points.extend(points);
            }
            None => content.notes.unread(format!("the field `{name}`")),
        }
    }
}

/// Makes named parts of the values of fields: those of one field by their number, of further ones with the name of the field before it.
fn name(content: &mut Content, fields: Vec<Field>, parts: Vec<BTreeMap<i64, Parts>>) {
    let names: Vec<&str> = fields.iter().map(|field| &field.name[..]).filter(|name| !name.starts_with(SET)).collect();
    let main =
        TAGS.iter().copied().find(|name| names.contains(name)).or(names.first().copied().filter(|_| names.len() == 1));
    let main = main.map(str::to_owned);
    for (field, parts) in fields.into_iter().zip(parts) {
        let is_tag = TAGS.contains(&&field.name[..]);
        let is_constant = parts.len() == 1 && parts.contains_key(&0);
        if parts.len() > MOST_TAGS {
            content.notes.unread(format!("the field `{}` of over {MOST_TAGS} different integers", field.name));
            continue;
        }
        for (value, parts) in parts {
            let name = match field.name.strip_prefix(SET) {
                Some(name) if value != 0 => name.to_owned(),
                Some(_) => continue,
                None if value == 0 && (is_tag || is_constant) => continue,
                None if main.as_ref() == Some(&field.name) => value.to_string(),
                None => format!("{} {value}", field.name),
            };
            content.groups.entry(name).or_default().extend(parts);
        }
    }
}

fn add(content: &mut Content, cell: usize, kind: i64, corners: &[i64], points: usize) -> Result<Entry, Problem> {
    let first = content.vertices.len() - points;
    let index = |corner: i64| {
        let index = usize::try_from(corner).ok().filter(|&index| index < points);
        let problem = Problem::ElementOutOfRange { element: cell, vertex: corner.into(), count: points };
        index.map(|index| first + index).ok_or(problem)
    };
    Ok(match (kind, corners) {
        (TETRAHEDRON, &[a, b, c, d]) => content.tetrahedron([index(a)?, index(b)?, index(c)?, index(d)?]),
        (TRIANGLE, [_, _, _]) | (QUADRANGLE, [_, _, _, _]) | (POLYGON, [_, _, _, ..]) => {
            content.polygon(&corners.iter().map(|&corner| index(corner)).collect::<Result<Vec<_>, _>>()?)
        }
        (QUADRATIC_TETRAHEDRON, [_, _, _, _, _, _, _, _, _, _]) => {
            let nodes = corners.iter().map(|&node| index(node)).collect::<Result<Vec<_>, _>>()?;
            content.add_middles(&nodes, &EDGES, nodes[4..].iter().copied());
            content.tetrahedron([nodes[0], nodes[1], nodes[2], nodes[3]])
        }
        (QUADRATIC_TRIANGLE, [_, _, _, _, _, _]) => {
            let nodes = corners.iter().map(|&node| index(node)).collect::<Result<Vec<_>, _>>()?;
            content.add_middles_of_polygon(&nodes[..3], nodes[3..].iter().copied());
            content.polygon(&nodes[..3])
        }
        (QUADRATIC_LINE, &[a, b, _]) => Entry::edge([index(a)?, index(b)?]),
        (STRIP, [_, _, _, ..]) => {
            let first = content.triangles.len() as u32;
            for (i, corners) in corners.windows(3).enumerate() {
                // Every second triangle of a strip is turned.
                let [a, b] = if i % 2 == 0 { [0, 1] } else { [1, 0] };
                content.triangles.push([index(corners[a])?, index(corners[b])?, index(corners[2])?]);
            }
            Entry::Triangles(first, content.triangles.len() as u32 - first)
        }
        (POLYGON | STRIP, _) => {
            content.short_faces += 1;
            Entry::Nothing
        }
        (POINT, &[a]) => Entry::Point(index(a)? as u32),
        (LINE, &[a, b]) => Entry::edge([index(a)?, index(b)?]),
        _ if CURVES.contains(&kind) => Entry::Nothing,
        _ => match SURFACES.iter().find(|(number, _)| *number == kind) {
            Some((_, name)) => {
                content.skipped = Some(format!("a surface of {name} (VTK's cell type {kind})"));
                Entry::Nothing
            }
            None => return Err(unsupported(cell, kind, corners.len())),
        },
    })
}

fn unsupported(cell: usize, kind: i64, corners: usize) -> Problem {
    let found = match VOLUMES.iter().find(|(number, _)| *number == kind) {
        Some((_, name)) => format!("cell {cell} of VTK's type {kind} ({name})"),
        None => format!("cell {cell} of VTK's type {kind} with {corners} nodes"),
    };
    Problem::Unsupported { found, instead: "split such cells first (ParaView's filter Tetrahedralize does)" }
}

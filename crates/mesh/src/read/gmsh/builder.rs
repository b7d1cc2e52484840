//! A mesh of tetrahedra or triangles and its named sets, from the nodes, elements and physical groups of a Gmsh file.

use std::collections::HashMap;

use nalgebra::Vector3;

use super::super::content::{Content, Entry, GMSH_EDGES, Parts};
use super::kinds::{
    Kind, LINE, POINT, QUADRATIC_LINE, QUADRATIC_TETRAHEDRON, QUADRATIC_TRIANGLE, TETRAHEDRON, TRIANGLE,
};
use crate::Problem;

const FIRST_ORDER: &str = "mesh with triangles and tetrahedra of first order, or leave them out of the physical group";

/// Dimension and number of a physical group.
pub(super) type Group = (usize, i64);

#[derive(Default)]
pub(super) struct Builder {
    pub content: Content,
    index: Index,
    names: HashMap<Group, String>,
    groups: HashMap<Group, Parts>,
}

impl Builder {
    /// Names a physical group.
    pub(super) fn name(&mut self, group: Group, name: &str) {
        self.names.insert(group, name.to_owned());
    }

    /// Adds a tag for the node whose position comes next but `ahead`.
    pub(super) fn add_tag(&mut self, tag: i64, ahead: usize) -> Result<(), Problem> {
        let is_new = self.index.insert(tag, self.content.vertices.len() + ahead);
        if is_new { Ok(()) } else { Err(Problem::RepeatedTag { tag }) }
    }

    /// Adds the position of a node, m.
    pub(super) fn add_place(&mut self, place: Vector3<f64>) {
        self.content.vertices.push(place);
    }

    /// Number of nodes so far.
    pub(super) fn nodes(&self) -> usize {
        self.content.vertices.len()
    }

    /// Adds an entry to a physical group.
    pub(super) fn add_to_group(&mut self, entry: Entry, group: Group) {
        self.groups.entry(group).or_default().push(entry);
    }

    /// Adds an element to its physical groups; a tetrahedron or a triangle to the mesh too.
    pub(super) fn add_element(&mut self, kind: Kind, tags: &[i64], groups: &[Group]) -> Result<Entry, Problem> {
        let of_mesh = [TETRAHEDRON, TRIANGLE, QUADRATIC_TETRAHEDRON, QUADRATIC_TRIANGLE];
        if !of_mesh.contains(&kind.number) && groups.is_empty() {
            if kind.dimension == 2 {
                self.content.skipped =
                    Some(format!("a surface of {} (Gmsh's element type {})", kind.name, kind.number));
            }
            return Ok(Entry::Nothing);
        }
        let node = |&tag: &i64| self.index.get(tag).ok_or(Problem::UnknownTag { tag });
        let nodes = tags.iter().map(node).collect::<Result<Vec<_>, _>>()?;
        let entry = match (kind.number, &nodes[..]) {
            (TETRAHEDRON, &[a, b, c, d]) => self.content.tetrahedron([a, b, c, d]),
            (TRIANGLE, nodes) => self.content.polygon(nodes),
            (QUADRATIC_TETRAHEDRON, &[a, b, c, d, ..]) => {
                self.content.add_middles(&nodes, &GMSH_EDGES, nodes[4..].iter().copied());
                self.content.tetrahedron([a, b, c, d])
            }
            (QUADRATIC_TRIANGLE, nodes) => {
                self.content.add_middles_of_polygon(&nodes[..3], nodes[3..].iter().copied());
                self.content.polygon(&nodes[..3])
            }
            (LINE, &[a, b]) | (QUADRATIC_LINE, &[a, b, _]) => Entry::edge([a, b]),
            (POINT, &[a]) => Entry::Point(a as u32),
            _ => {
                let found = format!("a physical group of {} (Gmsh's element type {})", kind.name, kind.number);
                return Err(Problem::Unsupported { found, instead: FIRST_ORDER });
            }
        };
        groups.iter().for_each(|&group| self.add_to_group(entry, group));
        Ok(entry)
    }

    /// The mesh. A group has its name, or its number if it has none.
    pub(super) fn finish(self) -> Content {
        let mut content = self.content;
        for (group, parts) in self.groups {
            let name = self.names.get(&group).cloned().unwrap_or_else(|| group.1.to_string());
            content.groups.entry(name).or_default().extend(parts);
        }
        content
    }
}

/// No node has this index: a mesh with 2³² nodes fits into no memory.
const NONE: u32 = u32::MAX;

/// The indices of nodes by their tags, any integers: a table for small tags, as most files have them, which is several times as fast as a map, and a map for others.
#[derive(Default)]
struct Index {
    table: Vec<u32>,
    map: HashMap<i64, u32>,
    count: usize,
}

impl Index {
    /// Adds a tag. Returns false if it is known.
    fn insert(&mut self, tag: i64, index: usize) -> bool {
        if self.get(tag).is_some() {
            return false;
        }
        self.count += 1;
        // Never larger than a few times the nodes so far.
        match usize::try_from(tag).ok().filter(|tag| *tag < 4 * self.count + 1024) {
            Some(tag) => {
                if self.table.len() <= tag {
                    self.table.resize(tag + 1, NONE);
                }
                self.table[tag] = index as u32;
            }
            None => drop(self.map.insert(tag, index as u32)),
        }
        true
    }

    fn get(&self, tag: i64) -> Option<usize> {
        let in_table = usize::try_from(tag).ok().and_then(|tag| self.table.get(tag)).filter(|index| **index != NONE);
        in_table.or_else(|| self.map.get(&tag)).map(|index| *index as usize)
    }
}

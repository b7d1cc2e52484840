//! A mesh of tetrahedra or triangles and its named sets, from the nodes, elements and physical groups of a Gmsh file.

use std::collections::HashMap;

use nalgebra::Vector3;

use super::super::content::{Content, Parts};
use super::index::Index;
use super::kinds::{Kind, LINE, POINT, TETRAHEDRON, TRIANGLE};
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

    /// Number of elements of this kind so far.
    pub(super) fn elements(&self, kind: Kind) -> usize {
        if kind.number == TETRAHEDRON { self.content.tetrahedra.len() } else { self.content.triangles.len() }
    }

    /// Adds a tetrahedron or a triangle of the mesh to another physical group.
    pub(super) fn add_to_group(&mut self, kind: Kind, element: usize, group: Group) {
        let parts = self.groups.entry(group).or_default();
        let list = if kind.number == TETRAHEDRON { &mut parts.tetrahedra } else { &mut parts.triangles };
        list.push(element);
    }

    /// Adds an element to its physical groups; a tetrahedron or a triangle to the mesh too.
    pub(super) fn add_element(&mut self, kind: Kind, tags: &[i64], groups: &[Group]) -> Result<(), Problem> {
        if ![TETRAHEDRON, TRIANGLE].contains(&kind.number) && groups.is_empty() {
            if kind.dimension == 2 {
                self.content.skipped =
                    Some(format!("a surface of {} (Gmsh's element type {})", kind.name, kind.number));
            }
            return Ok(());
        }
        let node = |&tag: &i64| self.index.get(tag).ok_or(Problem::UnknownTag { tag });
        let nodes = tags.iter().map(node).collect::<Result<Vec<_>, _>>()?;
        let element = self.elements(kind);
        let sets = groups.iter().copied();
        match (kind.number, &nodes[..]) {
            (TETRAHEDRON, &[a, b, c, d]) => {
                self.content.tetrahedra.push([a, b, c, d]);
                sets.for_each(|group| self.add_to_group(kind, element, group));
            }
            (TRIANGLE, &[a, b, c]) => {
                self.content.triangles.push([a, b, c]);
                sets.for_each(|group| self.add_to_group(kind, element, group));
            }
            (LINE, &[a, b]) => sets.for_each(|group| self.groups.entry(group).or_default().edges.push([a, b])),
            (POINT, &[a]) => sets.for_each(|group| self.groups.entry(group).or_default().points.push(a)),
            _ => {
                let found = format!("a physical group of {} (Gmsh's element type {})", kind.name, kind.number);
                return Err(Problem::Unsupported { found, instead: FIRST_ORDER });
            }
        }
        Ok(())
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

//! A mesh and its named sets, from the nodes, elements and physical groups of a Gmsh file.

use std::collections::{BTreeMap, HashMap};

use nalgebra::Vector3;

use super::kinds::{Kind, LINE, POINT, TETRAHEDRON, TRIANGLE};
use crate::{MeshSet, Problem, TetrahedralMesh};

const FIRST_ORDER: &str = "mesh with triangles and tetrahedra of first order, or leave them out of the physical group";

/// Dimension and number of a physical group.
pub(super) type Group = (usize, i64);

#[derive(Default)]
pub(super) struct Builder {
    places: Vec<Vector3<f64>>,
    /// From a node's tag, any integer, to its index in `places`.
    index: HashMap<i64, usize>,
    elements: Vec<[usize; 4]>,
    names: HashMap<Group, String>,
    sets: HashMap<Group, MeshSet>,
}

impl Builder {
    /// Names a physical group.
    pub(super) fn name(&mut self, group: Group, name: &str) {
        self.names.insert(group, name.to_owned());
    }

    /// Adds a tag for the node whose position comes next but `ahead`.
    pub(super) fn add_tag(&mut self, tag: i64, ahead: usize) -> Result<(), Problem> {
        match self.index.insert(tag, self.places.len() + ahead) {
            None => Ok(()),
            Some(_) => Err(Problem::RepeatedTag { tag }),
        }
    }

    /// Adds the position of a node, m.
    pub(super) fn add_place(&mut self, place: Vector3<f64>) {
        self.places.push(place);
    }

    /// Number of nodes so far.
    pub(super) fn nodes(&self) -> usize {
        self.places.len()
    }

    /// Number of tetrahedra so far.
    pub(super) fn elements(&self) -> usize {
        self.elements.len()
    }

    /// Adds a tetrahedron of the mesh to another physical group.
    pub(super) fn add_to_group(&mut self, element: usize, group: Group) {
        self.sets.entry(group).or_default().elements.push(element);
    }

    /// Adds an element to its physical groups; a tetrahedron to the mesh too.
    pub(super) fn add_element(&mut self, kind: Kind, tags: &[i64], groups: &[Group]) -> Result<(), Problem> {
        if kind.number != TETRAHEDRON && groups.is_empty() {
            return Ok(());
        }
        let node = |&tag: &i64| self.index.get(&tag).copied().ok_or(Problem::UnknownTag { tag });
        let nodes = tags.iter().map(node).collect::<Result<Vec<_>, _>>()?;
        let mut part = MeshSet::default();
        match (kind.number, &nodes[..]) {
            (TETRAHEDRON, &[a, b, c, d]) => {
                part.elements.push(self.elements.len());
                self.elements.push([a, b, c, d]);
            }
            (TRIANGLE, &[a, b, c]) => part.faces.push([a, b, c]),
            (LINE, &[a, b]) => part.edges.push([a, b]),
            (POINT, &[a]) => part.points.push(a),
            _ => {
                let found = format!("a physical group of {} (Gmsh's element type {})", kind.name, kind.number);
                return Err(Problem::Unsupported { found, instead: FIRST_ORDER });
            }
        }
        for &group in groups {
            self.sets.entry(group).or_default().extend(part.clone());
        }
        Ok(())
    }

    /// The mesh. A group has its name, or its number if it has none.
    pub(super) fn finish(self) -> TetrahedralMesh {
        let mut sets: BTreeMap<String, MeshSet> = BTreeMap::new();
        for (group, set) in self.sets {
            let name = self.names.get(&group).cloned().unwrap_or_else(|| group.1.to_string());
            sets.entry(name).or_default().extend(set);
        }
        sets.values_mut().for_each(MeshSet::sort);
        TetrahedralMesh { vertices: self.places, elements: self.elements, sets }
    }
}

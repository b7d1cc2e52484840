//! Named sets in formats that have them as numbers, or as fields of cells and points.

use std::collections::BTreeMap;

use crate::{Mesh, MeshSet};

/// A number for each part of a mesh, 0 for those in no set. Of a part in several sets, the first one by name counts.
pub(super) struct Tags {
    /// Names and numbers of the sets whose names are no numbers.
    pub named: Vec<(String, i32)>,
    pub elements: Vec<i32>,
    pub nodes: Vec<i32>,
    pub faces: BTreeMap<[usize; 3], i32>,
    pub edges: BTreeMap<[usize; 2], i32>,
    /// Number of parts that are in several sets.
    pub lost: usize,
}

impl Tags {
    /// A set whose name is a number above 0 has that number, others the next free one.
    pub(super) fn of<const N: usize>(mesh: &Mesh<3, N>) -> Self {
        let given =
            |name: &String| name.parse::<i32>().ok().filter(|number| *number > 0 && number.to_string() == *name);
        let mut used: Vec<i32> = mesh.sets.keys().filter_map(given).collect();
        let mut tags = Self {
            named: Vec::new(),
            elements: vec![0; mesh.elements.len()],
            nodes: vec![0; mesh.vertices.len()],
            faces: BTreeMap::new(),
            edges: BTreeMap::new(),
            lost: 0,
        };
        for (name, set) in &mesh.sets {
            let number = given(name).unwrap_or_else(|| {
                let next = (1..).find(|number| !used.contains(number)).unwrap_or(0);
                used.push(next);
                tags.named.push((name.clone(), next));
                next
            });
            tags.add(set, number);
        }
        tags
    }

    fn add(&mut self, set: &MeshSet, number: i32) {
        if !(set.faces.is_empty() && set.edges.is_empty()) {
            // Readers take the nodes of faces and edges from those.
            self.lost += set.points.len();
        }
        let lost = &mut self.lost;
        let mut mark = |tag: &mut i32| match *tag {
            0 => *tag = number,
            _ => *lost += 1,
        };
        set.elements.iter().for_each(|&element| mark(&mut self.elements[element]));
        set.points.iter().for_each(|&node| mark(&mut self.nodes[node]));
        set.faces.iter().for_each(|&face| mark(self.faces.entry(face).or_default()));
        set.edges.iter().for_each(|&edge| mark(self.edges.entry(edge).or_default()));
    }

    /// A comment for each name, which this library reads again.
    pub(super) fn comments(&self) -> String {
        self.named.iter().map(|(name, number)| format!("# set {number} {name}\n")).collect()
    }
}

/// Faces and edges of sets as cells behind the elements, and a field of zeros and ones for each set.
pub(super) struct Marks {
    /// Nodes of the cells behind the elements: three of a face, two of an edge.
    pub cells: Vec<Vec<usize>>,
    /// For each set with elements, faces or edges a value of each cell, the elements first.
    pub of_cells: Vec<(String, Vec<u8>)>,
    /// For each set with points a value of each node.
    pub of_nodes: Vec<(String, Vec<u8>)>,
}

impl Marks {
    pub(super) fn of<const N: usize>(mesh: &Mesh<3, N>) -> Self {
        let parts = |set: &MeshSet| -> Vec<Vec<usize>> {
            set.faces.iter().map(|face| face.to_vec()).chain(set.edges.iter().map(|edge| edge.to_vec())).collect()
        };
        let mut cells: Vec<Vec<usize>> = mesh.sets.values().flat_map(parts).collect();
        cells.sort_unstable();
        cells.dedup();
        let count = mesh.elements.len();
        let (mut of_cells, mut of_nodes) = (Vec::new(), Vec::new());
        for (name, set) in &mesh.sets {
            let name = format!("{}{name}", crate::read::SET);
            let parts = parts(set);
            if !set.elements.is_empty() || !parts.is_empty() {
                let mut marks = vec![0; count + cells.len()];
                set.elements.iter().for_each(|&element| marks[element] = 1);
                parts.iter().filter_map(|part| cells.binary_search(part).ok()).for_each(|cell| marks[count + cell] = 1);
                of_cells.push((name.clone(), marks));
            }
            if !set.points.is_empty() {
                let mut marks = vec![0; mesh.vertices.len()];
                set.points.iter().for_each(|&node| marks[node] = 1);
                of_nodes.push((name, marks));
            }
        }
        Self { cells, of_cells, of_nodes }
    }
}

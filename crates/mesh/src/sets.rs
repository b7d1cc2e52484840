//! Named sets: parts of a mesh that a file names, such as Gmsh's physical groups.

use std::collections::HashMap;

use super::connectivity::{quarters, sorted};
use super::{Mesh, Problem};

/// A named part of a mesh. Every list is ascending and without repeats. In a triangle mesh the elements are triangles, and `faces` is
/// empty.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct MeshSet {
    /// Elements, by their index.
    pub elements: Vec<usize>,
    /// Faces of tetrahedra, each by its three nodes in ascending order.
    pub faces: Vec<[usize; 3]>,
    /// Edges, each by its two nodes in ascending order.
    pub edges: Vec<[usize; 2]>,
    /// Single nodes.
    pub points: Vec<usize>,
}

impl MeshSet {
    /// The nodes of its triangles, edges and points; those of its elements if it has no triangles, edges or points. Ascending, without
    /// repeats.
    ///
    /// A file without names numbers its groups of every dimension from 1, so a surface and a volume can share a name; the nodes
    /// of the surface are meant then.
    pub fn nodes<'a>(&self, nodes_of: impl Fn(usize) -> &'a [usize]) -> Vec<usize> {
        let (faces, edges) = (self.faces.iter().flatten(), self.edges.iter().flatten());
        let mut nodes: Vec<usize> = faces.chain(edges).chain(&self.points).copied().collect();
        if nodes.is_empty() {
            nodes = self.elements.iter().flat_map(|&element| nodes_of(element)).copied().collect();
        }
        nodes.sort_unstable();
        nodes.dedup();
        nodes
    }

    /// The counts of its parts in a tetrahedral mesh, such as `24 triangles`.
    pub fn counts(&self) -> String {
        self.counts_of("tetrahedra", "triangles")
    }

    /// The counts of its parts in a triangle mesh.
    pub fn counts_of_triangles(&self) -> String {
        self.counts_of("triangles", "faces")
    }

    fn counts_of(&self, elements: &str, faces: &str) -> String {
        let counts = [
            (self.elements.len(), elements),
            (self.faces.len(), faces),
            (self.edges.len(), "edges"),
            (self.points.len(), "points"),
        ];
        let counts = counts.into_iter().filter(|(count, _)| *count > 0);
        counts.map(|(count, what)| format!("{count} {what}")).collect::<Vec<_>>().join(", ")
    }

    /// Adds the parts of another set.
    pub(crate) fn extend(&mut self, other: Self) {
        self.elements.extend(other.elements);
        self.faces.extend(other.faces);
        self.edges.extend(other.edges);
        self.points.extend(other.points);
    }

    /// Sorts the lists and the nodes of each part, and removes repeats.
    pub(crate) fn sort(&mut self) {
        self.faces.iter_mut().for_each(|face| face.sort_unstable());
        self.edges.iter_mut().for_each(|edge| edge.sort_unstable());
        sort_list(&mut self.elements);
        sort_list(&mut self.faces);
        sort_list(&mut self.edges);
        sort_list(&mut self.points);
    }

    /// The same part of the mesh after every element has become so many; `midpoint` is the new node on an edge.
    pub(crate) fn refined(&self, children: usize, midpoint: impl Fn([usize; 2]) -> usize) -> Self {
        let face = |&[a, b, c]: &[usize; 3]| quarters([a, b, c, midpoint([a, b]), midpoint([b, c]), midpoint([a, c])]);
        let edge = |&[a, b]: &[usize; 2]| [[a, midpoint([a, b])], [midpoint([a, b]), b]];
        let mut fine = Self {
            elements: self.elements.iter().flat_map(|element| children * element..children * (element + 1)).collect(),
            faces: self.faces.iter().flat_map(face).collect(),
            edges: self.edges.iter().flat_map(edge).collect(),
            points: self.points.clone(),
        };
        fine.sort();
        fine
    }
}

fn sort_list<T: Ord>(list: &mut Vec<T>) {
    list.sort_unstable();
    list.dedup();
}

/// Checks that the sets consist of parts of the mesh: its elements, their faces and edges, and its nodes.
pub(crate) fn check<const N: usize>(mesh: &Mesh<3, N>) -> Result<(), Problem> {
    let (faces, edges) = parts_of_elements(mesh);
    for (name, set) in &mesh.sets {
        let stray = |part: String| Problem::StrayPart { set: name.clone(), part };
        if let Some(element) = set.elements.iter().find(|&&element| element >= mesh.elements.len()) {
            return Err(stray(format!("the element {element}")));
        }
        if let Some(face) = set.faces.iter().find(|face| faces.get(&sorted(**face)) != Some(&true)) {
            return Err(stray(format!("the triangle {face:?}")));
        }
        if let Some(edge) = set.edges.iter().find(|edge| edges.get(&sorted(**edge)) != Some(&true)) {
            return Err(stray(format!("the edge {edge:?}")));
        }
        if let Some(node) = set.points.iter().find(|&&node| node >= mesh.vertices.len()) {
            return Err(stray(format!("the node {node}")));
        }
    }
    Ok(())
}

/// Faces and edges by their sorted nodes, true if they belong to an element.
type Found = (HashMap<[usize; 3], bool>, HashMap<[usize; 2], bool>);

/// The faces and edges of the sets of a mesh.
pub(crate) fn parts_of_elements<const N: usize>(mesh: &Mesh<3, N>) -> Found {
    let mut faces: HashMap<[usize; 3], bool> =
        mesh.sets.values().flat_map(|set| &set.faces).map(|&face| (sorted(face), false)).collect();
    let mut edges: HashMap<[usize; 2], bool> =
        mesh.sets.values().flat_map(|set| &set.edges).map(|&edge| (sorted(edge), false)).collect();
    if faces.is_empty() && edges.is_empty() {
        return (faces, edges);
    }
    // Few elements have two nodes of these parts; the others need no look into the maps.
    let mut is_near = vec![false; mesh.vertices.len()];
    for &node in faces.keys().flatten().chain(edges.keys().flatten()) {
        is_near.get_mut(node).into_iter().for_each(|is_near| *is_near = true);
    }
    let is_near = |node: &&usize| is_near.get(**node) == Some(&true);
    for element in mesh.elements.iter().filter(|element| element.iter().filter(is_near).count() > 1) {
        for (c, b) in (0..N).flat_map(|c| (0..c).map(move |b| (c, b))) {
            if !edges.is_empty()
                && let Some(is_found) = edges.get_mut(&sorted([element[b], element[c]]))
            {
                *is_found = true;
            }
            for a in 0..if faces.is_empty() { 0 } else { b } {
                if let Some(is_found) = faces.get_mut(&sorted([element[a], element[b], element[c]])) {
                    *is_found = true;
                }
            }
        }
    }
    (faces, edges)
}

/// The combination of sets that each element belongs to, and the sets of each combination, by their place in the mesh.
pub(crate) fn combinations<const D: usize, const N: usize>(mesh: &Mesh<D, N>) -> (Vec<u32>, Vec<Vec<usize>>) {
    let mut sets_of_elements = vec![Vec::new(); mesh.elements.len()];
    for (number, set) in mesh.sets.values().enumerate() {
        set.elements.iter().for_each(|&element| sets_of_elements[element].push(number));
    }
    let (mut numbers, mut combinations) = (HashMap::new(), Vec::new());
    let of_elements = sets_of_elements.into_iter().map(|sets| {
        *numbers.entry(sets).or_insert_with_key(|sets| {
            combinations.push(sets.clone());
            combinations.len() as u32 - 1
        })
    });
    (of_elements.collect(), combinations)
}

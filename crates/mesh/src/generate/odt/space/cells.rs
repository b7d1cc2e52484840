//! A tetrahedral mesh that changes: its elements, those around each vertex, and the parts that stay.

use std::collections::{BTreeMap, HashSet};

use nalgebra::Vector3;

use super::shape::Shape;
use crate::boundary::FACES;
use crate::connectivity::{EDGES, sorted};
use crate::sets::combinations;
use crate::{MeshSet, TetrahedralMesh, boundary};

/// Corners of an element that has been removed.
const REMOVED: [u32; 4] = [u32::MAX; 4];

/// Freedom of a vertex to move.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Freedom {
    /// Stays: the boundary, and the parts that sets name.
    Fixed,
    /// Moves on the surface that the caller gives.
    OnSurface,
    /// Moves freely.
    Inside,
}

/// The mesh while it changes.
pub struct Cells {
    /// m
    pub positions: Vec<Vector3<f64>>,
    /// Corners of each element, positively oriented.
    pub corners: Vec<[u32; 4]>,
    /// Elements around each vertex.
    pub stars: Vec<Vec<u32>>,
    /// Freedom of each vertex to move.
    pub freedom: Vec<Freedom>,
    /// The combination of sets that each element belongs to.
    regions: Vec<u32>,
    /// The sets of each combination.
    sets_of_regions: Vec<Vec<usize>>,
    kept_faces: HashSet<[u32; 3]>,
    kept_edges: HashSet<[u32; 2]>,
    kept_points: HashSet<u32>,
    unused: Vec<u32>,
}

impl Cells {
    /// Takes a mesh that has passed the check. Faces between elements of different sets stay, as do the faces, edges and points that
    /// sets name.
    pub fn new(mesh: &TetrahedralMesh) -> Self {
        let corners: Vec<[u32; 4]> = mesh.elements.iter().map(|element| element.map(|i| i as u32)).collect();
        let mut stars = vec![Vec::new(); mesh.vertices.len()];
        for (cell, corners) in corners.iter().enumerate() {
            corners.iter().for_each(|&vertex| stars[vertex as usize].push(cell as u32));
        }
        let (regions, sets_of_regions) = combinations(mesh);
        let mut cells = Self {
            positions: mesh.vertices.clone(),
            corners,
            stars,
            freedom: vec![Freedom::Inside; mesh.vertices.len()],
            regions,
            sets_of_regions,
            kept_faces: HashSet::new(),
            kept_edges: HashSet::new(),
            kept_points: HashSet::new(),
            unused: Vec::new(),
        };
        cells.keep_boundary_and_sets(mesh);
        cells
    }

    fn keep_boundary_and_sets(&mut self, mesh: &TetrahedralMesh) {
        for face in boundary(mesh) {
            face.iter().for_each(|&vertex| self.freedom[vertex] = Freedom::Fixed);
        }
        for set in mesh.sets.values() {
            self.kept_faces.extend(set.faces.iter().map(|face| sorted(face.map(|i| i as u32))));
            self.kept_edges.extend(set.edges.iter().map(|edge| sorted(edge.map(|i| i as u32))));
            self.kept_points.extend(set.points.iter().map(|&point| point as u32));
        }
        if self.sets_of_regions.len() > 1 {
            let between: Vec<[u32; 3]> = (0..self.corners.len() as u32)
                .flat_map(|cell| (0..4).map(move |side| (cell, side)))
                .filter(|&(cell, side)| {
                    let other = self.neighbour(cell, side);
                    other.is_some_and(|other| self.regions[other as usize] != self.regions[cell as usize])
                })
                .map(|(cell, side)| sorted(self.face(cell, side)))
                .collect();
            self.kept_faces.extend(between);
        }
        for face in &self.kept_faces {
            self.kept_edges.extend([[face[0], face[1]], [face[0], face[2]], [face[1], face[2]]]);
        }
        self.kept_points.extend(self.kept_edges.iter().flatten());
        self.kept_points.iter().for_each(|&vertex| self.freedom[vertex as usize] = Freedom::Fixed);
    }

    /// Returns true if a set names the vertex, or a face or an edge with it.
    pub fn is_kept(&self, vertex: u32) -> bool {
        self.kept_points.contains(&vertex)
    }

    /// The mesh as it is now, with its sets. Vertices keep their numbers.
    pub fn mesh(&self, sets: &BTreeMap<String, MeshSet>) -> TetrahedralMesh {
        let (mut elements, mut sets) = (Vec::with_capacity(self.corners.len()), sets.clone());
        sets.values_mut().for_each(|set| set.elements.clear());
        let mut lists: Vec<&mut Vec<usize>> = sets.values_mut().map(|set| &mut set.elements).collect();
        for cell in self.cells() {
            for &set in &self.sets_of_regions[self.regions[cell as usize] as usize] {
                lists[set].push(elements.len());
            }
            elements.push(self.corners[cell as usize].map(|vertex| vertex as usize));
        }
        TetrahedralMesh { vertices: self.positions.clone(), elements, sets }
    }

    /// The elements, ascending.
    pub fn cells(&self) -> impl Iterator<Item = u32> + '_ {
        (0..self.corners.len() as u32).filter(|&cell| self.is_alive(cell))
    }

    /// Returns true if an element has not been removed.
    pub fn is_alive(&self, cell: u32) -> bool {
        self.corners[cell as usize] != REMOVED
    }

    /// Positions of an element's corners, m.
    pub fn points(&self, corners: [u32; 4]) -> [Vector3<f64>; 4] {
        corners.map(|vertex| self.positions[vertex as usize])
    }

    /// Shape of an element.
    pub fn shape(&self, cell: u32) -> Shape {
        Shape::new(self.points(self.corners[cell as usize]))
    }

    /// The face opposite a corner, counter-clockwise from outside.
    pub fn face(&self, cell: u32, side: usize) -> [u32; 3] {
        FACES[side].map(|corner| self.corners[cell as usize][corner])
    }

    /// The element on the other side of a face.
    pub fn neighbour(&self, cell: u32, side: usize) -> Option<u32> {
        let [a, b, c] = self.face(cell, side);
        let has = |other: u32| {
            let corners = &self.corners[other as usize];
            other != cell && corners.contains(&b) && corners.contains(&c)
        };
        self.stars[a as usize].iter().copied().find(|&other| has(other))
    }

    /// The elements around an edge.
    pub fn around(&self, [a, b]: [u32; 2]) -> Vec<u32> {
        let star = &self.stars[a as usize];
        star.iter().copied().filter(|&cell| self.corners[cell as usize].contains(&b)).collect()
    }

    /// Returns true if the face may be removed.
    pub fn is_removable_face(&self, face: [u32; 3]) -> bool {
        self.kept_faces.is_empty() || !self.kept_faces.contains(&sorted(face))
    }

    /// Returns true if the edge and the faces around it may be removed.
    pub fn is_removable_edge(&self, edge: [u32; 2], ring: &[u32]) -> bool {
        (self.kept_edges.is_empty() || !self.kept_edges.contains(&sorted(edge)))
            && ring.iter().all(|&other| self.is_removable_face([edge[0], edge[1], other]))
    }

    /// Replaces elements by others in the same place. They are all of one combination of sets, as no kept face lies between them.
    pub fn replace(&mut self, old: &[u32], new: &[[u32; 4]]) {
        let region = self.regions[old[0] as usize];
        old.iter().for_each(|&cell| self.remove(cell));
        for &corners in new {
            let cell = self.unused.pop().unwrap_or(self.corners.len() as u32);
            if cell as usize == self.corners.len() {
                self.corners.push(corners);
                self.regions.push(region);
            }
            self.corners[cell as usize] = corners;
            self.regions[cell as usize] = region;
            corners.iter().for_each(|&vertex| self.stars[vertex as usize].push(cell));
        }
    }

    /// Removes an element.
    pub fn remove(&mut self, cell: u32) {
        for vertex in self.corners[cell as usize] {
            self.stars[vertex as usize].retain(|&other| other != cell);
        }
        self.corners[cell as usize] = REMOVED;
        self.unused.push(cell);
    }

    /// Mean length of the edges at a vertex, m.
    pub fn mean_edge(&self, vertex: u32) -> f64 {
        let star = &self.stars[vertex as usize];
        let here = self.positions[vertex as usize];
        let ends = star.iter().flat_map(|&cell| self.corners[cell as usize]);
        let sum: f64 = ends.map(|end| (self.positions[end as usize] - here).norm()).sum();
        sum / (3 * star.len().max(1)) as f64
    }

    /// Mean length of all edges, each counted for each of its elements, m.
    pub fn mean_edge_of_all(&self) -> f64 {
        let lengths = self.cells().flat_map(|cell| {
            let points = self.points(self.corners[cell as usize]);
            EDGES.map(|[i, j]| (points[j] - points[i]).norm())
        });
        let (sum, count) = lengths.fold((0.0, 0_usize), |(sum, count), length| (sum + length, count + 1));
        sum / count.max(1) as f64
    }
}

//! Collapse of a cage's edges: fewer tetrahedra that enclose the same surface.

use std::collections::{HashMap, HashSet};

use nalgebra::Vector3;

use super::Walls;
use crate::connectivity::{EDGES, sorted};
use crate::quality::{Triangle, extreme_dihedral_angles, meet};
use crate::{Mesh, TetrahedralMesh, boundary, signed_volume};

/// Dihedral angles that no collapse may exceed, degrees.
const ANGLES: [f64; 2] = [16.0, 145.0];

/// Longest edge that a collapse may leave, over the wanted one.
const LONGEST: f64 = 1.6;

/// The vertex beyond the boundary, to which every boundary triangle is joined: the complex is closed, and one rule serves for its
/// inside and its boundary.
const BEYOND: usize = usize::MAX;

/// A mesh that is being coarsened.
struct Coarsened<'a> {
    vertices: Vec<Vector3<f64>>,
    /// Tetrahedra, and boundary triangles with [`BEYOND`]; `None` if they have collapsed.
    elements: Vec<Option<[usize; 4]>>,
    /// Elements at each vertex; those that have collapsed may be among them.
    stars: Vec<Vec<usize>>,
    /// Boundary triangles by cell of a grid, for collisions of the boundary with itself; old ones may be among them.
    cells: HashMap<[i32; 3], Vec<usize>>,
    edge: f64,
    walls: &'a Walls,
}

/// Collapses edges shorter than `edge` m, shortest first, as long as the tetrahedra keep their angles, the boundary its topology, and no new
/// boundary triangle meets the walls or another part of the boundary.
pub fn coarsen(mesh: &TetrahedralMesh, walls: &Walls, edge: f64) -> TetrahedralMesh {
    let mut coarsened = Coarsened::new(mesh, walls, edge);
    // Each pass shortens the list of edges that may still collapse; a few are enough.
    for _ in 0..12 {
        if coarsened.pass() == 0 {
            break;
        }
    }
    coarsened.finish()
}

impl<'a> Coarsened<'a> {
    fn new(mesh: &TetrahedralMesh, walls: &'a Walls, edge: f64) -> Self {
        let beyond = boundary(mesh).into_iter().map(|[a, b, c]| [a, b, c, BEYOND]);
        let elements: Vec<[usize; 4]> = mesh.elements.iter().copied().chain(beyond).collect();
        let mut stars = vec![Vec::new(); mesh.vertices.len()];
        for (i, element) in elements.iter().enumerate() {
            element.iter().filter(|&&vertex| vertex != BEYOND).for_each(|&vertex| stars[vertex].push(i));
        }
        let elements: Vec<_> = elements.into_iter().map(Some).collect();
        let mut new = Self { vertices: mesh.vertices.clone(), elements, stars, cells: HashMap::new(), edge, walls };
        (0..new.elements.len()).for_each(|i| new.enter(i));
        new
    }

    /// Tries to collapse every short edge once; the number of collapses.
    fn pass(&mut self) -> usize {
        let mut edges = HashSet::new();
        for element in self.elements.iter().flatten() {
            for edge in EDGES {
                let [a, b] = sorted(edge.map(|i| element[i]));
                if b != BEYOND {
                    edges.insert((a, b));
                }
            }
        }
        let length = |(a, b): (usize, usize)| (self.vertices[a] - self.vertices[b]).norm();
        let mut short: Vec<(f64, usize, usize)> =
            edges.into_iter().map(|edge| (length(edge), edge.0, edge.1)).collect();
        short.retain(|edge| edge.0 < self.edge);
        short.sort_by(|a, b| a.0.total_cmp(&b.0).then((a.1, a.2).cmp(&(b.1, b.2))));
        short.into_iter().filter(|&(_, a, b)| self.collapse(a, b) || self.collapse(b, a)).count()
    }

    /// Elements at a vertex.
    fn star(&self, vertex: usize) -> Vec<(usize, [usize; 4])> {
        let present =
            |&i: &usize| self.elements[i].filter(|element| element.contains(&vertex)).map(|element| (i, element));
        self.stars[vertex].iter().filter_map(present).collect()
    }

    /// Moves a vertex to a neighbour if all conditions hold.
    fn collapse(&mut self, from: usize, to: usize) -> bool {
        let (star, other) = (self.star(from), self.star(to));
        if !star.iter().any(|(_, element)| element.contains(&to)) || !is_linked(from, to, &star, &other) {
            return false;
        }
        let kept: Vec<(usize, [usize; 4])> = star
            .iter()
            .filter(|(_, element)| !element.contains(&to))
            .map(|&(i, element)| (i, element.map(|vertex| if vertex == from { to } else { vertex })))
            .collect();
        let own: Vec<usize> = star.iter().map(|&(i, _)| i).collect();
        if !kept.iter().all(|(_, element)| self.is_good(element, &own)) {
            return false;
        }
        star.iter().for_each(|&(i, _)| self.elements[i] = None);
        for (i, element) in kept {
            self.elements[i] = Some(element);
            self.stars[to].push(i);
            self.enter(i);
        }
        self.stars[from].clear();
        true
    }

    /// Returns true if an element may replace the elements `own`.
    fn is_good(&self, element: &[usize; 4], own: &[usize]) -> bool {
        if element.contains(&BEYOND) {
            return self.is_free(face_of(element), own);
        }
        let corners = element.map(|vertex| self.vertices[vertex]);
        let lengths = EDGES.map(|[i, j]| (corners[i] - corners[j]).norm());
        let [smallest, largest] = extreme_dihedral_angles(corners);
        signed_volume(corners) > 0.0
            && smallest >= ANGLES[0]
            && largest <= ANGLES[1]
            && lengths.into_iter().fold(0.0, f64::max) <= LONGEST * self.edge
    }

    /// Returns true if a boundary triangle meets neither the walls nor, away from its own corners, the boundary.
    fn is_free(&self, face: [usize; 3], own: &[usize]) -> bool {
        let corners = face.map(|vertex| self.vertices[vertex]);
        let Some(triangle) = Triangle::new(corners) else { return false };
        let meets_boundary = |&i: &usize| {
            let Some(element) = self.elements[i].filter(|element| element.contains(&BEYOND) && !own.contains(&i))
            else {
                return false;
            };
            let other = face_of(&element);
            let is_apart = !other.iter().any(|vertex| face.contains(vertex));
            is_apart && Triangle::new(other.map(|v| self.vertices[v])).is_some_and(|other| meet(&triangle, &other))
        };
        let is_met = cells(&corners, self.edge)
            .any(|cell| self.cells.get(&cell).is_some_and(|all| all.iter().any(meets_boundary)));
        !is_met && !self.walls.meet(corners)
    }

    /// Enters a boundary triangle into the grid.
    fn enter(&mut self, i: usize) {
        if let Some(element) = self.elements[i].filter(|element| element.contains(&BEYOND)) {
            let corners = face_of(&element).map(|vertex| self.vertices[vertex]);
            cells(&corners, self.edge).for_each(|cell| self.cells.entry(cell).or_default().push(i));
        }
    }

    /// The tetrahedra that are left, with the vertices that they use.
    fn finish(self) -> TetrahedralMesh {
        let mut elements: Vec<[usize; 4]> =
            self.elements.into_iter().flatten().filter(|element| !element.contains(&BEYOND)).collect();
        let (mut numbers, mut vertices) = (HashMap::new(), Vec::new());
        for vertex in elements.iter_mut().flatten() {
            *vertex = *numbers.entry(*vertex).or_insert_with(|| {
                vertices.push(self.vertices[*vertex]);
                vertices.len() - 1
            });
        }
        Mesh::new(vertices, elements)
    }
}

/// The corners of a boundary triangle.
fn face_of(element: &[usize; 4]) -> [usize; 3] {
    opposite(element, BEYOND)
}

/// The corners of an element but one.
fn opposite(element: &[usize; 4], vertex: usize) -> [usize; 3] {
    let mut face = element.iter().copied().filter(|&corner| corner != vertex);
    [(); 3].map(|()| face.next().unwrap_or(BEYOND))
}

/// Cells of a grid that the box around a triangle touches.
fn cells(corners: &[Vector3<f64>; 3], side: f64) -> impl Iterator<Item = [i32; 3]> + use<> {
    let least = corners[0].inf(&corners[1]).inf(&corners[2]).map(|x| (x / side).floor() as i32);
    let largest = corners[0].sup(&corners[1]).sup(&corners[2]).map(|x| (x / side).floor() as i32);
    (least.x..=largest.x)
        .flat_map(move |x| (least.y..=largest.y).flat_map(move |y| (least.z..=largest.z).map(move |z| [x, y, z])))
}

/// A vertex, an edge or a triangle: its corners in ascending order, the last one repeated.
type Part = [usize; 3];

/// The link condition: the collapse of an edge keeps the topology of a closed complex if the links of its ends have in common the link of
/// the edge alone. Dey, Edelsbrunner, Guha and Nekhayev, Topology Preserving Edge Contraction (1999).
fn is_linked(from: usize, to: usize, star: &[(usize, [usize; 4])], other: &[(usize, [usize; 4])]) -> bool {
    let mut of_edge = Vec::new();
    for (_, element) in star.iter().filter(|(_, element)| element.contains(&to)) {
        let mut rest = element.iter().copied().filter(|&corner| corner != from && corner != to);
        let [i, j] = sorted([(); 2].map(|()| rest.next().unwrap_or(BEYOND)));
        of_edge.extend([[i; 3], [j; 3], [i, j, j]]);
    }
    let (own, others) = (link(from, star), link(to, other));
    own.iter().all(|part| others.binary_search(part).is_err() || of_edge.contains(part))
}

/// The parts of the link of a vertex, in ascending order.
fn link(vertex: usize, star: &[(usize, [usize; 4])]) -> Vec<Part> {
    let parts = |(_, element): &(usize, [usize; 4])| {
        let mut face = opposite(element, vertex);
        face.sort_unstable();
        let [i, j, k] = face;
        [[i; 3], [j; 3], [k; 3], [i, j, j], [i, k, k], [j, k, k], face]
    };
    let mut link: Vec<Part> = star.iter().flat_map(parts).collect();
    link.sort_unstable();
    link.dedup();
    link
}

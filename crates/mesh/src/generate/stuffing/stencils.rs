//! Stencils: the part of each tetrahedron of the lattice that lies inside the surface, cut into tetrahedra.

use std::collections::HashMap;
use std::num::NonZeroU32;

use nalgebra::Vector3;

use super::lattice::{Lattice, Place};
use super::octree::Octree;
use crate::quality::extreme_dihedral_angles;
use crate::{TetrahedralMesh, signed_volume};

/// A corner of a tetrahedron of the lattice.
#[derive(Clone, Copy)]
struct Corner {
    node: u32,
    place: Place,
}

/// The mesh as it grows.
struct Filled<'a> {
    lattice: &'a Lattice,
    /// Vertex of the mesh at each node of the lattice, if it has one.
    nodes: Vec<Option<NonZeroU32>>,
    /// Vertex of the mesh at the cut of an edge from a node inside to one outside.
    cuts: HashMap<[u32; 2], usize>,
    vertices: Vec<Vector3<f64>>,
    elements: Vec<[usize; 4]>,
}

/// Fills the inside of the surface.
pub fn fill(lattice: &Lattice, octree: &Octree) -> TetrahedralMesh {
    let mut filled = Filled {
        lattice,
        nodes: vec![None; lattice.signs.len()],
        cuts: HashMap::new(),
        vertices: Vec::new(),
        elements: Vec::new(),
    };
    octree.tetrahedra(|places| {
        let corners = places.map(|place| lattice.node(place).map(|node| Corner { node, place }));
        if let [Some(a), Some(b), Some(c), Some(d)] = corners {
            filled.add(&[a, b, c, d]);
        }
    });
    TetrahedralMesh::new(filled.vertices, filled.elements)
}

impl Filled<'_> {
    fn add(&mut self, corners: &[Corner; 4]) {
        let signs = &self.lattice.signs;
        let of = |sign: i8| corners.iter().filter(move |corner| signs[corner.node as usize] == sign).copied();
        let (inside, outside) = (of(1).collect::<Vec<_>>(), of(-1).collect::<Vec<_>>());
        let on: Vec<Corner> = of(0).collect();
        match (&inside[..], &outside[..]) {
            ([], _) => {}
            (_, []) => {
                let vertices = corners.map(|corner| self.node(corner));
                self.push(vertices);
            }
            ([a], _) => {
                let mut vertices = vec![self.node(*a)];
                for corner in corners.iter().filter(|corner| corner.node != a.node) {
                    let is_outside = outside.iter().any(|outside| outside.node == corner.node);
                    vertices.push(if is_outside { self.cut(*a, *corner) } else { self.node(*corner) });
                }
                self.push([vertices[0], vertices[1], vertices[2], vertices[3]]);
            }
            ([a, b], [m]) => {
                let (first, second) = if touches_first(*a, *b, *m) { (*a, *b) } else { (*b, *a) };
                let (p, q, z) = (self.node(first), self.node(second), self.node(on[0]));
                let (cp, cq) = (self.cut(first, *m), self.cut(second, *m));
                self.push([p, q, cq, z]);
                self.push([p, cq, cp, z]);
            }
            ([a, b, c], [m]) => {
                let columns = [*a, *b, *c].map(|corner| [self.node(corner), self.cut(corner, *m)]);
                let is_before = |i: usize, j: usize| touches_first([*a, *b, *c][i], [*a, *b, *c][j], *m);
                self.prism(columns, [is_before(0, 1), is_before(0, 2), is_before(1, 2)]);
            }
            ([a, b], [m, n]) => {
                let nodes = [self.node(*a), self.node(*b)];
                let (at_m, at_n) = ([self.cut(*a, *m), self.cut(*b, *m)], [self.cut(*a, *n), self.cut(*b, *n)]);
                let (before_m, before_n) = (touches_first(*a, *b, *m), touches_first(*a, *b, *n));
                let columns = [nodes, at_m, at_n];
                // The fourth side of the prism lies in the surface, and its diagonal is free unless the other two decide it.
                match (before_m, before_n) {
                    (true, false) => self.prism(columns, [true, false, false]),
                    (false, true) => self.prism(columns, [false, true, true]),
                    _ => {
                        let worst = |before_12| self.worst_of_prism(columns, [before_m, before_n, before_12]);
                        let is_better = worst(true) >= worst(false);
                        self.prism(columns, [before_m, before_n, is_better]);
                    }
                }
            }
            _ => {}
        }
    }

    fn prism(&mut self, columns: [[usize; 2]; 3], before: [bool; 3]) {
        tetrahedra_of_prism(columns, before).into_iter().for_each(|element| self.push(element));
    }

    /// Smallest dihedral angle of the tetrahedra of a prism, degrees.
    fn worst_of_prism(&self, columns: [[usize; 2]; 3], before: [bool; 3]) -> f64 {
        let angle = |element: [usize; 4]| extreme_dihedral_angles(self.oriented(element).map(|i| self.vertices[i]))[0];
        tetrahedra_of_prism(columns, before).into_iter().map(angle).fold(f64::INFINITY, f64::min)
    }

    fn node(&mut self, corner: Corner) -> usize {
        if let Some(number) = self.nodes[corner.node as usize] {
            return number.get() as usize - 1;
        }
        self.vertices.push(self.lattice.position(corner.node, corner.place));
        // A mesh with more than 2³² vertices fits into no memory.
        self.nodes[corner.node as usize] = NonZeroU32::new(self.vertices.len() as u32);
        self.vertices.len() - 1
    }

    fn cut(&mut self, inside: Corner, outside: Corner) -> usize {
        *self.cuts.entry([inside.node, outside.node]).or_insert_with(|| {
            self.vertices.push(self.lattice.cut_between(inside.node, outside.node).unwrap_or_else(Vector3::zeros));
            self.vertices.len() - 1
        })
    }

    fn push(&mut self, element: [usize; 4]) {
        let element = self.oriented(element);
        self.elements.push(element);
    }

    fn oriented(&self, mut element: [usize; 4]) -> [usize; 4] {
        if signed_volume(element.map(|i| self.vertices[i])) < 0.0 {
            element.swap(2, 3);
        }
        element
    }
}

/// A prism between the first and the second vertices of three columns. The diagonal between two columns runs from the first vertex of the one
/// that is before the other: whether 0 is before 1, 0 before 2, and 1 before 2.
fn tetrahedra_of_prism(columns: [[usize; 2]; 3], [before_01, before_02, before_12]: [bool; 3]) -> [[usize; 4]; 3] {
    let rank = [
        usize::from(!before_01) + usize::from(!before_02),
        usize::from(before_01) + usize::from(!before_12),
        usize::from(before_02) + usize::from(before_12),
    ];
    let mut order = [0, 1, 2];
    order.sort_by_key(|&column| rank[column]);
    let [[a1, a2], [b1, b2], [c1, c2]] = order.map(|column| columns[column]);
    [[a1, b1, c1, c2], [a1, b1, c2, b2], [a1, a2, b2, c2]]
}

/// Returns true if the diagonal of the quadrilateral that remains of a face touches the first of its two inner corners, by a rule that both
/// tetrahedra at the face see alike.
fn touches_first(a: Corner, b: Corner, outside: Corner) -> bool {
    let is_centre = |corner: Corner| corner.place[0].rem_euclid(2) == 1;
    if is_centre(a) == is_centre(b) {
        // The parity rule for two short cut edges.
        let greater = (0..3).filter(|&i| a.place[i] > outside.place[i]).count();
        return greater % 2 == 0;
    }
    // One of the cut edges is long; the diagonal ends at its cut.
    is_centre(a) != is_centre(outside)
}

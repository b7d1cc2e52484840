//! A triangulation that changes: its triangles know their neighbours, points are inserted, edges flipped.

mod insert;

use nalgebra::Vector2;
use robust::{Coord, incircle, orient2d};

use crate::Mesh;

pub use insert::Place;

/// The neighbour of a triangle across an edge of the boundary.
pub const OUTSIDE: u32 = u32::MAX;

/// Triangles in the plane, counter-clockwise, with their neighbours. An edge between two triangles is flipped unless it is constrained.
#[derive(Clone, Debug)]
pub struct Triangulation {
    pub points: Vec<Vector2<f64>>,
    pub triangles: Vec<[u32; 3]>,
    /// Neighbour across the edge opposite each corner.
    pub neighbours: Vec<[u32; 3]>,
    /// Bit `i` is set if the edge opposite corner `i` is constrained.
    pub constrained: Vec<u8>,
    /// A triangle of each vertex; [`OUTSIDE`] if it has no triangle.
    pub triangle_at: Vec<u32>,
    /// Scratch of insertions.
    stack: Vec<u32>,
}

/// The two ends of the edge opposite corner `i`, in the order of the triangle.
pub fn edge_opposite(corners: [u32; 3], i: usize) -> [u32; 2] {
    [corners[(i + 1) % 3], corners[(i + 2) % 3]]
}

impl Triangulation {
    /// Connects triangles; edges are constrained if the labels of their two triangles differ. Returns an edge of more than two triangles, or of two
    /// that are turned differently, if there is one.
    pub fn new(points: Vec<Vector2<f64>>, triangles: Vec<[u32; 3]>, labels: &[u32]) -> Result<Self, [usize; 2]> {
        let mut new = Self {
            neighbours: vec![[OUTSIDE; 3]; triangles.len()],
            constrained: vec![0; triangles.len()],
            triangle_at: vec![OUTSIDE; points.len()],
            stack: Vec::new(),
            points,
            triangles,
        };
        // Sides that leave the same vertex form a chain; side 3 t + i is opposite corner i of triangle t.
        let mut first = vec![OUTSIDE; new.points.len()];
        let mut following = vec![OUTSIDE; 3 * new.triangles.len()];
        for triangle in 0..new.triangles.len() {
            for i in 0..3 {
                let [from, to] = edge_opposite(new.triangles[triangle], i);
                new.triangle_at[from as usize] = triangle as u32;
                if new.side_between([from, to], &first, &following).is_some() {
                    return Err([from as usize, to as usize]);
                }
                if let Some((other, j)) = new.side_between([to, from], &first, &following) {
                    new.neighbours[triangle][i] = other as u32;
                    new.neighbours[other][j] = triangle as u32;
                    if labels.get(triangle) != labels.get(other) {
                        new.constrained[triangle] |= 1 << i;
                        new.constrained[other] |= 1 << j;
                    }
                }
                following[3 * triangle + i] = std::mem::replace(&mut first[from as usize], (3 * triangle + i) as u32);
            }
        }
        Ok(new)
    }

    /// The triangle that has a side in this direction, and the corner opposite it, among the chains of sides.
    fn side_between(&self, [from, to]: [u32; 2], first: &[u32], following: &[u32]) -> Option<(usize, usize)> {
        let mut side = first[from as usize];
        while side != OUTSIDE {
            let (triangle, i) = (side as usize / 3, side as usize % 3);
            if edge_opposite(self.triangles[triangle], i)[1] == to {
                return Some((triangle, i));
            }
            side = following[side as usize];
        }
        None
    }

    /// The triangles as a mesh.
    pub fn into_mesh(self) -> Mesh<2, 3> {
        let elements = self.triangles.iter().map(|triangle| triangle.map(|vertex| vertex as usize)).collect();
        Mesh::new(self.points, elements)
    }

    /// The corners of a triangle.
    pub fn corners(&self, triangle: u32) -> [Vector2<f64>; 3] {
        self.triangles[triangle as usize].map(|vertex| self.points[vertex as usize])
    }

    /// Corner of a triangle that is not on its edge with a neighbour.
    pub fn corner_beyond(&self, neighbour: u32, triangle: u32) -> usize {
        let [_, b, c] = self.neighbours[neighbour as usize];
        if b == triangle { 1 } else { 2 * usize::from(c == triangle) }
    }

    /// Returns true if flips must keep the edge opposite corner `i`.
    pub fn is_kept(&self, triangle: u32, i: usize) -> bool {
        self.neighbours[triangle as usize][i] == OUTSIDE || self.constrained[triangle as usize] >> i & 1 == 1
    }

    /// Returns true if the vertex beyond the edge opposite corner `i` lies inside the circumscribed circle, by an exact sign.
    pub fn violates_delaunay(&self, triangle: u32, i: usize) -> bool {
        let neighbour = self.neighbours[triangle as usize][i];
        let beyond = self.triangles[neighbour as usize][self.corner_beyond(neighbour, triangle)];
        let [a, b, c] = self.corners(triangle).map(coordinates);
        incircle(a, b, c, coordinates(self.points[beyond as usize])) > 0.0
    }

    /// Replaces the edge opposite corner `i` by the other diagonal of its quadrilateral, which has to be convex.
    ///
    /// Triangle `t` = (a, b, c) with its neighbour (d, c, b) across the edge b–c becomes (a, b, d), and the neighbour (a, d, c).
    pub fn flip(&mut self, triangle: u32, i: usize) {
        let neighbour = self.neighbours[triangle as usize][i];
        let j = self.corner_beyond(neighbour, triangle);
        let (t, n) = (triangle as usize, neighbour as usize);
        let [a, b, c] = [0, 1, 2].map(|k| self.triangles[t][(i + k) % 3]);
        let d = self.triangles[n][j];
        let kept = |bits: u8, i: usize| bits >> (i % 3) & 1;
        // Across c–a and a–b of the triangle, across b–d and d–c of its neighbour.
        let (ca, ab) = (self.neighbours[t][(i + 1) % 3], self.neighbours[t][(i + 2) % 3]);
        let (bd, dc) = (self.neighbours[n][(j + 1) % 3], self.neighbours[n][(j + 2) % 3]);
        let [k_ca, k_ab] = [1, 2].map(|k| kept(self.constrained[t], i + k));
        let [k_bd, k_dc] = [1, 2].map(|k| kept(self.constrained[n], j + k));
        self.triangles[t] = [a, b, d];
        self.neighbours[t] = [bd, neighbour, ab];
        self.constrained[t] = k_bd | k_ab << 2;
        self.triangles[n] = [a, d, c];
        self.neighbours[n] = [dc, ca, triangle];
        self.constrained[n] = k_dc | k_ca << 1;
        self.replace_neighbour(bd, neighbour, triangle);
        self.replace_neighbour(ca, triangle, neighbour);
        self.triangle_at[a as usize] = triangle;
        self.triangle_at[b as usize] = triangle;
        self.triangle_at[c as usize] = neighbour;
        self.triangle_at[d as usize] = triangle;
    }

    fn replace_neighbour(&mut self, of: u32, old: u32, new: u32) {
        if of != OUTSIDE
            && let Some(back) = self.neighbours[of as usize].iter_mut().find(|back| **back == old)
        {
            *back = new;
        }
    }

    /// Flips edges from these triangles on until all are Delaunay or kept: Lawson, Software for C1 Surface Interpolation (1977). Only flips
    /// that `accepts` agrees to, with the triangle and the corner opposite the edge, are made. Returns the triangles that were flipped, some more
    /// than once.
    pub fn make_delaunay(&mut self, from: Vec<u32>, accepts: impl Fn(&Self, u32, usize) -> bool) -> Vec<u32> {
        let mut is_waiting = vec![false; self.triangles.len()];
        let mut stack = from;
        stack.retain(|&triangle| !std::mem::replace(&mut is_waiting[triangle as usize], true));
        let mut flipped = Vec::new();
        while let Some(triangle) = stack.pop() {
            is_waiting[triangle as usize] = false;
            let edge = (0..3).find(|&i| {
                !self.is_kept(triangle, i) && self.violates_delaunay(triangle, i) && accepts(self, triangle, i)
            });
            if let Some(i) = edge {
                let neighbour = self.neighbours[triangle as usize][i];
                self.flip(triangle, i);
                for changed in [triangle, neighbour] {
                    flipped.push(changed);
                    if !std::mem::replace(&mut is_waiting[changed as usize], true) {
                        stack.push(changed);
                    }
                }
            }
        }
        flipped
    }

    /// Positive if the vertices a, b and the point run counter-clockwise, by an exact sign.
    pub fn side(&self, a: u32, b: u32, point: Vector2<f64>) -> f64 {
        orientation(self.points[a as usize], self.points[b as usize], point)
    }
}

/// Positive if the points run counter-clockwise, by an exact sign.
pub fn orientation(a: Vector2<f64>, b: Vector2<f64>, c: Vector2<f64>) -> f64 {
    orient2d(coordinates(a), coordinates(b), coordinates(c))
}

fn coordinates(x: Vector2<f64>) -> Coord<f64> {
    Coord { x: x.x, y: x.y }
}

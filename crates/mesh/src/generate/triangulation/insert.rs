//! Location and insertion of points, and the triangles around a vertex.

use nalgebra::Vector2;

use super::{OUTSIDE, Triangulation};

/// Location of a point, as seen from a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Place {
    /// Inside this triangle.
    In(u32),
    /// On the edge of this triangle that is opposite this corner.
    On(u32, usize),
    /// At this vertex.
    At(u32),
    /// Beyond the edge of this triangle that is opposite this corner: an edge of the boundary, or a constrained one.
    Beyond(u32, usize),
}

impl Triangulation {
    /// Walks from a triangle towards a point, up to an edge that is kept.
    pub fn locate(&self, mut triangle: u32, point: Vector2<f64>) -> Place {
        let mut from = OUTSIDE;
        'walk: loop {
            let [a, b, c] = self.triangles[triangle as usize];
            let mut sides = [0.0; 3];
            for (i, (from_vertex, to_vertex)) in [(b, c), (c, a), (a, b)].into_iter().enumerate() {
                let neighbour = self.neighbours[triangle as usize][i];
                sides[i] =
                    if neighbour == from && from != OUTSIDE { 1.0 } else { self.side(from_vertex, to_vertex, point) };
                if sides[i] < 0.0 {
                    if self.is_kept(triangle, i) {
                        return Place::Beyond(triangle, i);
                    }
                    (from, triangle) = (triangle, neighbour);
                    continue 'walk;
                }
            }
            let zeros = sides.iter().filter(|side| **side == 0.0).count();
            return match sides.iter().position(|side| *side == 0.0) {
                None => Place::In(triangle),
                Some(i) if zeros == 1 => Place::On(triangle, i),
                _ => {
                    let corner = sides.iter().position(|side| *side != 0.0).unwrap_or(0);
                    Place::At(self.triangles[triangle as usize][corner])
                }
            };
        }
    }

    /// Inserts a point inside a triangle, and flips edges until all are Delaunay again. Returns its vertex.
    pub fn insert_in(&mut self, triangle: u32, point: Vector2<f64>) -> u32 {
        let vertex = self.add_vertex(point);
        let t = triangle as usize;
        let [a, b, c] = self.triangles[t];
        let [na, nb, nc] = self.neighbours[t];
        let bits = self.constrained[t];
        let (second, third) = (self.triangles.len() as u32, self.triangles.len() as u32 + 1);
        // The vertex stands first in each of the three, so that the old edge is opposite corner 0.
        self.triangles[t] = [vertex, b, c];
        self.neighbours[t] = [na, second, third];
        self.constrained[t] = bits & 1;
        self.push([vertex, c, a], [nb, third, triangle], bits >> 1 & 1);
        self.push([vertex, a, b], [nc, triangle, second], bits >> 2 & 1);
        self.replace_neighbour(nb, triangle, second);
        self.replace_neighbour(nc, triangle, third);
        self.triangle_at[vertex as usize] = triangle;
        self.triangle_at[a as usize] = second;
        self.triangle_at[b as usize] = triangle;
        self.triangle_at[c as usize] = triangle;
        self.restore(&[triangle, second, third]);
        vertex
    }

    /// Cuts the edge opposite corner `i` of a triangle at a point, and flips edges until all are Delaunay again. Returns its vertex. The
    /// point lies on the edge, or so near that both halves of the triangles beside it stay counter-clockwise.
    pub fn insert_on(&mut self, triangle: u32, i: usize, point: Vector2<f64>) -> u32 {
        let vertex = self.add_vertex(point);
        let neighbour = self.neighbours[triangle as usize][i];
        let beyond = (neighbour != OUTSIDE).then(|| (neighbour, self.corner_beyond(neighbour, triangle)));
        // Each triangle keeps the half at its first end of the edge.
        let half = self.cut(triangle, i, vertex);
        let mut new = vec![triangle, half];
        if let Some((neighbour, j)) = beyond {
            let other = self.cut(neighbour, j, vertex);
            new.extend([neighbour, other]);
            for (near, far) in [(triangle, other), (neighbour, half)] {
                self.neighbours[near as usize][1] = far;
                self.neighbours[far as usize][2] = near;
            }
        }
        self.restore(&new);
        vertex
    }

    /// Cuts a triangle (c, a, b), with c its corner `i`, into (v, c, a) and (v, b, c), which is new.
    fn cut(&mut self, triangle: u32, i: usize, vertex: u32) -> u32 {
        let t = triangle as usize;
        let [c, a, b] = [0, 1, 2].map(|k| self.triangles[t][(i + k) % 3]);
        let [across, bc, ca] = [0, 1, 2].map(|k| self.neighbours[t][(i + k) % 3]);
        let [k_across, k_bc, k_ca] = [0, 1, 2].map(|k| self.constrained[t] >> ((i + k) % 3) & 1);
        let half = self.triangles.len() as u32;
        self.triangles[t] = [vertex, c, a];
        self.neighbours[t] = [ca, across, half];
        self.constrained[t] = k_ca | k_across << 1;
        self.push([vertex, b, c], [bc, triangle, across], k_bc | k_across << 2);
        self.replace_neighbour(bc, triangle, half);
        self.triangle_at[a as usize] = triangle;
        self.triangle_at[b as usize] = half;
        self.triangle_at[c as usize] = triangle;
        self.triangle_at[vertex as usize] = triangle;
        half
    }

    fn add_vertex(&mut self, point: Vector2<f64>) -> u32 {
        self.points.push(point);
        self.triangle_at.push(OUTSIDE);
        self.points.len() as u32 - 1
    }

    fn push(&mut self, corners: [u32; 3], neighbours: [u32; 3], constrained: u8) {
        self.triangles.push(corners);
        self.neighbours.push(neighbours);
        self.constrained.push(constrained);
    }

    /// Flips edges opposite the new vertex, which is the first corner of these triangles, until all are Delaunay.
    fn restore(&mut self, triangles: &[u32]) {
        let mut stack = std::mem::take(&mut self.stack);
        stack.extend(triangles);
        while let Some(triangle) = stack.pop() {
            if !self.is_kept(triangle, 0) && self.violates_delaunay(triangle, 0) {
                let neighbour = self.neighbours[triangle as usize][0];
                self.flip(triangle, 0);
                stack.extend([triangle, neighbour]);
            }
        }
        self.stack = stack;
    }

    /// Collects the triangles around a vertex with the vertex's corner in each, counter-clockwise. Returns whether they close, as they do
    /// inside; on the boundary they run from its edge that leaves the vertex to the one that arrives.
    pub fn star(&self, vertex: u32, star: &mut Vec<(u32, usize)>) -> bool {
        star.clear();
        let start = self.triangle_at[vertex as usize];
        if start == OUTSIDE {
            return false;
        }
        if self.turn(vertex, start, star) {
            return true;
        }
        // Clockwise to the first triangle.
        let mut first = start;
        loop {
            let i = self.corner_of(vertex, first);
            // The edge that leaves the vertex is opposite the corner before it.
            let before = self.neighbours[first as usize][(i + 2) % 3];
            if before == OUTSIDE {
                break;
            }
            first = before;
        }
        if first != start {
            star.clear();
            self.turn(vertex, first, star);
        }
        false
    }

    /// Collects the triangles around a vertex counter-clockwise from one on. Returns whether they close.
    fn turn(&self, vertex: u32, first: u32, star: &mut Vec<(u32, usize)>) -> bool {
        let mut triangle = first;
        loop {
            let i = self.corner_of(vertex, triangle);
            star.push((triangle, i));
            triangle = self.neighbours[triangle as usize][(i + 1) % 3];
            if triangle == OUTSIDE || triangle == first {
                return triangle == first;
            }
        }
    }

    fn corner_of(&self, vertex: u32, triangle: u32) -> usize {
        let [_, b, c] = self.triangles[triangle as usize];
        if c == vertex { 2 } else { usize::from(b == vertex) }
    }
}

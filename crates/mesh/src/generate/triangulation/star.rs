//! The triangles around a vertex.

use super::{OUTSIDE, Triangulation};

impl Triangulation {
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

//! Delaunay refinement: points are added until triangles are small and well-shaped.
//!
//! Points lie on the perpendicular bisector of an edge of the front, at the height of an equilateral triangle of the wanted size or at the
//! circumcentre, whichever is nearer: Rebay, Efficient Unstructured Mesh Generation by Means of Delaunay Triangulation and Bowyer–Watson
//! Algorithm (1993). A point beyond the boundary cuts the edge of the boundary that hides it: Chew, Guaranteed-Quality Mesh Generation for
//! Curved Surfaces (1993).

use std::collections::VecDeque;

use nalgebra::Vector2;

use crate::generate::outline::Outline;
use crate::generate::triangulation::{OUTSIDE, Place, Triangulation, edge_opposite};

/// Circumradius that is accepted, over that of an equilateral triangle of the wanted size.
const LARGEST_RADIUS: f64 = 1.35;

/// Bounds of a refinement.
#[derive(Clone, Copy, Debug)]
pub struct Bounds {
    /// Largest circumradius over shortest edge. Above 1, as for angles of 30°, refinement ends in practice; proven is √2.
    pub radius_to_edge: f64,
    /// Length of an edge of the boundary that is not cut any more, m.
    pub shortest_cut: f64,
    /// Largest number of vertices.
    pub most_vertices: usize,
}

struct Refinement<'a, S> {
    mesh: &'a mut Triangulation,
    outline: &'a mut Outline,
    size: S,
    bounds: Bounds,
    /// Triangles that are small and well-shaped, or cannot be improved.
    is_done: Vec<bool>,
    is_queued: Vec<bool>,
    queue: VecDeque<u32>,
    star: Vec<(u32, usize)>,
}

/// Adds points until every triangle has about the edges that `size` gives for its centroid, and the bounds hold wherever they can.
pub fn refine(mesh: &mut Triangulation, outline: &mut Outline, size: impl Fn(Vector2<f64>) -> f64, bounds: Bounds) {
    let triangles = mesh.triangles.len();
    let (is_done, is_queued) = (vec![false; triangles], vec![false; triangles]);
    let mut refinement =
        Refinement { mesh, outline, size, bounds, is_done, is_queued, queue: VecDeque::new(), star: Vec::new() };
    for triangle in 0..triangles as u32 {
        refinement.is_done[triangle as usize] = refinement.is_fine(triangle);
    }
    (0..triangles as u32).for_each(|triangle| refinement.enqueue(triangle));
    while let Some(triangle) = refinement.queue.pop_front() {
        refinement.is_queued[triangle as usize] = false;
        if !refinement.is_done[triangle as usize] && refinement.mesh.points.len() < bounds.most_vertices {
            refinement.treat(triangle);
        }
    }
}

impl<S: Fn(Vector2<f64>) -> f64> Refinement<'_, S> {
    /// Returns true if a triangle is small enough and well-shaped.
    fn is_fine(&self, triangle: u32) -> bool {
        let [a, b, c] = self.mesh.corners(triangle);
        let squares = [(c - b).norm_squared(), (a - c).norm_squared(), (b - a).norm_squared()];
        let shortest = squares[0].min(squares[1]).min(squares[2]);
        let twice_area = (b - a).perp(&(c - a));
        let radius = squares[0] * squares[1] * squares[2] / (4.0 * twice_area * twice_area);
        let size = (self.size)((a + b + c) / 3.0) * LARGEST_RADIUS;
        3.0 * radius <= size * size && radius <= shortest * self.bounds.radius_to_edge * self.bounds.radius_to_edge
    }

    fn enqueue(&mut self, triangle: u32) {
        let t = triangle as usize;
        if !self.is_done[t] && !self.is_queued[t] && self.front_edge(triangle).is_some() {
            self.is_queued[t] = true;
            self.queue.push_back(triangle);
        }
    }

    /// The shortest edge of a triangle on the boundary or beside a triangle that is done.
    fn front_edge(&self, triangle: u32) -> Option<usize> {
        let corners = self.mesh.corners(triangle);
        let length = |i: usize| (corners[(i + 1) % 3] - corners[(i + 2) % 3]).norm_squared();
        let is_front = |i: &usize| match self.mesh.neighbours[triangle as usize][*i] {
            OUTSIDE => true,
            neighbour => self.is_done[neighbour as usize],
        };
        (0..3).filter(is_front).min_by(|&i, &j| length(i).total_cmp(&length(j)))
    }

    /// Adds a point for a triangle, or marks it as done if no point improves it.
    fn treat(&mut self, triangle: u32) {
        let Some(edge) = self.front_edge(triangle) else { return };
        let point = self.new_point(triangle, edge);
        let vertex = match self.mesh.locate(triangle, point) {
            Place::In(place) => Some(self.mesh.insert_in(place, point)),
            Place::On(place, i) if !self.mesh.is_kept(place, i) => Some(self.mesh.insert_on(place, i, point)),
            Place::On(place, i) | Place::Beyond(place, i) => self.cut(place, i),
            Place::At(_) => None,
        };
        let triangles = self.mesh.triangles.len();
        self.is_done.resize(triangles, false);
        self.is_queued.resize(triangles, false);
        match vertex {
            Some(vertex) => self.judge_around(vertex),
            None => self.give_up(triangle),
        }
    }

    fn judge_around(&mut self, vertex: u32) {
        let mut star = std::mem::take(&mut self.star);
        self.mesh.star(vertex, &mut star);
        for &(triangle, _) in &star {
            self.is_done[triangle as usize] = self.is_fine(triangle);
        }
        for &(triangle, corner) in &star {
            self.enqueue(triangle);
            let beyond = self.mesh.neighbours[triangle as usize][corner];
            if beyond != OUTSIDE {
                self.enqueue(beyond);
            }
        }
        self.star = star;
    }

    fn give_up(&mut self, triangle: u32) {
        self.is_done[triangle as usize] = true;
        for neighbour in self.mesh.neighbours[triangle as usize] {
            if neighbour != OUTSIDE {
                self.enqueue(neighbour);
            }
        }
    }

    fn new_point(&self, triangle: u32, edge: usize) -> Vector2<f64> {
        let corners = self.mesh.corners(triangle);
        let [from, to, apex] = [1, 2, 0].map(|k| corners[(edge + k) % 3]);
        let middle = 0.5 * (from + to);
        let side = to - from;
        let length = side.norm();
        let inward = Vector2::new(-side.y, side.x) / length;
        // With the origin in the middle, the circumcentre is at the height (|apex|² − (length/2)²) / (2 height of the apex).
        let (half, apex) = (0.5 * length, apex - middle);
        let centre = (apex.norm_squared() - half * half) / (2.0 * apex.dot(&inward));
        if centre <= half {
            return middle + inward * centre;
        }
        let wanted = (self.size)(middle + inward * half) / 3.0_f64.sqrt();
        let radius = wanted.max(half).min((half * half + centre * centre) / (2.0 * centre));
        middle + inward * (radius + (radius * radius - half * half).max(0.0).sqrt()).min(centre)
    }

    /// Cuts an edge of the boundary in the middle of its curve, unless it is short or a triangle would be turned.
    fn cut(&mut self, triangle: u32, i: usize) -> Option<u32> {
        if self.mesh.neighbours[triangle as usize][i] != OUTSIDE {
            return None;
        }
        let [from, to] = edge_opposite(self.mesh.triangles[triangle as usize], i);
        let (a, b) = (self.mesh.points[from as usize], self.mesh.points[to as usize]);
        if (b - a).norm() < self.bounds.shortest_cut.max(0.5 * (self.size)(0.5 * (a + b))) {
            return None;
        }
        cut_boundary(self.mesh, self.outline, triangle, i)
    }
}

/// Cuts an edge of the boundary in the middle of its curve. Returns the vertex, unless a triangle would be turned.
fn cut_boundary(mesh: &mut Triangulation, outline: &mut Outline, triangle: u32, i: usize) -> Option<u32> {
    let corners = mesh.triangles[triangle as usize];
    let [from, to] = edge_opposite(corners, i);
    let apex = corners[i];
    let (point, place) = outline.between(from, to)?;
    if !(mesh.side(apex, from, point) > 0.0 && mesh.side(to, apex, point) > 0.0) {
        return None;
    }
    let vertex = mesh.insert_on(triangle, i, point);
    outline.set(vertex, place);
    Some(vertex)
}

/// Cuts edges of the boundary that their triangle sees under an obtuse angle, down to a length (m): Ruppert, A Delaunay Refinement Algorithm
/// for Quality 2-Dimensional Mesh Generation (1995). Returns the points with the length of the edges beside them.
pub fn cut_encroached(mesh: &mut Triangulation, outline: &mut Outline, shortest: f64) -> Vec<(Vector2<f64>, f64)> {
    let mut cuts = Vec::new();
    let mut queue: Vec<u32> = (0..mesh.triangles.len() as u32).collect();
    let mut star = Vec::new();
    while let Some(triangle) = queue.pop() {
        for i in 0..3 {
            if mesh.neighbours[triangle as usize][i] != OUTSIDE {
                continue;
            }
            let corners = mesh.corners(triangle);
            let (to_from, to_to) = (corners[(i + 1) % 3] - corners[i], corners[(i + 2) % 3] - corners[i]);
            let is_long = (to_from - to_to).norm() >= 2.0 * shortest;
            if is_long
                && to_from.dot(&to_to) < 0.0
                && let Some(vertex) = cut_boundary(mesh, outline, triangle, i)
            {
                mesh.star(vertex, &mut star);
                queue.extend(star.iter().map(|(triangle, _)| triangle));
                cuts.push((mesh.points[vertex as usize], 0.5 * (to_from - to_to).norm()));
                break;
            }
        }
    }
    cuts
}

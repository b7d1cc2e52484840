//! The solid inside a surface: which points lie in it, and where a line leaves it. The surface may have holes, cross itself, or have triangles
//! that are turned the wrong way.

use std::f64::consts::PI;

mod triangle;

use nalgebra::Vector3;

use crate::{SurfaceMesh, area_vector, oriented};
use triangle::{closest_of_triangle, crossing, solid_angle};

/// Triangles of a leaf of the tree.
const LEAF: usize = 4;

/// Distance over radius beyond which a part of the surface acts as a dipole.
const FAR: f64 = 2.3;

/// A tree of bounding volumes over the triangles of a surface.
///
/// A point is inside if the generalized winding number exceeds ½: Jacobson, Kavan and Sorkine-Hornung, Robust Inside-Outside Segmentation using
/// Generalized Winding Numbers (2013); far parts of the surface by dipoles, Barill, Dickson, Schmidt, Levin and Jacobson, Fast Winding Numbers
/// for Soups and Clouds (2018).
pub struct Solid {
    /// Corners of the triangles, m, in the order of the tree, counter-clockwise from outside.
    triangles: Vec<[Vector3<f64>; 3]>,
    nodes: Vec<Node>,
}

/// A part of the surface.
struct Node {
    least: Vector3<f64>,
    largest: Vector3<f64>,
    /// Centre of the area, m, the largest distance of a corner from it, m, and the sum of the area vectors, m².
    centre: Vector3<f64>,
    radius: f64,
    area: Vector3<f64>,
    /// The triangles of the part.
    first: usize,
    end: usize,
    /// The second of its two parts; the first follows it. Zero for a leaf.
    second: usize,
}

impl Solid {
    /// Turns the triangles of a surface alike ([`oriented`]), and outwards if it encloses a negative volume, and sorts them.
    pub fn new(surface: &SurfaceMesh) -> Self {
        let surface = oriented(surface);
        let corners = |element: &[usize; 3]| element.map(|i| surface.vertices[i]);
        let mut triangles: Vec<_> = surface.elements.iter().map(corners).collect();
        let origin = triangles.first().map_or(Vector3::zeros(), |triangle| triangle[0]);
        let volume = |[a, b, c]: &[Vector3<f64>; 3]| (a - origin).dot(&(b - origin).cross(&(c - origin)));
        if triangles.iter().map(volume).sum::<f64>() < 0.0 {
            triangles.iter_mut().for_each(|triangle| triangle.swap(1, 2));
        }
        let mut nodes = Vec::new();
        if !triangles.is_empty() {
            let count = triangles.len();
            build(&mut triangles, 0, count, &mut nodes);
        }
        Self { triangles, nodes }
    }

    /// The smallest and the largest coordinates, m; zero for no triangles.
    pub fn bounds(&self) -> [Vector3<f64>; 2] {
        self.nodes.first().map_or([Vector3::zeros(); 2], |node| [node.least, node.largest])
    }

    /// Returns true if a point lies inside.
    pub fn contains(&self, point: &Vector3<f64>) -> bool {
        self.nodes.first().is_some_and(|root| is_in_box(root, point)) && self.winding_number(point) > 0.5
    }

    /// Winding number of the surface around a point: 1 inside and 0 outside of a closed surface.
    pub fn winding_number(&self, point: &Vector3<f64>) -> f64 {
        let (mut sum, mut open) = (0.0, vec![0]);
        while let Some(at) = open.pop() {
            let Some(node) = self.nodes.get(at) else { continue };
            let away = node.centre - point;
            let distance = away.norm();
            if distance > FAR * node.radius {
                sum += node.area.dot(&away) / distance.powi(3);
            } else if node.second == 0 {
                sum +=
                    self.triangles[node.first..node.end].iter().map(|corners| solid_angle(corners, point)).sum::<f64>();
            } else {
                open.extend([at + 1, node.second]);
            }
        }
        sum / (4.0 * PI)
    }

    /// The point of the surface closest to a point, m; `None` for a surface without triangles.
    pub fn closest(&self, point: &Vector3<f64>) -> Option<Vector3<f64>> {
        let (mut best, mut least, mut open) = (None, f64::INFINITY, vec![(0.0, 0)]);
        while let Some((distance, at)) = open.pop() {
            let Some(node) = self.nodes.get(at).filter(|_| distance < least) else { continue };
            if node.second == 0 {
                for corners in &self.triangles[node.first..node.end] {
                    let place = closest_of_triangle(corners, point);
                    let distance = (place - point).norm_squared();
                    if distance < least {
                        (best, least) = (Some(place), distance);
                    }
                }
                continue;
            }
            let mut parts = [at + 1, node.second].map(|part| (distance_to_box(&self.nodes[part], point), part));
            parts.sort_by(|a, b| b.0.total_cmp(&a.0));
            open.extend(parts); // the closer part is looked at first
        }
        best
    }

    /// The place on the way from a point inside to a point outside where it leaves the solid, as a part of the way.
    pub fn exit(&self, inside: &Vector3<f64>, outside: &Vector3<f64>) -> f64 {
        let way = outside - inside;
        let mut crossings = self.crossings(inside, &way);
        crossings.dedup_by(|b, a| *b - *a < 1e-9);
        if crossings.len() == 1 {
            return crossings[0];
        }
        // Between crossings a point is inside or outside as a whole, unless the surface has a hole there.
        let mut before = 0.0;
        for k in 0..crossings.len() {
            let next = crossings.get(k + 1).copied().unwrap_or(1.0);
            let middle = 0.5 * (crossings[k] + next);
            if !self.contains(&(inside + middle * way)) {
                return match self.contains(&(inside + (0.5 * (before + crossings[k])) * way)) {
                    true => crossings[k],
                    false => self.bisect(inside, &way, before, middle),
                };
            }
            before = middle;
        }
        self.bisect(inside, &way, before, 1.0)
    }

    /// Halves the part of a way that begins inside and ends outside.
    fn bisect(&self, from: &Vector3<f64>, way: &Vector3<f64>, mut inside: f64, mut outside: f64) -> f64 {
        for _ in 0..30 {
            let middle = 0.5 * (inside + outside);
            match self.contains(&(from + middle * way)) {
                true => inside = middle,
                false => outside = middle,
            }
        }
        0.5 * (inside + outside)
    }

    /// Places where a way crosses triangles, as parts of it, ascending.
    fn crossings(&self, from: &Vector3<f64>, way: &Vector3<f64>) -> Vec<f64> {
        let (mut found, mut open) = (Vec::new(), vec![0]);
        while let Some(at) = open.pop() {
            let Some(node) = self.nodes.get(at).filter(|node| meets_box(node, from, way)) else { continue };
            if node.second == 0 {
                let triangles = &self.triangles[node.first..node.end];
                found.extend(triangles.iter().filter_map(|corners| crossing(corners, from, way)));
            } else {
                open.extend([at + 1, node.second]);
            }
        }
        found.sort_by(f64::total_cmp);
        found
    }
}

/// Adds the node of some triangles and those below it; parts them at the median along the longest side.
fn build(triangles: &mut [[Vector3<f64>; 3]], first: usize, end: usize, nodes: &mut Vec<Node>) {
    let here = nodes.len();
    nodes.push(measure(&triangles[first..end], first, end));
    if end - first <= LEAF {
        return;
    }
    let size = nodes[here].largest - nodes[here].least;
    let axis = size.imax();
    let middle = (first + end) / 2;
    let place = |triangle: &[Vector3<f64>; 3]| triangle.iter().map(|corner| corner[axis]).sum::<f64>();
    triangles[first..end].select_nth_unstable_by(middle - first, |a, b| place(a).total_cmp(&place(b)));
    build(triangles, first, middle, nodes);
    nodes[here].second = nodes.len();
    build(triangles, middle, end, nodes);
}

fn measure(triangles: &[[Vector3<f64>; 3]], first: usize, end: usize) -> Node {
    let corners = || triangles.iter().flatten();
    let least = corners().fold(Vector3::repeat(f64::INFINITY), |least, x| least.inf(x));
    let largest = corners().fold(Vector3::repeat(f64::NEG_INFINITY), |largest, x| largest.sup(x));
    let (mut area, mut sum, mut weights) = (Vector3::zeros(), Vector3::zeros(), 0.0);
    for triangle in triangles {
        let vector = area_vector(*triangle);
        let weight = vector.norm();
        area += vector;
        sum += (triangle[0] + triangle[1] + triangle[2]) * (weight / 3.0);
        weights += weight;
    }
    let centre = if weights > 0.0 { sum / weights } else { 0.5 * (least + largest) };
    let radius = corners().map(|x| (x - centre).norm()).fold(0.0, f64::max);
    Node { least, largest, centre, radius, area, first, end, second: 0 }
}

fn is_in_box(node: &Node, point: &Vector3<f64>) -> bool {
    (0..3).all(|i| node.least[i] <= point[i] && point[i] <= node.largest[i])
}

/// Squared distance of a point from the box of a node, m².
fn distance_to_box(node: &Node, point: &Vector3<f64>) -> f64 {
    (point - point.sup(&node.least).inf(&node.largest)).norm_squared()
}

fn meets_box(node: &Node, from: &Vector3<f64>, way: &Vector3<f64>) -> bool {
    let (mut enter, mut leave) = (0.0_f64, 1.0_f64);
    for i in 0..3 {
        if way[i] == 0.0 {
            if from[i] < node.least[i] || from[i] > node.largest[i] {
                return false;
            }
            continue;
        }
        let (a, b) = ((node.least[i] - from[i]) / way[i], (node.largest[i] - from[i]) / way[i]);
        (enter, leave) = (enter.max(a.min(b)), leave.min(a.max(b)));
    }
    // A little more than the box, so that rounding misses no triangle in its sides.
    enter <= leave + 1e-9
}

//! Paths along the edges of a mesh's boundary that follow feature curves.

use std::cmp::Reverse;
use std::collections::{BTreeMap, BTreeSet, BinaryHeap};

use nalgebra::Vector3;

use super::lines::Curve;
use crate::connectivity::bits;

/// Weight of the distance from the curve, squared and over the mean edge squared, in the length of a path.
const DISTANCE_WEIGHT: f64 = 8.0;

/// Largest distance of a path and of its ends from the curve, over the mean edge.
const REACH: f64 = 1.6;

/// The vertices of a path and their places on the curve, from its first to its last point.
pub struct Path {
    /// Number of the curve.
    pub curve: usize,
    /// Vertices of the mesh, at least two.
    pub vertices: Vec<u32>,
    /// Part of the curve's length at which each vertex shall lie.
    pub places: Vec<f64>,
}

/// The boundary of a mesh as a graph.
pub struct Graph<'a> {
    /// m
    pub positions: &'a [Vector3<f64>],
    /// Vertices at the other ends of a vertex's edges on the boundary.
    pub neighbours: BTreeMap<u32, BTreeSet<u32>>,
    /// Mean edge, m.
    pub edge: f64,
}

impl<'a> Graph<'a> {
    /// The edges of some faces.
    pub fn new(positions: &'a [Vector3<f64>], faces: &[[usize; 3]], edge: f64) -> Self {
        let mut neighbours: BTreeMap<u32, BTreeSet<u32>> = BTreeMap::new();
        for &[a, b, c] in faces {
            for (i, j) in [(a, b), (b, c), (c, a)] {
                neighbours.entry(i as u32).or_default().insert(j as u32);
                neighbours.entry(j as u32).or_default().insert(i as u32);
            }
        }
        Self { positions, neighbours, edge }
    }

    /// A path for each curve that has one. Curves share the vertices of their common ends alone.
    pub fn paths(&self, curves: &[Curve]) -> Vec<Path> {
        let mut ends: BTreeMap<[u64; 3], Option<u32>> = BTreeMap::new();
        let mut used = BTreeSet::new();
        for end in curves.iter().flat_map(Curve::ends) {
            if let std::collections::btree_map::Entry::Vacant(vacant) = ends.entry(bits(&end)) {
                let vertex = self.closest_vertex(&end, &used);
                used.extend(vertex);
                vacant.insert(vertex);
            }
        }
        let mut paths = Vec::new();
        for (number, curve) in curves.iter().enumerate() {
            let [from, to] = curve.ends().map(|end| ends[&bits(&end)]);
            let (Some(from), Some(to)) = (from, to) else { continue };
            let Some(vertices) = self.path(curve, from, to, &used) else { continue };
            used.extend(&vertices);
            let places = self.places(&vertices);
            paths.push(Path { curve: number, vertices, places });
        }
        paths
    }

    fn position(&self, vertex: u32) -> Vector3<f64> {
        self.positions[vertex as usize]
    }

    fn closest_vertex(&self, point: &Vector3<f64>, used: &BTreeSet<u32>) -> Option<u32> {
        let free = self.neighbours.keys().copied().filter(|vertex| !used.contains(vertex));
        let distances = free.map(|vertex| ((self.position(vertex) - point).norm(), vertex));
        let closest = distances.min_by(|a, b| a.0.total_cmp(&b.0));
        closest.filter(|&(distance, _)| distance < REACH * self.edge).map(|(_, vertex)| vertex)
    }

    /// The shortest path by Dijkstra's algorithm (1959), with lengths that grow with the distance from the curve.
    fn path(&self, curve: &Curve, from: u32, to: u32, used: &BTreeSet<u32>) -> Option<Vec<u32>> {
        if from == to {
            return None;
        }
        let mut before: BTreeMap<u32, (f64, u32)> = BTreeMap::from([(from, (0.0, from))]);
        // The bits of lengths are in the order of the lengths.
        let mut open = BinaryHeap::from([Reverse((0.0_f64.to_bits(), from))]);
        while let Some(Reverse((bits, vertex))) = open.pop() {
            let length = f64::from_bits(bits);
            if vertex == to {
                break;
            }
            if length > before[&vertex].0 {
                continue;
            }
            for &next in &self.neighbours[&vertex] {
                if next != to && used.contains(&next) {
                    continue;
                }
                let [a, b] = [self.position(vertex), self.position(next)];
                let off = [b, 0.5 * (a + b)].map(|x| ((curve.closest(&x) - x).norm() / self.edge).powi(2));
                if off[0] > REACH * REACH {
                    continue;
                }
                let new = length + (b - a).norm() * (1.0 + DISTANCE_WEIGHT * (off[0] + off[1]));
                if before.get(&next).is_none_or(|known| new < known.0) {
                    before.insert(next, (new, vertex));
                    open.push(Reverse((new.to_bits(), next)));
                }
            }
        }
        let mut path = vec![to];
        while path[path.len() - 1] != from {
            path.push(before.get(&path[path.len() - 1])?.1);
        }
        path.reverse();
        Some(self.without_detours(path))
    }

    /// Leaves out vertices between two that have a common edge: the three would lie on one line.
    fn without_detours(&self, path: Vec<u32>) -> Vec<u32> {
        let (mut short, mut at) = (vec![path[0]], 0);
        while at + 1 < path.len() {
            let neighbours = &self.neighbours[&path[at]];
            let reachable = (at + 1..path.len().min(at + 4)).rev();
            at = reachable.into_iter().find(|&next| neighbours.contains(&path[next])).unwrap_or(at + 1);
            short.push(path[at]);
        }
        short
    }

    /// Places along the curve in proportion to the length of the path.
    fn places(&self, vertices: &[u32]) -> Vec<f64> {
        let mut lengths = vec![0.0];
        for pair in vertices.windows(2) {
            let step = (self.position(pair[1]) - self.position(pair[0])).norm();
            lengths.push(lengths[lengths.len() - 1] + step);
        }
        let whole = lengths[lengths.len() - 1];
        lengths.into_iter().map(|length| length / whole).collect()
    }
}

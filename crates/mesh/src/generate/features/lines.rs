//! Feature lines of a surface: its sharp edges as curves between corners, and the smooth patches between them.

use std::collections::{BTreeMap, HashMap, HashSet};

use nalgebra::Vector3;

use crate::connectivity::{first_at_each_place, groups, sides_by_edge, sorted};
use crate::generate::Solid;
use crate::{SurfaceMesh, area_vector};

/// Points of a curve into which a closed one is parted.
const PARTS_OF_LOOP: usize = 3;

/// A curve along sharp edges, from one point to another that are corners or parts of a closed curve.
pub struct Curve {
    /// m
    points: Vec<Vector3<f64>>,
    /// Length from the first point, m.
    lengths: Vec<f64>,
    /// Its pieces, for the closest point.
    pieces: Solid,
}

impl Curve {
    fn new(points: Vec<Vector3<f64>>) -> Self {
        let mut lengths = vec![0.0];
        for pair in points.windows(2) {
            lengths.push(lengths[lengths.len() - 1] + (pair[1] - pair[0]).norm());
        }
        // A piece is a triangle without area.
        let elements = (1..points.len()).map(|i| [i - 1, i, i]).collect();
        let pieces = Solid::new(&SurfaceMesh::new(points.clone(), elements));
        Self { points, lengths, pieces }
    }

    /// m
    pub fn length(&self) -> f64 {
        self.lengths[self.lengths.len() - 1]
    }

    /// First and last point, m.
    pub fn ends(&self) -> [Vector3<f64>; 2] {
        [self.points[0], self.points[self.points.len() - 1]]
    }

    /// The point at a part of the length, m.
    pub fn at(&self, part: f64) -> Vector3<f64> {
        let length = part.clamp(0.0, 1.0) * self.length();
        let next = self.lengths.partition_point(|&x| x < length).clamp(1, self.points.len() - 1);
        let [before, after] = [self.lengths[next - 1], self.lengths[next]];
        let within = if after > before { (length - before) / (after - before) } else { 0.0 };
        self.points[next - 1] + (self.points[next] - self.points[next - 1]) * within.min(1.0)
    }

    /// The closest point of the curve, m.
    pub fn closest(&self, point: &Vector3<f64>) -> Vector3<f64> {
        self.pieces.closest(point).unwrap_or(self.points[0])
    }
}

/// The feature lines of a surface.
pub struct Features {
    /// The curves; two that meet share an end point to the last bit.
    pub curves: Vec<Curve>,
    /// The smooth parts of the surface.
    pub patches: Vec<Solid>,
}

impl Features {
    /// Finds the edges whose triangles' normals differ by more than an angle, degrees. A vertex where other than two of them meet, or
    /// where the line turns by more than the angle, is a corner. Lines below a length, m, count if they join others alone.
    pub fn new(surface: &SurfaceMesh, angle: f64, shortest: f64) -> Self {
        let least = angle.to_radians().cos();
        // A file of loose triangles repeats its vertices.
        let vertices = first_at_each_place(&surface.vertices);
        let elements: Vec<[usize; 3]> = surface.elements.iter().map(|e| e.map(|i| vertices[i])).collect();
        let normals: Vec<Vector3<f64>> = elements
            .iter()
            .map(|e| area_vector(e.map(|i| surface.vertices[i])).try_normalize(0.0).unwrap_or_default())
            .collect();
        let sides = sides_by_edge(&elements);
        let edges = || sides.chunk_by(|a, b| a.0 == b.0);
        let is_sharp = |edge: &&[([usize; 2], usize)]| match **edge {
            [(_, a), (_, b)] => normals[a / 3].dot(&normals[b / 3]) < least,
            _ => true,
        };
        let sharp: Vec<[usize; 2]> = edges().filter(is_sharp).map(|edge| edge[0].0).collect();
        let mut lines = lines(&surface.vertices, &sharp, least);
        leave_out_short(&mut lines, &surface.vertices, shortest);
        let kept: HashSet<[usize; 2]> =
            lines.iter().flat_map(|line| line.windows(2)).map(|pair| sorted([pair[0], pair[1]])).collect();
        let smooth = sides.windows(2).filter(|pair| pair[0].0 == pair[1].0 && !kept.contains(&pair[0].0));
        let patches = groups(elements.len(), smooth.map(|pair| [pair[0].1 / 3, pair[1].1 / 3]))
            .into_iter()
            .map(|part| part.into_iter().map(|triangle| elements[triangle]).collect())
            .map(|part| Solid::new(&SurfaceMesh::new(surface.vertices.clone(), part)))
            .collect();
        let points = |line: Vec<usize>| line.into_iter().map(|i| surface.vertices[i]).collect();
        Self { curves: lines.into_iter().flat_map(|line| parted(points(line))).collect(), patches }
    }
}

/// Leaves out lines shorter than a length, m, which end in a smooth part or are closed: noise, or smaller than the elements.
fn leave_out_short(lines: &mut Vec<Vec<usize>>, vertices: &[Vector3<f64>], shortest: f64) {
    loop {
        let mut ends: HashMap<usize, usize> = HashMap::new();
        lines
            .iter()
            .flat_map(|line| [line[0], line[line.len() - 1]])
            .for_each(|end| *ends.entry(end).or_default() += 1);
        let length =
            |line: &[usize]| line.windows(2).map(|pair| (vertices[pair[1]] - vertices[pair[0]]).norm()).sum::<f64>();
        let is_closed = |line: &[usize]| line[0] == line[line.len() - 1];
        let is_loose = |line: &[usize]| [line[0], line[line.len() - 1]].iter().any(|end| ends[end] < 2);
        let before = lines.len();
        lines.retain(|line| length(line) >= shortest || !(is_closed(line) || is_loose(line)));
        if lines.len() == before {
            return;
        }
    }
}

/// Joins sharp edges to lines from corner to corner, and to closed lines.
fn lines(vertices: &[Vector3<f64>], sharp: &[[usize; 2]], least: f64) -> Vec<Vec<usize>> {
    let mut at: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    for &[a, b] in sharp {
        at.entry(a).or_default().push(b);
        at.entry(b).or_default().push(a);
    }
    let is_corner = |vertex: usize| match at[&vertex][..] {
        [a, b] => {
            let [u, v] = [vertices[vertex] - vertices[a], vertices[b] - vertices[vertex]];
            u.dot(&v) < least * u.norm() * v.norm()
        }
        _ => true,
    };
    let follow = |from: usize, to: usize| {
        let mut line = vec![from, to];
        while line[0] != line[line.len() - 1] && !is_corner(line[line.len() - 1]) {
            let [before, here] = [line[line.len() - 2], line[line.len() - 1]];
            let Some(&next) = at[&here].iter().find(|&&next| next != before) else { break };
            line.push(next);
        }
        line
    };
    let (mut lines, mut begun) = (Vec::new(), HashSet::new());
    let corners = at.keys().copied().filter(|&vertex| is_corner(vertex));
    for (vertex, next) in corners.flat_map(|vertex| at[&vertex].iter().map(move |&next| (vertex, next))) {
        if begun.insert([vertex, next]) {
            let line = follow(vertex, next);
            begun.insert([line[line.len() - 1], line[line.len() - 2]]);
            lines.push(line);
        }
    }
    let mut done: HashSet<usize> = lines.iter().flatten().copied().collect();
    for &[a, b] in sharp {
        if done.insert(a) && !is_corner(a) {
            let line = follow(a, b);
            done.extend(&line);
            lines.push(line);
        }
    }
    lines
}

/// An open curve as it is, and a closed one in parts.
fn parted(points: Vec<Vector3<f64>>) -> Vec<Curve> {
    let whole = points.len();
    if points[0] != points[whole - 1] || whole <= PARTS_OF_LOOP {
        return vec![Curve::new(points)];
    }
    let cut = |part: usize| part * (whole - 1) / PARTS_OF_LOOP;
    (0..PARTS_OF_LOOP).map(|part| Curve::new(points[cut(part)..=cut(part + 1)].to_vec())).collect()
}

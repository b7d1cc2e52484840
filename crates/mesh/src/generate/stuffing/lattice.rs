//! The body-centred cubic lattice: corners and centres of cubes.

use std::collections::HashMap;

use nalgebra::Vector3;

/// Places of nodes in half sides of a cube: all three even for a corner, all three odd for a centre.
pub type Place = [i32; 3];

/// Part of a long and of a short edge within which a node is moved to a cut: Labelle and Shewchuk (2007), table 1.
const TOO_CLOSE: [f64; 2] = [0.24999, 0.41189];

/// The lattice, with the side of the surface on which each node lies, and the cuts of its edges.
pub struct Lattice {
    origin: Vector3<f64>,
    half: f64,
    /// Number of cubes in each direction.
    cubes: [i32; 3],
    /// 1 inside, −1 outside, 0 on the surface.
    pub signs: Vec<i8>,
    /// True for each node that has an edge cut by the surface.
    is_at_cut: Vec<bool>,
    /// Nodes that have been moved onto the surface.
    moved: HashMap<u32, Vector3<f64>>,
    /// Intersection of the surface with each edge from a node inside to a node outside, m.
    cuts: HashMap<[u32; 2], Vector3<f64>>,
}

impl Lattice {
    /// A lattice around a box, with a cube to spare on each side.
    pub fn around([least, largest]: [Vector3<f64>; 2], side: f64) -> Self {
        let size = largest - least;
        let cubes: [i32; 3] = std::array::from_fn(|i| (size[i] / side).ceil() as i32 + 2);
        // The box lies in the middle.
        let origin = Vector3::from_fn(|i, _| 0.5 * (least[i] + largest[i]) - 0.5 * side * f64::from(cubes[i]));
        let [x, y, z] = cubes.map(|cubes| cubes as usize);
        let nodes = (x + 1) * (y + 1) * (z + 1) + x * y * z;
        Self {
            origin,
            half: 0.5 * side,
            cubes,
            signs: vec![-1; nodes],
            is_at_cut: vec![false; nodes],
            moved: HashMap::new(),
            cuts: HashMap::new(),
        }
    }

    /// Number of cubes in each direction.
    pub fn cubes(&self) -> [i32; 3] {
        self.cubes
    }

    /// Moves all nodes back and forgets the cuts.
    pub fn reset(&mut self) {
        self.moved.clear();
        self.cuts.clear();
    }

    /// The node at a place, if the lattice has one there.
    pub fn node(&self, place: Place) -> Option<u32> {
        let [nx, ny, nz] = self.cubes;
        let [i, j, k] = place.map(|x| x.div_euclid(2));
        let is_centre = place[0].rem_euclid(2) == 1;
        let most = if is_centre { [nx - 1, ny - 1, nz - 1] } else { [nx, ny, nz] };
        if !(0..3).all(|axis| (0..=most[axis]).contains(&[i, j, k][axis])) {
            return None;
        }
        let corners = (nx + 1) * (ny + 1) * (nz + 1);
        let index = |[nx, ny]: [i32; 2]| (k * ny + j) * nx + i;
        Some(if is_centre { corners + index([nx, ny]) } else { index([nx + 1, ny + 1]) } as u32)
    }

    /// All places of the lattice, in the order of their nodes.
    pub fn places(&self) -> impl Iterator<Item = Place> + use<> {
        let [nx, ny, nz] = self.cubes;
        let grid = |nx: i32, ny: i32, nz: i32, odd: i32| {
            (0..nz).flat_map(move |k| {
                (0..ny).flat_map(move |j| (0..nx).map(move |i| [2 * i + odd, 2 * j + odd, 2 * k + odd]))
            })
        };
        grid(nx + 1, ny + 1, nz + 1, 0).chain(grid(nx, ny, nz, 1))
    }

    /// Position of a place before nodes are moved, m.
    pub fn undeformed(&self, place: Place) -> Vector3<f64> {
        self.origin + Vector3::from(place.map(f64::from)) * self.half
    }

    /// Position of a node, m.
    pub fn position(&self, node: u32, place: Place) -> Vector3<f64> {
        self.moved.get(&node).copied().unwrap_or_else(|| self.undeformed(place))
    }

    /// Cut of the edge from a node inside to a node outside, m.
    pub fn cut_between(&self, inside: u32, outside: u32) -> Option<Vector3<f64>> {
        self.cuts.get(&[inside, outside]).copied()
    }

    /// Asks for each node whether it lies inside.
    pub fn find_signs(&mut self, is_inside: impl Fn(&Vector3<f64>) -> bool) {
        for (node, place) in self.places().enumerate() {
            self.signs[node] = if is_inside(&self.undeformed(place)) { 1 } else { -1 };
        }
    }

    /// Asks for each edge between a node inside and one outside, and their positions, at which part of the way the surface lies.
    pub fn cut(&mut self, exit: impl Fn([usize; 2], [&Vector3<f64>; 2]) -> f64) {
        for (node, place) in self.places().enumerate() {
            if self.signs[node] != 1 {
                continue;
            }
            let inside = self.undeformed(place);
            for (_, other) in neighbours(place) {
                if let Some(neighbour) = self.node(other).filter(|&node| self.signs[node as usize] == -1) {
                    let outside = self.undeformed(other);
                    let part = exit([node, neighbour as usize], [&inside, &outside]);
                    let cut = inside + part * (outside - inside);
                    self.cuts.insert([node as u32, neighbour], cut);
                    self.is_at_cut[node] = true;
                    self.is_at_cut[neighbour as usize] = true;
                }
            }
        }
    }

    /// Moves nodes that are too close to a cut of one of their edges to the closest such cut; the other cuts of their edges vanish.
    pub fn warp(&mut self) {
        let lengths = [2.0 * self.half, 3.0_f64.sqrt() * self.half];
        for (node, place) in self.places().enumerate() {
            if !self.is_at_cut[node] {
                continue;
            }
            let (node, sign) = (node as u32, self.signs[node]);
            let here = self.undeformed(place);
            let key = |other: u32| if sign == 1 { [node, other] } else { [other, node] };
            let around: Vec<(bool, u32)> = neighbours(place)
                .filter_map(|(is_short, place)| Some((is_short, self.node(place)?)))
                .filter(|(_, other)| self.cuts.contains_key(&key(*other)))
                .collect();
            let parts = around.iter().filter_map(|&(is_short, other)| {
                let kind = usize::from(is_short);
                let distance = (self.cuts[&key(other)] - here).norm();
                (distance < TOO_CLOSE[kind] * lengths[kind]).then_some((distance, other))
            });
            let Some((_, closest)) = parts.min_by(|a, b| a.0.total_cmp(&b.0)) else { continue };
            self.moved.insert(node, self.cuts[&key(closest)]);
            self.signs[node as usize] = 0;
            for (_, other) in around {
                self.cuts.remove(&key(other));
            }
        }
    }
}

/// The places at the other ends of a node's edges, each with whether the edge is short.
pub fn neighbours(place: Place) -> impl Iterator<Item = (bool, Place)> {
    let long = (0..3).flat_map(move |axis| {
        [-2, 2].map(move |step| {
            let mut other = place;
            other[axis] += step;
            (false, other)
        })
    });
    let short = (0..8).map(move |corner| {
        let step = |axis: i32| if corner >> axis & 1 == 0 { -1 } else { 1 };
        (true, [place[0] + step(0), place[1] + step(1), place[2] + step(2)])
    });
    long.chain(short)
}

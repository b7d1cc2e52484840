//! Reconnection: a face between two elements is replaced by an edge (2-3), and an edge between n elements by triangles between the vertices
//! of its ring (3-2, 4-4 and beyond), Freitag and Ollivier-Gooch, Tetrahedral Mesh Improvement Using Swapping and Smoothing (1997).
//!
//! Of all triangulations of a ring the best is found by dynamic programming: Klincsek, Minimal Triangulations of Polygonal Domains (1980).

use super::cells::Cells;
use super::shape::{Floor, Shape};

/// Largest number of elements around an edge that is removed: 14 triangulations of a hexagon and 42 of a heptagon.
const LARGEST_RING: usize = 7;

/// Cost of an element.
type Cost<'a> = &'a dyn Fn(&Cells, [u32; 4]) -> f64;

/// The measure by which elements are exchanged.
pub struct Objective<'a> {
    /// Cost of a new element; infinite if it must not come into being.
    pub cost: Cost<'a>,
    /// Cost of an element that would vanish.
    pub of_old: Cost<'a>,
    /// Cost of two parts together: their sum, or the larger one.
    pub both: fn(f64, f64) -> f64,
    /// The cost below which a change is better than the old cost.
    pub at_most: fn(f64) -> f64,
}

impl Objective<'_> {
    fn of_all(&self, cells: &Cells, elements: impl IntoIterator<Item = [u32; 4]>, cost: Cost) -> f64 {
        let costs = elements.into_iter().map(|element| cost(cells, element));
        costs.reduce(self.both).unwrap_or(0.0)
    }
}

/// Replaces the face of an element opposite a corner by the edge between the two vertices that it separates, if that is better.
pub fn remove_face(cells: &mut Cells, cell: u32, side: usize, objective: &Objective) -> bool {
    let Some(other) = cells.neighbour(cell, side) else { return false };
    let face = cells.face(cell, side);
    let apex = cells.corners[cell as usize][side];
    let Some(below) = cells.corners[other as usize].into_iter().find(|vertex| !face.contains(vertex)) else {
        return false;
    };
    if below == apex || !cells.is_removable_face(face) {
        return false;
    }
    let [a, b, c] = face;
    let new = [[apex, a, b, below], [apex, b, c, below], [apex, c, a, below]];
    let old = [cell, other].map(|cell| cells.corners[cell as usize]);
    let before = objective.of_all(cells, old, objective.of_old);
    if !(objective.of_all(cells, new, objective.cost) < (objective.at_most)(before)) {
        return false;
    }
    cells.replace(&[cell, other], &new);
    true
}

/// Removes an edge if a triangulation of its ring is better.
pub fn remove_edge(cells: &mut Cells, edge: [u32; 2], objective: &Objective) -> bool {
    let around = cells.around(edge);
    if !(3..=LARGEST_RING).contains(&around.len()) {
        return false;
    }
    let Some(ring) = ring(cells, edge, &around) else { return false };
    if !cells.is_removable_edge(edge, &ring) {
        return false;
    }
    let old = around.iter().map(|&cell| cells.corners[cell as usize]);
    let before = objective.of_all(cells, old, objective.of_old);
    let (cost, triangles) = best_triangulation(cells, edge, &ring, objective);
    if !(cost < (objective.at_most)(before)) {
        return false;
    }
    let new: Vec<[u32; 4]> = triangles.into_iter().flat_map(|triangle| over(edge, triangle)).collect();
    cells.replace(&around, &new);
    true
}

/// The two elements that join a triangle of the ring to the ends of the edge.
fn over([a, b]: [u32; 2], [p, q, r]: [u32; 3]) -> [[u32; 4]; 2] {
    [[p, q, r, b], [q, p, r, a]]
}

/// The vertices around an edge in the order of a right-handed turn from its first to its second end; `None` if they form no closed ring.
fn ring(cells: &Cells, [a, b]: [u32; 2], around: &[u32]) -> Option<Vec<u32>> {
    let steps: Vec<[u32; 2]> =
        around.iter().map(|&cell| step(cells.corners[cell as usize], a, b)).collect::<Option<_>>()?;
    let mut ring = vec![steps[0][0]];
    let mut at = steps[0][1];
    while at != ring[0] {
        if ring.len() == around.len() {
            return None;
        }
        ring.push(at);
        at = steps.iter().find(|step| step[0] == at)?[1];
    }
    (ring.len() == around.len()).then_some(ring)
}

/// The other two corners p, q of an element with the edge a, b, so that (a, b, p, q) is positively oriented.
fn step(corners: [u32; 4], a: u32, b: u32) -> Option<[u32; 2]> {
    let place = |vertex| corners.iter().position(|&corner| corner == vertex);
    let (i, j) = (place(a)?, place(b)?);
    let mut others = (0..4).filter(|&k| k != i && k != j);
    let (k, l) = (others.next()?, others.next()?);
    let is_even = {
        let order = [i, j, k, l];
        let inversions = (0..4).flat_map(|m| (0..m).map(move |n| (n, m))).filter(|&(n, m)| order[n] > order[m]).count();
        inversions % 2 == 0
    };
    Some(if is_even { [corners[k], corners[l]] } else { [corners[l], corners[k]] })
}

/// The triangulation of the ring with the least cost of the elements over it.
fn best_triangulation(cells: &Cells, edge: [u32; 2], ring: &[u32], objective: &Objective) -> (f64, Vec<[u32; 3]>) {
    let n = ring.len();
    // Cost of the polygon from vertex i to j, and the third vertex of the triangle on its base.
    let mut best = [[(f64::NEG_INFINITY, 0_usize); LARGEST_RING]; LARGEST_RING];
    for length in 2..n {
        for i in 0..n - length {
            let j = i + length;
            best[i][j].0 = f64::INFINITY;
            for k in i + 1..j {
                let mut cost = objective.of_all(cells, over(edge, [ring[i], ring[k], ring[j]]), objective.cost);
                for part in [(i, k), (k, j)].into_iter().filter(|(from, to)| to - from > 1) {
                    cost = (objective.both)(cost, best[part.0][part.1].0);
                }
                if cost < best[i][j].0 {
                    best[i][j] = (cost, k);
                }
            }
        }
    }
    let (cost, mut open, mut triangles) = (best[0][n - 1].0, vec![(0, n - 1)], Vec::with_capacity(n - 2));
    if !cost.is_finite() {
        return (f64::INFINITY, triangles);
    }
    while let Some((i, j)) = open.pop() {
        if j - i > 1 {
            let k = best[i][j].1;
            triangles.push([ring[i], ring[k], ring[j]]);
            open.extend([(i, k), (k, j)]);
        }
    }
    (cost, triangles)
}

/// Cost of an element for the worst one to improve: its smallest sine, negated.
pub fn flatness(floor: Floor) -> impl Fn(&Cells, [u32; 4]) -> f64 {
    move |cells, corners| {
        let shape = Shape::new(cells.points(corners));
        if floor.admits(&shape) { -shape.sine } else { f64::INFINITY }
    }
}

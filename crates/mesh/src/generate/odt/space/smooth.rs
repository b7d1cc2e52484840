//! Optimal Delaunay triangulation: every vertex moves to the average of the circumcentres of its star.

use nalgebra::Vector3;

use super::cells::{Cells, Freedom};
use super::flips::{Objective, remove_edge, remove_face};
use super::shape::{Floor, Shape, energy};
use crate::connectivity::EDGES;

/// Sine of a dihedral angle below which an element is close to a sliver: 14.5°. The energy does not see slivers, so that no change that
/// lowers it may make one.
const SLIVER: f64 = 0.25;

/// Halvings of a step that does not lower the energy.
const HALVINGS: u32 = 6;

/// Energy of the whole mesh.
pub fn total_energy(cells: &Cells) -> f64 {
    cells.cells().map(|cell| energy(cells.points(cells.corners[cell as usize]))).sum()
}

/// Moves every free vertex towards the average of the circumcentres of its star, weighted by volume: Alliez, Cohen-Steiner,
/// Yvinec and Desbrun, Variational Tetrahedral Meshing (2005), section 3. The step is halved until the energy of the star falls and no element
/// leaves the bounds or comes closer to a sliver.
pub fn move_vertices(cells: &mut Cells, floor: &Floor) {
    for vertex in 0..cells.positions.len() as u32 {
        if cells.freedom[vertex as usize] != Freedom::Inside || cells.stars[vertex as usize].is_empty() {
            continue;
        }
        let here = cells.positions[vertex as usize];
        let Some(target) = average_of_circumcentres(cells, vertex) else { continue };
        let (before, worst) = measure(cells, vertex, floor);
        let mut way = target - here;
        for _ in 0..HALVINGS {
            cells.positions[vertex as usize] = here + way;
            let (after, new_worst) = measure(cells, vertex, floor);
            if after < before && new_worst >= worst.min(SLIVER) {
                break;
            }
            cells.positions[vertex as usize] = here;
            way *= 0.5;
        }
    }
}

/// Energy of the elements around a vertex, and their smallest sine; infinite energy if one of them leaves the bounds.
fn measure(cells: &Cells, vertex: u32, floor: &Floor) -> (f64, f64) {
    let (mut sum, mut worst) = (0.0, f64::INFINITY);
    for &cell in &cells.stars[vertex as usize] {
        let points = cells.points(cells.corners[cell as usize]);
        let shape = Shape::new(points);
        sum += if floor.admits(&shape) { energy(points) } else { f64::INFINITY };
        worst = worst.min(shape.sine);
    }
    (sum, worst)
}

fn average_of_circumcentres(cells: &Cells, vertex: u32) -> Option<Vector3<f64>> {
    let here = cells.positions[vertex as usize];
    let (mut sum, mut weights) = (Vector3::zeros(), 0.0);
    for &cell in &cells.stars[vertex as usize] {
        let points = cells.points(cells.corners[cell as usize]);
        let [o, a, b, c] = points;
        let (a, b, c) = (a - o, b - o, c - o);
        // Six volumes times twice the circumcentre relative to the first corner: no division by the volume of a sliver.
        let twice = b.cross(&c) * a.norm_squared() + c.cross(&a) * b.norm_squared() + a.cross(&b) * c.norm_squared();
        let six_volumes = a.dot(&b.cross(&c));
        sum += 0.5 * twice + (o - here) * six_volumes;
        weights += six_volumes;
    }
    let target = here + sum / weights;
    target.iter().all(|x| x.is_finite()).then_some(target)
}

/// Flips faces and edges that are not locally Delaunay, where that lowers the energy. Returns the number of flips.
pub fn reconnect(cells: &mut Cells, floor: &Floor) -> usize {
    let cost = |cells: &Cells, corners: [u32; 4]| {
        let points = cells.points(corners);
        let shape = Shape::new(points);
        let is_fit = floor.admits(&shape) && shape.sine > SLIVER;
        if is_fit { energy(points) } else { f64::INFINITY }
    };
    // Elements that are to vanish may be slivers themselves.
    let objective = Objective {
        cost: &cost,
        of_old: &|cells, corners| energy(cells.points(corners)),
        both: |a, b| a + b,
        at_most: |old| old * (1.0 - 1e-10),
    };
    let mut flips = 0;
    for cell in 0..cells.corners.len() as u32 {
        for side in 0..4 {
            if cells.is_alive(cell) && is_not_delaunay(cells, cell, side) {
                flips += usize::from(flip(cells, cell, side, &objective));
            }
        }
    }
    flips
}

/// Removes the face of an element opposite a corner, or one of its edges.
fn flip(cells: &mut Cells, cell: u32, side: usize, objective: &Objective) -> bool {
    let [a, b, c] = cells.face(cell, side);
    remove_face(cells, cell, side, objective)
        || [[a, b], [b, c], [c, a]].into_iter().any(|edge| remove_edge(cells, edge, objective))
}

/// Returns true if the vertex beyond a face lies inside the circumscribed sphere by more than rounding.
fn is_not_delaunay(cells: &Cells, cell: u32, side: usize) -> bool {
    let Some(other) = cells.neighbour(cell, side) else { return false };
    let face = cells.face(cell, side);
    let Some(beyond) = cells.corners[other as usize].into_iter().find(|vertex| !face.contains(vertex)) else {
        return false;
    };
    let points = cells.points(cells.corners[cell as usize]);
    let from = cells.positions[beyond as usize];
    let [a, b, c, d] = points.map(|point| point - from);
    let [aa, bb, cc, dd] = [a, b, c, d].map(|x| x.norm_squared());
    let determinant =
        aa * b.cross(&c).dot(&d) - bb * a.cross(&c).dot(&d) + cc * a.cross(&b).dot(&d) - dd * a.cross(&b).dot(&c);
    let longest = EDGES.iter().map(|&[i, j]| (points[i] - points[j]).norm_squared()).fold(0.0, f64::max);
    determinant > 1e-10 * longest.powf(2.5)
}

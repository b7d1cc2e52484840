//! The worst elements: flips and moves that raise the worst element of the part that they change. Freitag and Ollivier-Gooch (1997); Klingner
//! and Shewchuk, Aggressive Tetrahedral Mesh Improvement (2007).

use nalgebra::Vector3;

use super::cells::{Cells, Freedom};
use super::flips::{Objective, flatness, remove_edge, remove_face};
use super::shape::{Floor, Shape};
use crate::connectivity::EDGES;

/// Sine of a dihedral angle from which an element is good enough: 40°.
const GOOD: f64 = 0.64;

/// Width of the sines that count beside the worst one when a vertex moves.
const WIDTH: f64 = 0.05;

/// The place closest to a point, m, where a vertex of the surface may be; `None` if it has to stay.
pub type Project<'a> = &'a dyn Fn(u32, &Vector3<f64>) -> Option<Vector3<f64>>;

/// Goes through the elements from the worst to the good ones. Returns the number of changes.
pub fn raise_the_worst(cells: &mut Cells, floor: &Floor, project: Project) -> usize {
    let mut poor: Vec<(f64, u32)> =
        cells.cells().map(|cell| (cells.shape(cell).sine, cell)).filter(|(sine, _)| *sine < GOOD).collect();
    poor.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    let cost = flatness(*floor);
    let of_old = |cells: &Cells, corners: [u32; 4]| -Shape::new(cells.points(corners)).sine;
    let objective = Objective { cost: &cost, of_old: &of_old, both: f64::max, at_most: |old| old - 1e-4 };
    let mut changes = 0;
    for (sine, cell) in poor {
        // A change nearby may have removed or raised it.
        if cells.is_alive(cell) && cells.shape(cell).sine <= sine {
            changes += usize::from(raise(cells, cell, &objective, floor, project));
        }
    }
    changes
}

fn raise(cells: &mut Cells, cell: u32, objective: &Objective, floor: &Floor, project: Project) -> bool {
    let corners = cells.corners[cell as usize];
    let by_edges = EDGES.into_iter().any(|[i, j]| remove_edge(cells, [corners[i], corners[j]], objective));
    if by_edges || (0..4).any(|side| remove_face(cells, cell, side, objective)) {
        return true;
    }
    corners.into_iter().filter(|&vertex| move_vertex(cells, vertex, floor, project)).count() > 0
}

/// Moves a vertex so that the worst element of its star rises.
fn move_vertex(cells: &mut Cells, vertex: u32, floor: &Floor, project: Project) -> bool {
    let place = |x: Vector3<f64>| match cells.freedom[vertex as usize] {
        Freedom::Fixed => None,
        Freedom::Inside => Some(x),
        Freedom::OnSurface => project(vertex, &x),
    };
    let here = cells.positions[vertex as usize];
    if cells.freedom[vertex as usize] == Freedom::Fixed {
        return false;
    }
    let worst = |x: &Vector3<f64>| worst(cells, vertex, x, floor);
    let (before, length) = (worst(&here), cells.mean_edge(vertex));
    let direction = ascent(cells, vertex, floor, 1e-4 * length);
    let found = [0.2, 0.08, 0.03, 0.01, 0.003].into_iter().find_map(|part| {
        let x = place(here + direction * (part * length))?;
        (worst(&x) > before + 1e-4).then_some(x)
    });
    found.is_some_and(|x| {
        cells.positions[vertex as usize] = x;
        true
    })
}

/// Moves a vertex to a place, or as far towards it as the elements around it stay within the bounds. Returns whether it has arrived.
pub fn move_towards(cells: &mut Cells, vertex: u32, place: &Vector3<f64>, floor: &Floor) -> bool {
    let here = cells.positions[vertex as usize];
    let fits = |part: &f64| worst(cells, vertex, &(here + (place - here) * *part), floor) > 0.0;
    let Some(part) = [1.0, 0.7, 0.4, 0.2, 0.1, 0.05].into_iter().find(fits) else { return false };
    cells.positions[vertex as usize] = if part == 1.0 { *place } else { here + (place - here) * part };
    part == 1.0
}

/// Shapes of the elements around a vertex if it were at `x`.
fn shapes(cells: &Cells, vertex: u32, x: &Vector3<f64>) -> impl Iterator<Item = Shape> {
    cells.stars[vertex as usize].iter().map(move |&cell| {
        let corners = cells.corners[cell as usize];
        Shape::new(corners.map(|corner| if corner == vertex { *x } else { cells.positions[corner as usize] }))
    })
}

/// The smallest sine of the elements around a vertex if it were at `x`; −1 if one of them leaves the bounds.
fn worst(cells: &Cells, vertex: u32, x: &Vector3<f64>, floor: &Floor) -> f64 {
    let sines = shapes(cells, vertex, x).map(|shape| if floor.admits(&shape) { shape.sine } else { -1.0 });
    sines.fold(f64::INFINITY, f64::min)
}

/// Unit direction in which a smooth minimum of the sines rises, by central differences over `step`, m.
fn ascent(cells: &Cells, vertex: u32, floor: &Floor, step: f64) -> Vector3<f64> {
    let here = cells.positions[vertex as usize];
    let base = worst(cells, vertex, &here, floor);
    let smooth =
        |x: Vector3<f64>| -> f64 { shapes(cells, vertex, &x).map(|shape| -((base - shape.sine) / WIDTH).exp()).sum() };
    let gradient = Vector3::from_fn(|axis, _| {
        let mut offset = Vector3::zeros();
        offset[axis] = step;
        smooth(here + offset) - smooth(here - offset)
    });
    gradient.try_normalize(0.0).unwrap_or_default()
}

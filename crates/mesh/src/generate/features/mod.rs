//! Sharp edges and corners: vertices of a mesh's boundary are moved onto the feature lines of the surface that it fills.
//!
//! Each curve is followed by a path of edges of the boundary, whose vertices move to it step by step while flips and moves keep the elements
//! well shaped; Doran, Isosurface Stuffing Improved: Acute Lattices and Feature Matching (2013), chapter 5. The vertices of each smooth part move on
//! that part alone.

mod lines;
mod paths;

use std::collections::{BTreeMap, BTreeSet};

use nalgebra::Vector3;

use super::odt::space::{Cells, Floor, Freedom, move_towards, raise_the_worst};
use crate::boundary::FACES;
use crate::connectivity::{groups, sides_by_edge, sorted};
use crate::tidy::leave_out_unreferenced;
use crate::{SurfaceMesh, TetrahedralMesh, boundary};
use lines::Features;
use paths::{Graph, Path};

/// Rounds in which vertices move to their curves and the elements around them recover.
const ROUNDS: usize = 12;

/// Shortest line that ends in a smooth part, over the mean edge.
const SHORTEST: f64 = 4.0;

/// Dihedral angles that no element leaves, degrees.
const BOUNDS: [f64; 2] = [6.0, 170.0];

/// Sine of a dihedral angle below which an element under a smooth part of the boundary is flat: 17°.
const FLAT: f64 = 0.3;

/// A mesh with feature lines.
#[derive(Clone, Debug, PartialEq)]
pub struct Featured {
    /// The mesh.
    pub mesh: TetrahedralMesh,
    /// Length of the surface's feature lines, m.
    pub length: f64,
    /// Length of those that edges of the mesh follow with both ends on them, m.
    pub kept: f64,
}

/// The part of the surface on which a vertex of the boundary moves.
#[derive(Clone, Copy, PartialEq)]
enum Place {
    /// The end of curves.
    Point(Vector3<f64>),
    /// The number of a curve, and the part of its length to begin with.
    Curve(usize, f64),
    /// The number of a patch.
    Patch(usize),
}

/// Moves vertices of the boundary onto the feature lines of a surface that the mesh fills, then improves its worst elements. Feature lines are
/// the edges whose triangles' normals differ by more than `angle` degrees. Lines shorter than four edges that end in a smooth part are left out. Dihedral
/// angles stay within 6° and 170° if those of the mesh do.
pub fn keep_features(mesh: &TetrahedralMesh, surface: &SurfaceMesh, angle: f64) -> Featured {
    let mut cells = Cells::new(mesh);
    let features = Features::new(surface, angle, SHORTEST * cells.mean_edge_of_all());
    let length = features.curves.iter().map(lines::Curve::length).sum();
    let faces = boundary(mesh);
    let paths = Graph::new(&mesh.vertices, &faces, cells.mean_edge_of_all()).paths(&features.curves);
    let places = places(mesh, &features, &faces, &paths);
    let patches: BTreeMap<u32, Vec<usize>> = places
        .iter()
        .map(|(&vertex, place)| (vertex, patches_at(&features, place, cells.mean_edge_of_all())))
        .collect();
    let on_one_patch = |corners: [u32; 4]| {
        let [a, b, c, d] = corners.map(|vertex| patches.get(&vertex));
        let (Some(a), Some(b), Some(c), Some(d)) = (a, b, c, d) else { return false };
        a.iter().any(|patch| [b, c, d].iter().all(|others| others.contains(patch)))
    };
    let floor = Floor::within(BOUNDS);
    for round in 0..ROUNDS {
        for (&vertex, place) in &places {
            let target = target(&features, place, &cells.positions[vertex as usize], round);
            let has_arrived = move_towards(&mut cells, vertex, &target, &floor);
            cells.freedom[vertex as usize] = match place {
                Place::Point(_) => Freedom::Fixed,
                _ if has_arrived => Freedom::OnSurface,
                _ => Freedom::Fixed,
            };
        }
        let project = |vertex: u32, x: &Vector3<f64>| Some(target(&features, places.get(&vertex)?, x, ROUNDS));
        raise_the_worst(&mut cells, &floor, &project);
        if round > 0 {
            peel(&mut cells, on_one_patch);
        }
    }
    let kept = kept_length(&cells, &features, &paths);
    let mut mesh = cells.mesh(&mesh.sets);
    leave_out_unreferenced(&mut mesh);
    Featured { mesh, length, kept }
}

/// The place to which a vertex moves: on a curve, first the one that spreads the path evenly, later the closest.
fn target(features: &Features, place: &Place, x: &Vector3<f64>, round: usize) -> Vector3<f64> {
    match *place {
        Place::Point(point) => point,
        Place::Curve(curve, part) if round < ROUNDS / 2 => features.curves[curve].at(part),
        Place::Curve(curve, _) => features.curves[curve].closest(x),
        Place::Patch(patch) => features.patches[patch].closest(x).unwrap_or(*x),
    }
}

/// The place of each vertex of the boundary: those of paths on their curves, the others on the patch of the part that paths enclose.
fn places(mesh: &TetrahedralMesh, features: &Features, faces: &[[usize; 3]], paths: &[Path]) -> BTreeMap<u32, Place> {
    let mut places = BTreeMap::new();
    let mut between = BTreeSet::new();
    for path in paths {
        let curve = &features.curves[path.curve];
        let last = path.vertices.len() - 1;
        for (i, (&vertex, &part)) in path.vertices.iter().zip(&path.places).enumerate() {
            let is_end = i == 0 || i == last;
            places.insert(vertex, if is_end { Place::Point(curve.at(part)) } else { Place::Curve(path.curve, part) });
        }
        between.extend(path.vertices.windows(2).map(|pair| sorted([pair[0] as usize, pair[1] as usize])));
    }
    for part in parts(faces, &between) {
        let vertices: BTreeSet<u32> = part.iter().flat_map(|&face| faces[face]).map(|i| i as u32).collect();
        let inside: Vec<u32> = vertices.into_iter().filter(|vertex| !places.contains_key(vertex)).collect();
        let mut votes: BTreeMap<usize, usize> = BTreeMap::new();
        for &vertex in &inside {
            *votes.entry(closest_patch(features, &mesh.vertices[vertex as usize])).or_default() += 1;
        }
        // The vertices close to a curve that has no path belong to several patches.
        let most = votes.iter().max_by_key(|(_, votes)| **votes).map(|(&patch, _)| patch);
        let is_one = votes.values().max().is_some_and(|&most| 10 * most >= 7 * inside.len());
        for vertex in inside {
            let own = closest_patch(features, &mesh.vertices[vertex as usize]);
            places.insert(vertex, Place::Patch(if is_one { most.unwrap_or(own) } else { own }));
        }
    }
    places
}

/// The patches that meet at a place.
fn patches_at(features: &Features, place: &Place, edge: f64) -> Vec<usize> {
    let x = match *place {
        Place::Patch(patch) => return vec![patch],
        Place::Point(point) => point,
        Place::Curve(curve, _) => features.curves[curve].at(0.5),
    };
    let is_at = |patch: &usize| features.patches[*patch].closest(&x).is_some_and(|y| (y - x).norm() < 1e-6 * edge);
    (0..features.patches.len()).filter(is_at).collect()
}

fn closest_patch(features: &Features, x: &Vector3<f64>) -> usize {
    let distance = |patch: usize| features.patches[patch].closest(x).map_or(f64::INFINITY, |place| (place - x).norm());
    (0..features.patches.len()).min_by(|&a, &b| distance(a).total_cmp(&distance(b))).unwrap_or(0)
}

/// The faces of each part of the boundary that some edges enclose.
fn parts(faces: &[[usize; 3]], between: &BTreeSet<[usize; 2]>) -> Vec<Vec<usize>> {
    let sides = sides_by_edge(faces);
    let open = sides.windows(2).filter(|pair| pair[0].0 == pair[1].0 && !between.contains(&pair[0].0));
    groups(faces.len(), open.map(|pair| [pair[0].1 / 3, pair[1].1 / 3]))
}

/// Length of the edges of paths with both ends on their curve, m.
fn kept_length(cells: &Cells, features: &Features, paths: &[Path]) -> f64 {
    let edge = cells.mean_edge_of_all();
    let mut sum = 0.0;
    for path in paths {
        let curve = &features.curves[path.curve];
        for pair in path.vertices.windows(2) {
            let [a, b] = [pair[0], pair[1]].map(|vertex| cells.positions[vertex as usize]);
            if [a, b].iter().all(|x| (curve.closest(x) - x).norm() < 1e-6 * edge) {
                sum += (b - a).norm();
            }
        }
    }
    sum
}

/// Takes off the elements with two or three faces on the boundary whose four corners are `on_one_patch`, if they are flat. Their other faces
/// become the boundary, which stays a manifold; a vertex that only three such faces had belongs to no element then.
fn peel(cells: &mut Cells, on_one_patch: impl Fn([u32; 4]) -> bool) {
    for cell in 0..cells.corners.len() as u32 {
        if !cells.is_alive(cell) || cells.shape(cell).sine > FLAT {
            continue;
        }
        let corners = cells.corners[cell as usize];
        let (outside, inside): (Vec<usize>, Vec<usize>) =
            (0..4).partition(|&side| cells.neighbour(cell, side).is_none());
        let leaves_a_manifold = match (&outside[..], &inside[..]) {
            // The faces opposite two corners meet in the edge of the others; the new boundary has the edge of the two.
            (&[a, b], _) => !is_on_boundary(cells, [corners[a], corners[b]]),
            (_, &[apex]) => cells.stars[corners[apex] as usize].len() == 1 && !cells.is_kept(corners[apex]),
            _ => false,
        };
        if leaves_a_manifold && on_one_patch(corners) {
            cells.remove(cell);
        }
    }
}

fn is_on_boundary(cells: &Cells, [a, b]: [u32; 2]) -> bool {
    cells.around([a, b]).into_iter().any(|cell| {
        (0..4).any(|side| {
            let face = FACES[side].map(|corner| cells.corners[cell as usize][corner]);
            face.contains(&a) && face.contains(&b) && cells.neighbour(cell, side).is_none()
        })
    })
}

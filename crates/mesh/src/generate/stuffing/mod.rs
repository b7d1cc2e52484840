//! Tetrahedra inside a surface by isosurface stuffing: Labelle and Shewchuk, Isosurface Stuffing: Fast Tetrahedral Meshes with Good Dihedral
//! Angles (2007), with a uniform lattice or one that is coarser inside.
//!
//! Nodes of a body-centred cubic lattice close to the surface are moved onto it, and the tetrahedra that it still cuts are filled by
//! stencils. Dihedral angles lie between 10.7° and 164.8° whatever the surface. Nodes of the boundary lie on the surface; its edges and corners
//! are rounded by at most the size of an element.

pub(super) mod lattice;
pub(super) mod octree;
pub(super) mod stencils;

use std::cell::Cell;

use nalgebra::Vector3;

use super::Progress;
use super::solid::Solid;
use crate::error::StuffingError;
use crate::{SurfaceMesh, TetrahedralMesh};
use lattice::Lattice;
use octree::Octree;

/// Largest number of tetrahedra of the lattice, which uses some 20 bytes for each.
const MOST: f64 = 1e8;

/// Mean edge of a tetrahedron of the lattice, over the side of its cubes.
const MEAN_EDGE: f64 = 0.910_683_602_522_959;

/// Times that the progress is told while nodes are found to be inside or outside, and the share of the whole time that this takes.
const TOLD: usize = 200;
const SIGNS: f64 = 0.8;

/// Tetrahedra with edges of about `edge` m inside a surface, which may have holes, cross itself and have flipped triangles.
///
/// # Errors
/// Too many tetrahedra or none, and numbers that are not finite.
pub fn stuff(surface: &SurfaceMesh, edge: f64) -> Result<TetrahedralMesh, StuffingError> {
    stuff_graded(surface, edge, 0, &|_| ())
}

/// Tetrahedra as those of [`stuff`] at the surface, and with edges that double up to `doublings` times towards the inside. The boundary and the
/// bounds of the dihedral angles are those of [`stuff`]. Tells how far it is: for most of the time, of how many nodes of the lattice it knows whether
/// they are inside.
///
/// # Errors
/// As [`stuff`].
pub fn stuff_graded(
    surface: &SurfaceMesh,
    edge: f64,
    doublings: usize,
    progress: Progress,
) -> Result<TetrahedralMesh, StuffingError> {
    let (solid, lattice) = lattice_around(surface, edge, 0.0)?;
    let body = Implicit { is_inside: &|x| solid.contains(x), exit: &|inside, outside| solid.exit(inside, outside) };
    let [least, largest] = solid.bounds();
    let empty = StuffingError::Empty { edge, size: (largest - least).into() };
    fill(lattice, doublings, &body, progress).ok_or(empty)
}

/// A body that functions describe, such as the part of space where one is positive.
pub struct Implicit<'a> {
    /// Returns true if a point, m, lies inside.
    pub is_inside: &'a dyn Fn(&Vector3<f64>) -> bool,
    /// The part of the way from a point inside to one outside that lies in the body; one that is not between 0 and 1 counts as the nearer of them,
    /// NaN as 0.
    pub exit: &'a dyn Fn(&Vector3<f64>, &Vector3<f64>) -> f64,
}

/// Tetrahedra as those of [`stuff_graded`] in the part of a body between the smallest and the largest coordinates of a box, m.
///
/// # Errors
/// As [`stuff`].
pub fn stuff_implicit(
    body: &Implicit,
    bounds: [Vector3<f64>; 2],
    edge: f64,
    doublings: usize,
) -> Result<TetrahedralMesh, StuffingError> {
    let size = bounds[1] - bounds[0];
    let empty = StuffingError::Empty { edge, size: size.into() };
    if !size.iter().all(|&size| size >= 0.0) {
        return Err(empty);
    }
    fill(lattice_of(bounds, edge)?, doublings, body, &|_| ()).ok_or(empty)
}

/// The mesh of the part of a body in a lattice; nothing if it is empty.
fn fill(mut lattice: Lattice, doublings: usize, body: &Implicit, progress: Progress) -> Option<TetrahedralMesh> {
    let (nodes, known) = (lattice.places().count(), Cell::new(0));
    let told_after = nodes.div_ceil(TOLD);
    lattice.find_signs(|point| {
        let done = known.replace(known.get() + 1);
        if done % told_after == 0 {
            progress(SIGNS * done as f64 / nodes as f64);
        }
        (body.is_inside)(point)
    });
    let octree = Octree::graded(&lattice, doublings);
    lattice.cut(|_, [inside, outside]| {
        let part = (body.exit)(inside, outside);
        if part >= 0.0 { part.min(1.0) } else { 0.0 }
    });
    lattice.warp();
    progress(0.5 * (1.0 + SIGNS));
    let mesh = stencils::fill(&lattice, &octree);
    (!mesh.elements.is_empty()).then_some(mesh)
}

/// The solid of a surface, and a lattice with edges of about `edge` m around it, with a margin (m) on every side.
pub(super) fn lattice_around(surface: &SurfaceMesh, edge: f64, margin: f64) -> Result<(Solid, Lattice), StuffingError> {
    if let Some(vertex) = surface.vertices.iter().position(|x| !x.iter().all(|x| x.is_finite())) {
        return Err(StuffingError::NotFinite { vertex });
    }
    let solid = Solid::new(surface);
    let [least, largest] = solid.bounds();
    let lattice = lattice_of([least.add_scalar(-margin), largest.add_scalar(margin)], edge)?;
    Ok((solid, lattice))
}

/// A lattice with edges of about `edge` m around a box.
fn lattice_of([least, largest]: [Vector3<f64>; 2], edge: f64) -> Result<Lattice, StuffingError> {
    if !(edge > 0.0 && edge.is_finite()) {
        return Err(StuffingError::Edge { edge });
    }
    let side = edge / MEAN_EDGE;
    let count = (largest - least).iter().map(|size| size / side + 3.0).product::<f64>() * 12.0;
    if !(count <= MOST) {
        return Err(StuffingError::TooFine { edge, count, most: MOST });
    }
    Ok(Lattice::around([least, largest], side))
}

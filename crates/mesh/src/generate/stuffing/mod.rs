//! Tetrahedra inside a surface by isosurface stuffing: Labelle and Shewchuk, Isosurface Stuffing: Fast Tetrahedral Meshes with Good Dihedral
//! Angles (2007), with a uniform lattice.
//!
//! Nodes of a body-centred cubic lattice close to the surface are moved onto it, and the tetrahedra that it still cuts are filled by
//! stencils. Dihedral angles lie between 10.7° and 164.8° whatever the surface. Nodes of the boundary lie on the surface; its edges and corners
//! are rounded by at most the size of an element.

mod lattice;
mod stencils;

use nalgebra::Vector3;
use thiserror::Error;

use super::solid::Solid;
use crate::{Mesh, SurfaceMesh, TetrahedralMesh};
use lattice::Lattice;

/// Largest number of tetrahedra of the lattice, which uses some 20 bytes for each.
const MOST: f64 = 1e8;

/// Mean edge of a tetrahedron of the lattice, over the side of its cubes.
const MEAN_EDGE: f64 = 0.910_683_602_522_959;

/// Reason why a surface has no tetrahedra inside.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum StuffingError {
    /// A vertex is NaN or infinite.
    #[error(
        "vertex {vertex} (counted from 0) has a coordinate that is not finite; give it a finite position or remove it"
    )]
    NotFinite {
        /// Counted from 0.
        vertex: usize,
    },
    /// The edge length is no length.
    #[error("an edge of {edge} m; give a length above 0")]
    Edge {
        /// m
        edge: f64,
    },
    /// Too many tetrahedra.
    #[error(
        "with edges of {edge} m the box around the surface would have {count:.1e} tetrahedra, and {most:.0e} is the most; take longer edges"
    )]
    TooFine {
        /// m
        edge: f64,
        /// Number of tetrahedra.
        count: f64,
        /// Largest number of them.
        most: f64,
    },
    /// The surface encloses nothing that the lattice sees.
    #[error(
        "with edges of {edge} m no point of the lattice lies inside the surface; take shorter edges (the surface measures {} × {} × {} m), or close it", size[0], size[1], size[2]
    )]
    Empty {
        /// m
        edge: f64,
        /// Size of the box around the surface, m.
        size: [f64; 3],
    },
}

/// Tetrahedra with edges of about `edge` m inside a surface, which may have holes, cross itself and have flipped triangles.
///
/// # Errors
/// Too many tetrahedra or none, and numbers that are not finite.
pub fn stuff(surface: &SurfaceMesh, edge: f64) -> Result<TetrahedralMesh, StuffingError> {
    if let Some(vertex) = surface.vertices.iter().position(|x| !x.iter().all(|x| x.is_finite())) {
        return Err(StuffingError::NotFinite { vertex });
    }
    if !(edge > 0.0 && edge.is_finite()) {
        return Err(StuffingError::Edge { edge });
    }
    let solid = Solid::new(surface);
    let [least, largest] = solid.bounds();
    let side = edge / MEAN_EDGE;
    let size = largest - least;
    let count = size.iter().map(|size| size / side + 3.0).product::<f64>() * 12.0;
    if !(count <= MOST) {
        return Err(StuffingError::TooFine { edge, count, most: MOST });
    }
    let mut lattice = Lattice::around([least, largest], side);
    lattice.find_signs(|point| solid.contains(point));
    lattice.cut(|inside, outside| solid.exit(inside, outside));
    lattice.warp();
    let (vertices, elements) = stencils::fill(&lattice);
    if elements.is_empty() {
        return Err(StuffingError::Empty { edge, size: size.into() });
    }
    Ok(Mesh::new(vertices, elements))
}

/// Sixfold signed volume; positive for the order of a mesh.
fn six_volumes([a, b, c, d]: [Vector3<f64>; 4]) -> f64 {
    (b - a).cross(&(c - a)).dot(&(d - a))
}

#[cfg(test)]
mod tests {
    use std::cell::Cell;

    use nalgebra::Vector3;

    use super::lattice::Lattice;
    use super::stencils;
    use crate::{Mesh, SurfaceMesh, boundary, check, quality, surface_quality};

    /// The mesh of a lattice with random signs of its nodes and random cuts of its edges, which reach every case of the stencils.
    fn by_chance(seed: u64, inside: f64, cubes: f64) -> Mesh<3, 4> {
        let random = Cell::new(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1);
        let next = || {
            let mut x = random.get();
            x ^= x << 13;
            x ^= x >> 7;
            x ^= x << 17;
            random.set(x);
            (x >> 11) as f64 / (1_u64 << 53) as f64
        };
        let mut lattice = Lattice::around([Vector3::zeros(), Vector3::repeat(cubes)], 1.0);
        let in_box = |x: &Vector3<f64>| x.iter().all(|x| (0.0..=cubes).contains(x));
        lattice.find_signs(|x| in_box(x) && next() < inside);
        lattice.cut(|_, _| next());
        lattice.warp();
        let (vertices, elements) = stencils::fill(&lattice);
        Mesh::new(vertices, elements)
    }

    #[test]
    fn dihedral_angles_keep_their_bounds_for_any_signs_and_cuts() {
        let mut range = [f64::INFINITY, 0.0_f64];
        for seed in 1..40 {
            let mesh = by_chance(seed, [0.35, 0.5, 0.8][seed as usize % 3], 8.0);
            check(&mesh, "chance".as_ref()).unwrap();
            let angles = quality(&mesh).dihedral_angles.map(|angle| angle.value);
            range = [range[0].min(angles[0]), range[1].max(angles[1])];
        }
        assert!(range[0] >= 10.7 && range[1] <= 164.8, "{range:?}");
    }

    #[test]
    fn neighbouring_tetrahedra_share_whole_faces_so_that_the_boundary_has_no_open_edge() {
        for seed in 1..10 {
            let mesh = by_chance(seed, 0.5, 6.0);
            let surface = SurfaceMesh::new(mesh.vertices.clone(), boundary(&mesh));
            let found = surface_quality(&surface);
            assert_eq!((found.open_edges, found.flipped_edges), (0, 0));
        }
    }
}

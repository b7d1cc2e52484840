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
    let (solid, mut lattice) = lattice_around(surface, edge, 0.0)?;
    let (nodes, known) = (lattice.places().count(), Cell::new(0));
    let told_after = nodes.div_ceil(TOLD);
    lattice.find_signs(|point| {
        let done = known.replace(known.get() + 1);
        if done % told_after == 0 {
            progress(SIGNS * done as f64 / nodes as f64);
        }
        solid.contains(point)
    });
    let octree = Octree::graded(&lattice, doublings);
    lattice.cut(|_, [inside, outside]| solid.exit(inside, outside));
    lattice.warp();
    progress(0.5 * (1.0 + SIGNS));
    let mesh = stencils::fill(&lattice, &octree);
    if mesh.elements.is_empty() {
        let [least, largest] = solid.bounds();
        return Err(StuffingError::Empty { edge, size: (largest - least).into() });
    }
    Ok(mesh)
}

/// The solid of a surface, and a lattice with edges of about `edge` m around it, with a margin (m) on every side.
pub(super) fn lattice_around(surface: &SurfaceMesh, edge: f64, margin: f64) -> Result<(Solid, Lattice), StuffingError> {
    if let Some(vertex) = surface.vertices.iter().position(|x| !x.iter().all(|x| x.is_finite())) {
        return Err(StuffingError::NotFinite { vertex });
    }
    if !(edge > 0.0 && edge.is_finite()) {
        return Err(StuffingError::Edge { edge });
    }
    let solid = Solid::new(surface);
    let [least, largest] = solid.bounds();
    let (least, largest) = (least.add_scalar(-margin), largest.add_scalar(margin));
    let side = edge / MEAN_EDGE;
    let count = (largest - least).iter().map(|size| size / side + 3.0).product::<f64>() * 12.0;
    if !(count <= MOST) {
        return Err(StuffingError::TooFine { edge, count, most: MOST });
    }
    Ok((solid, Lattice::around([least, largest], side)))
}

#[cfg(test)]
mod tests {
    use std::cell::Cell;

    use nalgebra::Vector3;

    use super::lattice::Lattice;
    use super::octree::Octree;
    use super::stencils;
    use crate::{Mesh, SurfaceMesh, boundary, check, quality, surface_quality};

    fn random(seed: u64) -> impl Fn() -> f64 {
        let random = Cell::new(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1);
        move || {
            let mut x = random.get();
            x ^= x << 13;
            x ^= x >> 7;
            x ^= x << 17;
            random.set(x);
            (x >> 11) as f64 / (1_u64 << 53) as f64
        }
    }

    /// The mesh of a lattice with random signs of its nodes and random cuts of its edges, which reach every case of the stencils.
    fn by_chance(seed: u64, inside: f64, cubes: f64) -> Mesh<3, 4> {
        let next = random(seed);
        let mut lattice = Lattice::around([Vector3::zeros(), Vector3::repeat(cubes)], 1.0);
        let in_box = |x: &Vector3<f64>| x.iter().all(|x| (0.0..=cubes).contains(x));
        lattice.find_signs(|x| in_box(x) && next() < inside);
        lattice.cut(|_, _| next());
        lattice.warp();
        stencils::fill(&lattice, &Octree::uniform(lattice.cubes()))
    }

    /// The mesh of a graded lattice around a box with random holes and a ragged surface, and that of the uniform one.
    fn graded_and_uniform(seed: u64) -> [Mesh<3, 4>; 2] {
        let next = random(seed);
        let holes: Vec<Vector3<f64>> = (0..3).map(|_| Vector3::from_fn(|_, _| (33.0 * next()).round())).collect();
        let mut lattice = Lattice::around([Vector3::zeros(), Vector3::new(33.0, 27.0, 20.0)], 1.0);
        lattice.find_signs(|x| {
            let depth = (0..3).map(|i| x[i].min([33.0, 27.0, 20.0][i] - x[i])).fold(f64::INFINITY, f64::min);
            let in_hole = holes.iter().any(|hole| (hole - x).norm() < 2.5);
            depth > 0.0 && !in_hole && (depth > 1.5 || next() < 0.6)
        });
        let octree = Octree::graded(&lattice, 3);
        lattice.cut(|_, _| next());
        lattice.warp();
        [octree, Octree::uniform(lattice.cubes())].map(|octree| stencils::fill(&lattice, &octree))
    }

    #[test]
    fn a_graded_lattice_keeps_the_bounds_and_the_boundary_of_the_uniform_one() {
        for seed in 1..=4 {
            let [graded, uniform] = graded_and_uniform(seed);
            check(&graded, "graded".as_ref()).unwrap();
            let angles = quality(&graded).dihedral_angles.map(|angle| angle.value);
            assert!(angles[0] >= 10.7 && angles[1] <= 164.8, "seed {seed}: {angles:?}");
            let surface = |mesh: &Mesh<3, 4>| {
                let place = |face: [usize; 3]| {
                    let mut places = face.map(|i| mesh.vertices[i].map(f64::to_bits).into());
                    places.sort_unstable();
                    places
                };
                let mut faces: Vec<[[u64; 3]; 3]> = boundary(mesh).into_iter().map(place).collect();
                faces.sort_unstable();
                faces
            };
            assert!(surface(&graded) == surface(&uniform), "seed {seed}");
            assert!(10 * graded.elements.len() < 9 * uniform.elements.len(), "seed {seed}: {}", graded.elements.len());
        }
    }

    #[test]
    fn tetrahedra_between_cubes_of_different_sizes_have_angles_from_45_to_120_degrees() {
        let mut lattice = Lattice::around([Vector3::zeros(), Vector3::repeat(30.0)], 1.0);
        lattice.find_signs(|x| x.iter().all(|x| (0.5..29.5).contains(x)));
        let octree = Octree::graded(&lattice, 3);
        let (mut vertices, mut elements) = (Vec::new(), Vec::new());
        octree.tetrahedra(|places| {
            if places.iter().flatten().all(|x| (8..56).contains(x)) {
                elements.push([0, 1, 2, 3].map(|i| vertices.len() + i));
                vertices.extend(places.map(|place| lattice.undeformed(place)));
            }
        });
        for element in &mut elements {
            if crate::signed_volume(element.map(|i| vertices[i])) < 0.0 {
                element.swap(2, 3);
            }
        }
        let angles = quality(&Mesh::new(vertices, elements)).dihedral_angles.map(|angle| angle.value);
        assert!((angles[0] - 45.0).abs() < 1e-9 && (angles[1] - 120.0).abs() < 1e-9, "{angles:?}");
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

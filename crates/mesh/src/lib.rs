//! Meshes of simplices: files, checks, measures, refinement, joining.
//!
//! [`read_tetrahedra`] and [`read_surface`] read a mesh file by its extension, [`read_mesh`] whichever of the two it holds;
//! [`write`](mod@write) writes one. A mesh is plain data; [`check`] tests the properties that computations rely on.
//!
//! ```
//! let mesh = fem_mesh::box_mesh([2.0, 1.0, 1.0], 2, fem_mesh::Pattern::Alternating)?;
//! fem_mesh::check(&mesh, "box".as_ref())?;
//! let volume: f64 = fem_mesh::volumes(&mesh).iter().sum();
//! assert!((volume - 2.0).abs() < 1e-12); // m³
//! assert_eq!(fem_mesh::boundary(&mesh).len(), 80); // 40 squares of two triangles
//!
//! let file = std::env::temp_dir().join("fem-mesh-example.vtu");
//! fem_mesh::write_tetrahedra(&file, &mesh)?;
//! assert_eq!(fem_mesh::read_tetrahedra(&file)?.vertices, mesh.vertices);
//! # std::fs::remove_file(&file).ok();
//! # Ok::<(), fem_mesh::MeshError>(())
//! ```

#![deny(missing_docs)]
#![allow(non_snake_case)] // J, F, C and D are the names that the mathematics and the course use
#![allow(clippy::needless_range_loop)] // indices of tensors are the notation of the field
#![allow(clippy::neg_cmp_op_on_partial_ord)] // written so that NaN fails

use std::collections::BTreeMap;

use nalgebra::SVector;

mod boundary;
mod box_mesh;
mod boxes;
mod buckets;
mod check;
mod connectivity;
mod error;
pub mod generate;
mod join;
mod measures;
mod orient;
mod overlap;
mod pattern;
mod quality;
mod read;
mod refine;
mod sets;
mod sides;
mod tidy;
pub mod write;

pub use boundary::{boundary, outer_faces};
pub use box_mesh::{box_mesh, rectangle_mesh};
pub use check::{check, check_plane};
pub use connectivity::{CoincidentNodes, coincident_nodes, distinct_edges, parts};
pub use error::{MeshError, Place, Problem};
pub use join::join;
pub use measures::{area_vector, signed_volume, volumes};
pub use orient::oriented;
pub use overlap::overlap;
pub use pattern::Pattern;
pub use quality::{
    Distribution, Extreme, Quality, SelfIntersections, SurfaceQuality, TriangleQuality, quality, self_intersections,
    surface_quality, tetrahedron_distributions, tetrahedron_radius_to_edge, triangle_distributions, triangle_quality,
    triangle_radius_to_edge,
};
pub use read::{
    AnyMesh, MeshFile, Points, is_surface, read_file, read_mesh, read_points, read_surface, read_tetrahedra,
};
pub use refine::{refine, refine_triangles};
pub use sets::MeshSet;
pub use sides::{Side, nodes_on_side};
pub use tidy::{turn_inverted, without_faulty_elements};
pub use write::{write_mesh, write_surface, write_tetrahedra};

/// Simplices of `N` vertices in `D` dimensions. The fields carry no guarantee; [`check`] tests them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh<const D: usize, const N: usize> {
    /// Undeformed position of each vertex, m.
    pub vertices: Vec<SVector<f64, D>>,
    /// Vertex indices of each element, counted from 0.
    pub elements: Vec<[usize; N]>,
    /// Parts of the mesh by name, such as the physical groups of a Gmsh file; empty if the file names no part.
    pub sets: BTreeMap<String, MeshSet>,
}

impl<const D: usize, const N: usize> Mesh<D, N> {
    /// A mesh without named sets. `vertices` in m.
    pub fn new(vertices: Vec<SVector<f64, D>>, elements: Vec<[usize; N]>) -> Self {
        Self { vertices, elements, sets: BTreeMap::new() }
    }
}

/// Tetrahedra in space; positively oriented if `dot(cross(b − a, c − a), d − a) > 0`.
pub type TetrahedralMesh = Mesh<3, 4>;

/// Triangles in space, counter-clockwise seen from outside.
pub type SurfaceMesh = Mesh<3, 3>;

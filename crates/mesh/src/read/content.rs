//! The simplices of a mesh file, before it is known whether they are a body or a surface.

use std::collections::BTreeMap;
use std::path::Path;

use nalgebra::Vector3;

use crate::{MeshError, MeshSet, Problem, SurfaceMesh, TetrahedralMesh};

/// A mesh of the kind that its file holds: tetrahedra if there are any, triangles otherwise.
#[derive(Clone, Debug, PartialEq)]
pub enum AnyMesh {
    /// A body.
    Tetrahedra(TetrahedralMesh),
    /// A surface, or a flat body in the plane z = 0.
    Triangles(SurfaceMesh),
}

/// All that a reader found in a file.
#[derive(Default)]
pub(super) struct Content {
    /// Positions, m; z is 0 in files of the plane.
    pub vertices: Vec<Vector3<f64>>,
    pub tetrahedra: Vec<[usize; 4]>,
    /// Triangles; those of a file with tetrahedra need not be complete.
    pub triangles: Vec<[usize; 3]>,
    /// Named parts of the tetrahedra, or of the triangles if there are no tetrahedra.
    pub sets: BTreeMap<String, MeshSet>,
    /// A kind of polygons that was skipped and would be missing in a surface.
    pub skipped: Option<String>,
}

impl Content {
    /// The tetrahedra, of which there may be none unless the file is a surface.
    pub(super) fn tetrahedra(self, file: &Path) -> Result<TetrahedralMesh, MeshError> {
        if self.tetrahedra.is_empty() && !self.triangles.is_empty() {
            let found = format!("a mesh of {} triangles in place of tetrahedra", self.triangles.len());
            let instead = "give tetrahedra, such as `mesh from-surface` makes inside a surface";
            return Err(MeshError::in_file(file, Problem::Unsupported { found, instead }));
        }
        Ok(TetrahedralMesh { vertices: self.vertices, elements: self.tetrahedra, sets: self.sets })
    }

    /// The triangles of a file without tetrahedra.
    pub(super) fn triangles(self, file: &Path) -> Result<SurfaceMesh, MeshError> {
        match self.mesh(file)? {
            AnyMesh::Triangles(mesh) => Ok(mesh),
            AnyMesh::Tetrahedra(mesh) => {
                let found = format!("a mesh of {} tetrahedra in place of triangles", mesh.elements.len());
                let instead = "give a surface or a plane mesh";
                Err(MeshError::in_file(file, Problem::Unsupported { found, instead }))
            }
        }
    }

    /// The tetrahedra if there are any, and the triangles otherwise.
    pub(super) fn mesh(self, file: &Path) -> Result<AnyMesh, MeshError> {
        let in_file = |problem| MeshError::in_file(file, problem);
        if !self.tetrahedra.is_empty() {
            return self.tetrahedra(file).map(AnyMesh::Tetrahedra);
        }
        if let Some(found) = self.skipped {
            return Err(in_file(Problem::Unsupported { found, instead: "split the polygons into triangles first" }));
        }
        if self.triangles.is_empty() {
            return Err(in_file(Problem::Empty { what: "tetrahedra or triangles" }));
        }
        let (vertices, elements, sets) = (self.vertices, self.triangles, self.sets);
        Ok(AnyMesh::Triangles(SurfaceMesh { vertices, elements, sets }))
    }

    /// Adds a triangle, unless the file has tetrahedra, whose triangles are not needed.
    pub(super) fn add_triangle(&mut self, triangle: [usize; 3]) {
        if self.tetrahedra.is_empty() {
            self.triangles.push(triangle);
        }
    }
}

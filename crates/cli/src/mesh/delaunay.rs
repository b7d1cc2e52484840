//! `mesh delaunay`: a mesh of a point cloud.

use std::path::Path;

use fem_mesh::generate::Progress;
use fem_mesh::generate::delaunay::{DelaunayError, tetrahedralize, triangulate};
use fem_mesh::{Points, SurfaceMesh};

use super::{write_surface, write_tetrahedra};
use crate::end::End;
use crate::progress;

/// Triangles or tetrahedra, as the points have two or three coordinates.
pub fn run(points: &Path, out: &Path) -> Result<(), End> {
    let unusable = |error: DelaunayError| End::unusable(format!("{}: {error}", points.display()));
    let (count, vertices) = match fem_mesh::read_points(points).map_err(End::unusable)? {
        Points::InPlane(points) => {
            fem_mesh::write::check_surface(out).map_err(End::unusable)?;
            let found = progress::during("connecting the points", || triangulate(&points)).map_err(unusable)?.mesh;
            let vertices = found.vertices.iter().map(|x| x.push(0.0)).collect();
            write_surface(out, &SurfaceMesh::new(vertices, found.elements)).map_err(End::unusable)?;
            (points.len(), found.vertices.len())
        }
        Points::InSpace(points) => {
            fem_mesh::write::check_tetrahedra(out).map_err(End::unusable)?;
            let connect = |progress: Progress| tetrahedralize(&points, progress);
            let found = progress::with_share("connecting the points", connect).map_err(unusable)?.mesh;
            write_tetrahedra(out, &found).map_err(End::unusable)?;
            (points.len(), found.vertices.len())
        }
    };
    if vertices < count {
        say!("{} points are at the place of an earlier one and share its node", count - vertices);
    }
    Ok(())
}

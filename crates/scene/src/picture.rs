//! Triangles of a flat body inside the region of a picture.

use std::path::Path;

use fem_mesh::SurfaceMesh;

use crate::tables::PictureTable;

/// Reads and fills a picture. The error continues a sentence that begins with the field.
#[cfg(feature = "pictures")]
pub(crate) fn triangles(table: &PictureTable, file: &Path) -> Result<SurfaceMesh, String> {
    use fem_mesh::generate::picture::{FromPicture, mesh_picture, read_picture};

    let PictureTable { height, edge, improve, .. } = *table;
    let picture = read_picture(file).map_err(|error| format!("cannot be meshed: {error}"))?;
    let found = mesh_picture(&picture, FromPicture { edge, height, improve })
        .map_err(|error| format!("cannot be meshed: {}: {error}", file.display()))?;
    let vertices = found.mesh.vertices.iter().map(|x| x.push(0.0)).collect();
    Ok(SurfaceMesh::new(vertices, found.mesh.elements))
}

/// Programs without the feature read no pictures.
#[cfg(not(feature = "pictures"))]
pub(crate) fn triangles(_: &PictureTable, file: &Path) -> Result<SurfaceMesh, String> {
    let file = file.display();
    Err(format!("is {file}, and this program reads no pictures; build it with the feature `pictures` of fem-scene"))
}

//! Triangles of a flat body inside the region of a picture.

use std::path::Path;

use fem_mesh::SurfaceMesh;

use crate::tables::PictureTable;
use fem_model::simulation::PicturePlace;

/// The triangles of a picture, its place, and a remark on it.
type Filled = (SurfaceMesh, PicturePlace, Option<String>);

/// Reads and fills a picture; `scale` is a factor on the mesh that its user applies. The error continues a sentence that begins with the field.
#[cfg(feature = "pictures")]
pub(crate) fn triangles(table: &PictureTable, file: &Path, scale: f64) -> Result<Filled, String> {
    use fem_mesh::generate::picture::{FromPicture, mesh_picture, read_picture};

    let PictureTable { height, edge, improve, .. } = *table;
    let picture = read_picture(file).map_err(|error| format!("cannot be meshed: {error}"))?;
    let found = mesh_picture(&picture, FromPicture { edge, height, improve })
        .map_err(|error| format!("cannot be meshed: {}: {error}", file.display()))?;
    let vertices = found.mesh.vertices.iter().map(|x| x.push(0.0)).collect();
    let place = PicturePlace { file: file.to_owned(), origin: found.origin.into(), pixel: scale * found.pixel };
    Ok((SurfaceMesh::new(vertices, found.mesh.elements), place, picture.warning()))
}

/// Programs without the feature read no pictures.
#[cfg(not(feature = "pictures"))]
pub(crate) fn triangles(_: &PictureTable, file: &Path, _: f64) -> Result<Filled, String> {
    let file = file.display();
    Err(format!("is {file}, and this program reads no pictures; build it with the feature `pictures` of fem-scene"))
}

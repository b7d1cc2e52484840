//! Binary polygon files. Source: G. Turk, The PLY Polygon File Format (1994).

use std::io::{self, Write};

use crate::SurfaceMesh;

pub(super) fn write(out: &mut dyn Write, mesh: &SurfaceMesh) -> io::Result<()> {
    let (vertices, faces) = (mesh.vertices.len(), mesh.elements.len());
    write!(
        out,
        "ply\nformat binary_little_endian 1.0\nelement vertex {vertices}\nproperty double x\nproperty double y\nproperty double z\n\
         element face {faces}\nproperty list uchar int vertex_indices\nend_header\n"
    )?;
    for x in mesh.vertices.iter().flatten() {
        out.write_all(&x.to_le_bytes())?;
    }
    for element in &mesh.elements {
        out.write_all(&[3])?;
        for &i in element {
            let Ok(i) = i32::try_from(i) else {
                return Err(io::Error::other("the format holds at most 2 147 483 648 vertices"));
            };
            out.write_all(&i.to_le_bytes())?;
        }
    }
    Ok(())
}

//! Binary stereolithography files. Source: 3D Systems, StereoLithography Interface Specification (1989).

use std::io::{self, Write};

use nalgebra::Vector3;

use crate::SurfaceMesh;

/// Writes the triangles with their normals. The format keeps 32 bits of each coordinate.
pub(super) fn write(out: &mut dyn Write, mesh: &SurfaceMesh) -> io::Result<()> {
    let Ok(count) = u32::try_from(mesh.elements.len()) else {
        return Err(io::Error::other("the format holds at most 4 294 967 295 triangles"));
    };
    let title: [u8; 80] = std::array::from_fn(|i| *b"fem-mesh".get(i).unwrap_or(&b' '));
    out.write_all(&title)?;
    out.write_all(&count.to_le_bytes())?;
    for element in &mesh.elements {
        let [a, b, c] = element.map(|i| mesh.vertices[i]);
        let normal = (b - a).cross(&(c - a)).try_normalize(0.0).unwrap_or_else(Vector3::zeros);
        for x in [normal, a, b, c].iter().flatten() {
            out.write_all(&(*x as f32).to_le_bytes())?;
        }
        out.write_all(&[0, 0])?;
    }
    Ok(())
}

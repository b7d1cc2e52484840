//! Pairs of text files, counted from 0: TetGen's for tetrahedra, Triangle's for triangles in the plane. Named sets are regions and boundary
//! markers; those of faces make a third file. Sources: H. Si, TetGen manual
//! 1.6, section 5.2; J. R. Shewchuk, Triangle's page on .node and .ele files.

use std::io::{self, Write};
use std::path::Path;

use super::sets::Tags;
use super::{place, place_in_plane, save_mesh};
use crate::read::{pair, with_extension};
use crate::{Mesh, MeshError, Problem};

/// Writes `path` and its partner of the same stem; triangles with two coordinates, which have to lie in the plane z = 0.
pub(super) fn write<const N: usize>(path: &Path, mesh: &Mesh<3, N>) -> Result<(), MeshError> {
    let dimension = N - 1;
    if dimension == 2 && mesh.vertices.iter().any(|x| x.z != 0.0) {
        let found = "a surface outside of the plane z = 0 in a .node file".to_owned();
        let instead = "write it as .obj, .ply, .stl, .mesh, .msh, .vtu or .vtk";
        return Err(MeshError::in_file(path, Problem::Unsupported { found, instead }));
    }
    let [node_file, ele_file] = pair(path);
    let tags = Tags::of(mesh);
    save_mesh(&ele_file, &mut |out| {
        let regions = marks(&tags.elements);
        writeln!(out, "{}{} {N} {}", tags.comments(), mesh.elements.len(), usize::from(regions.is_some()))?;
        rows(out, mesh.elements.iter().map(|element| (&element[..], "".to_owned())), regions)
    })?;
    let face_file = with_extension(&node_file, "face");
    // A file of faces of another mesh would be read with this one.
    if !tags.faces.is_empty() || face_file.exists() {
        let markers: Vec<i32> = tags.faces.values().copied().collect();
        save_mesh(&face_file, &mut |out| {
            writeln!(out, "{} 1", tags.faces.len())?;
            rows(out, tags.faces.keys().map(|face| (&face[..], "".to_owned())), Some(&markers))
        })?;
    }
    save_mesh(&node_file, &mut |out| {
        let markers = marks(&tags.nodes);
        writeln!(out, "{} {dimension} 0 {}", mesh.vertices.len(), usize::from(markers.is_some()))?;
        let places = mesh.vertices.iter().map(|x| if dimension == 2 { place_in_plane(x) } else { place(x) });
        rows(out, places.map(|place| (&[][..], format!(" {place}"))), markers)
    })
}

/// The tags, unless all are 0.
fn marks(tags: &[i32]) -> Option<&[i32]> {
    tags.iter().any(|tag| *tag != 0).then_some(tags)
}

/// Rows of a number, nodes, a text and a tag.
fn rows<'a>(
    out: &mut dyn Write,
    entries: impl Iterator<Item = (&'a [usize], String)>,
    tags: Option<&[i32]>,
) -> io::Result<()> {
    for (i, (nodes, text)) in entries.enumerate() {
        write!(out, "{i}")?;
        nodes.iter().try_for_each(|node| write!(out, " {node}"))?;
        match tags {
            Some(tags) => writeln!(out, "{text} {}", tags[i])?,
            None => writeln!(out, "{text}")?,
        }
    }
    Ok(())
}

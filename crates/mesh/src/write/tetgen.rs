//! TetGen's pair of text files, counted from 0. Source: H. Si, TetGen manual 1.6, section 5.2.

use std::path::Path;

use super::{place, save_mesh};
use crate::read::{extension, with_extension};
use crate::{MeshError, TetrahedralMesh};

/// Writes `path` and its partner of the same stem.
pub(super) fn write(path: &Path, mesh: &TetrahedralMesh) -> Result<(), MeshError> {
    let (node_file, ele_file) = match extension(path).as_str() {
        "node" => (path.to_owned(), with_extension(path, "ele")),
        _ => (with_extension(path, "node"), path.to_owned()),
    };
    save_mesh(&ele_file, |out| {
        writeln!(out, "{} 4 0", mesh.elements.len())?;
        let mut elements = mesh.elements.iter().enumerate();
        elements.try_for_each(|(i, [a, b, c, d])| writeln!(out, "{i} {a} {b} {c} {d}"))
    })?;
    save_mesh(&node_file, |out| {
        writeln!(out, "{} 3 0 0", mesh.vertices.len())?;
        mesh.vertices.iter().enumerate().try_for_each(|(i, x)| writeln!(out, "{i} {}", place(x)))
    })
}

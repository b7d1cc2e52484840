//! Files compressed by gzip.

use std::fs;
use std::io::Write;

use fem_mesh::{
    Pattern, SurfaceMesh, boundary, box_mesh, read_surface, read_tetrahedra, write_surface, write_tetrahedra,
};
use flate2::Compression;
use flate2::write::GzEncoder;
use tempfile::tempdir;

use crate::folder_with;

fn packed(bytes: &[u8]) -> Vec<u8> {
    let mut encoder = GzEncoder::new(Vec::new(), Compression::default());
    encoder.write_all(bytes).unwrap();
    encoder.finish().unwrap()
}

#[test]
fn every_format_is_written_and_read_compressed() {
    let folder = tempdir().unwrap();
    let mesh = box_mesh([2.0, 1.0, 1.0], 3, Pattern::Alternating).unwrap();
    for name in ["a.node.gz", "b.ele.gz", "c.mesh.gz", "d.msh.gz", "e.vtu.gz", "F.VTU.GZ"] {
        let path = folder.path().join(name);
        write_tetrahedra(&path, &mesh).unwrap();
        assert_eq!(fs::read(&path).unwrap()[..2], [0x1f, 0x8b], "{name} is a gzip file");
        assert_eq!(read_tetrahedra(&path).unwrap(), mesh, "{name}");
    }
    assert!(folder.path().join("a.ele.gz").exists() && folder.path().join("b.node.gz").exists());
    let surface = SurfaceMesh::new(mesh.vertices.clone(), boundary(&mesh));
    write_surface(&folder.path().join("s.obj.gz"), &surface).unwrap();
    assert_eq!(read_surface(&folder.path().join("s.obj.gz")).unwrap(), surface);
}

#[test]
fn a_damaged_archive_is_refused() {
    let refusal = |name: &str, bytes: &[u8]| read_tetrahedra(&folder_with(&[(name, bytes)]).1).unwrap_err().to_string();
    let whole = packed(b"MeshVersionFormatted 2\nDimension 3\n");
    let message = refusal("m.mesh.gz", &whole[..whole.len() - 9]);
    assert!(message.contains("m.mesh.gz: it is no complete gzip file (") && message.contains("export"), "{message}");
    assert!(refusal("m.mesh.gz", b"MeshVersionFormatted 2").contains("it is no complete gzip file"));
    assert!(refusal("m.gz", &whole).contains("the extension `.` is unknown"), "{}", refusal("m.gz", &whole));
    assert!(refusal("m.msh.gz", &packed(&vec![b' '; 10_000_000])).contains("far too many bytes"));
}

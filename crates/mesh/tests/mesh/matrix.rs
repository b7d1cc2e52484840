//! One bar as Gmsh, TetGen, meshio, VTK, trimesh and MeshLab write it in their formats and options, in `other_programs/matrix/`, beside what each
//! program's own reader finds in its file.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use fem_mesh::{AnyMesh, MeshSet, check, read_file, surface_quality, volumes};
use serde_json::Value;

/// Points, edges, triangles and tetrahedra of a set; those of no part of it are left out.
fn counts(set: &MeshSet, is_body: bool) -> BTreeMap<&'static str, u64> {
    let elements = if is_body { "tetrahedra" } else { "triangles" };
    let counts = [("edges", set.edges.len()), ("triangles", set.faces.len()), (elements, set.elements.len())];
    counts.into_iter().filter(|(_, count)| *count > 0).map(|(name, count)| (name, count as u64)).collect()
}

#[test]
fn every_file_gives_what_the_reader_of_its_own_program_finds() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("mesh/other_programs/matrix");
    let expected: Value = serde_json::from_slice(&fs::read(folder.join("expected.json")).unwrap()).unwrap();
    let expected = expected.as_object().unwrap();
    assert!(expected.len() >= 52, "{}", expected.len());
    let mut wrong = Vec::new();
    for (name, expected) in expected {
        let path = folder.join(name);
        let found = match read_file(&path) {
            Ok(found) => found,
            Err(error) => {
                wrong.push(error.to_string());
                continue;
            }
        };
        let (nodes, elements, size, sets, is_body) = match &found.mesh {
            AnyMesh::Tetrahedra(mesh) => {
                check(mesh, &path).unwrap();
                (mesh.vertices.len(), mesh.elements.len(), volumes(mesh).iter().sum::<f64>(), &mesh.sets, true)
            }
            AnyMesh::Triangles(mesh) => {
                (mesh.vertices.len(), mesh.elements.len(), surface_quality(mesh).area, &mesh.sets, false)
            }
        };
        let counted = [expected["nodes"].as_u64(), expected["elements"].as_u64()];
        // Files of single precision differ by rounding.
        let is_same_size = (size - expected["size"].as_f64().unwrap().abs()).abs() < 1e-5;
        if counted != [Some(nodes as u64), Some(elements as u64)] || !is_same_size {
            wrong.push(format!("{name}: {nodes} nodes, {elements} elements, {size}, not {expected}"));
        }
        for (set, parts) in expected["sets"].as_object().unwrap() {
            let parts = parts
                .as_object()
                .unwrap()
                .iter()
                .filter(|(kind, count)| *kind != "points" && count.as_u64() != Some(0));
            let parts: BTreeMap<&str, u64> = parts.map(|(kind, count)| (&kind[..], count.as_u64().unwrap())).collect();
            let found = sets.get(set).map(|set| counts(set, is_body)).unwrap_or_default();
            if found != parts {
                wrong.push(format!("{name}: set {set}: {found:?}, not {parts:?}"));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

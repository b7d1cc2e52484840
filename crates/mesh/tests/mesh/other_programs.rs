//! Files that Gmsh and VTK have written, in `other_programs/`.

use std::path::{Path, PathBuf};

use fem_mesh::{TetrahedralMesh, check, read_tetrahedra, volumes};

fn files(ending: &str) -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("mesh/other_programs");
    let files = folder.read_dir().unwrap().map(|entry| entry.unwrap().path());
    files.filter(|path| path.extension().is_some_and(|found| found == ending)).collect()
}

fn is_the_bar(path: &Path) -> TetrahedralMesh {
    let mesh = read_tetrahedra(path).unwrap();
    check(&mesh, path).unwrap();
    assert_eq!((mesh.vertices.len(), mesh.elements.len()), (23, 48), "{}", path.display());
    assert!((volumes(&mesh).iter().sum::<f64>() - 2.0).abs() < 1e-12, "{}", path.display());
    mesh
}

#[test]
fn every_layout_of_vtk_and_of_gmsh_gives_the_same_bar() {
    let (gmsh, vtk) = (files("msh"), files("vtk"));
    assert_eq!((gmsh.len(), vtk.len()), (4, 6));
    for path in gmsh.iter().chain(&vtk) {
        is_the_bar(path);
    }
}

#[test]
fn physical_groups_of_gmsh_are_sets_in_every_layout() {
    for path in files("msh") {
        let mesh = is_the_bar(&path);
        let names: Vec<_> = mesh.sets.keys().map(String::as_str).collect();
        assert_eq!(names, ["clamped", "loaded", "soft part", "stiff"], "{}", path.display());
        for (name, side) in [("clamped", 0.0), ("loaded", 2.0)] {
            let faces = &mesh.sets[name].faces;
            assert_eq!(faces.len(), 4, "{}: {name}", path.display());
            assert!(faces.iter().flatten().all(|&node| (mesh.vertices[node].x - side).abs() < 1e-12));
        }
        for (name, from) in [("soft part", 0.0), ("stiff", 1.0)] {
            let elements = &mesh.sets[name].elements;
            assert_eq!(elements.len(), 24, "{}: {name}", path.display());
            let nodes = elements.iter().flat_map(|&element| mesh.elements[element]);
            assert!(nodes.map(|node| mesh.vertices[node].x - from).all(|x| (-1e-12..1.0 + 1e-12).contains(&x)));
        }
    }
}

//! Tetrahedra, surfaces and plane meshes through every format that can be written, and those that other programs write.

use std::path::Path;

use fem_mesh::generate::delaunay::triangulate;
use fem_mesh::{AnyMesh, MeshSet, Pattern, SurfaceMesh, TetrahedralMesh, boundary, box_mesh};
use fem_mesh::{read_mesh, read_surface, read_tetrahedra, surface_quality, write_mesh, write_surface};
use nalgebra::{Vector2, Vector3};
use tempfile::tempdir;

use crate::folder_with;

/// Formats of both kinds of meshes.
const MESHES: [&str; 6] = ["node", "ele", "mesh", "msh", "vtu", "vtk"];

/// Formats of triangles alone that keep double precision.
const SURFACES: [&str; 2] = ["obj", "ply"];

/// Writes the mesh in each format, plain and compressed, reads it, writes what was read in each format, and reads it again. Every mesh has to
/// be the first one, bit for bit, sets apart.
fn survives_every_pair(mesh: &AnyMesh, formats: &[&str]) {
    let folder = tempdir().unwrap();
    for (i, from) in formats.iter().enumerate() {
        let first = folder.path().join(format!("a{i}.{from}"));
        write_mesh(&first, mesh).unwrap();
        let found = read_mesh(&first).unwrap();
        assert_eq!(bits(&found), bits(mesh), "{from}");
        for (j, to) in formats.iter().enumerate() {
            let second = folder.path().join(format!("b{i}_{j}.{to}.gz"));
            write_mesh(&second, &found).unwrap();
            assert_eq!(bits(&read_mesh(&second).unwrap()), bits(mesh), "{from} to {to}");
        }
    }
}

/// The kind of a mesh, its elements, and the bits of its coordinates.
fn bits(mesh: &AnyMesh) -> (usize, Vec<usize>, Vec<u64>) {
    let bits = |vertices: &[Vector3<f64>]| vertices.iter().flatten().map(|x| x.to_bits()).collect();
    match mesh {
        AnyMesh::Tetrahedra(mesh) => (4, mesh.elements.concat(), bits(&mesh.vertices)),
        AnyMesh::Triangles(mesh) => (3, mesh.elements.concat(), bits(&mesh.vertices)),
    }
}

/// Numbers that need all of their digits, between -1 and 1.
fn digits(i: usize) -> f64 {
    (i as f64 * 12.9898).sin() / 3.0
}

fn plate() -> SurfaceMesh {
    let points: Vec<_> = (0..40).map(|i| Vector2::new(digits(i), 1e-7 * digits(1000 + i))).collect();
    let found = triangulate(&points).unwrap().mesh;
    SurfaceMesh::new(found.vertices.iter().map(|x| x.push(0.0)).collect(), found.elements)
}

fn cube() -> TetrahedralMesh {
    let mut mesh = box_mesh([1.0, 1.0, 1.0], 2, Pattern::Alternating).unwrap();
    for (i, x) in mesh.vertices.iter_mut().enumerate() {
        *x += 0.1 * Vector3::new(digits(3 * i), digits(3 * i + 1), digits(3 * i + 2));
    }
    mesh
}

#[test]
fn tetrahedra_survive_every_pair_of_formats() {
    survives_every_pair(&AnyMesh::Tetrahedra(cube()), &MESHES);
}

#[test]
fn plane_meshes_survive_every_pair_of_formats() {
    survives_every_pair(&AnyMesh::Triangles(plate()), &[&MESHES[..], &SURFACES].concat());
}

#[test]
fn surfaces_survive_every_pair_of_formats_apart_from_those_of_the_plane() {
    // The nodes of a surface alone: formats of bodies leave out those of no element.
    let mut elements = boundary(&cube());
    let mut used: Vec<usize> = elements.concat();
    used.sort_unstable();
    used.dedup();
    elements.iter_mut().flatten().for_each(|node| *node = used.binary_search(node).unwrap());
    let surface = SurfaceMesh::new(used.iter().map(|&node| cube().vertices[node]).collect(), elements);
    survives_every_pair(&AnyMesh::Triangles(surface.clone()), &[&MESHES[2..], &SURFACES].concat());
    let message = write_surface(Path::new("a.node"), &surface).unwrap_err().to_string();
    assert!(message.contains("a surface outside of the plane z = 0 in a .node file is not supported"), "{message}");
}

#[test]
fn stl_keeps_single_precision_of_every_surface() {
    let folder = tempdir().unwrap();
    let path = folder.path().join("a.stl");
    write_surface(&path, &plate()).unwrap();
    let found = read_surface(&path).unwrap();
    let places = |mesh: &SurfaceMesh| -> Vec<Vector3<f64>> {
        mesh.elements.iter().flatten().map(|&vertex| mesh.vertices[vertex]).collect()
    };
    let single: Vec<_> = places(&plate()).iter().map(|x| x.map(|x| f64::from(x as f32))).collect();
    assert_eq!(places(&found), single);
}

#[test]
fn named_sets_of_a_plane_mesh_survive_gmsh_files() {
    let mut mesh = plate();
    let [a, b, c] = mesh.elements[3];
    let sets = [
        ("all", MeshSet { elements: (0..mesh.elements.len()).collect(), ..MeshSet::default() }),
        ("side", MeshSet { edges: vec![[a.min(b), a.max(b)]], points: vec![c], ..MeshSet::default() }),
        ("some", MeshSet { elements: vec![0, 3, 7], ..MeshSet::default() }),
    ];
    mesh.sets = sets.into_iter().map(|(name, set)| (name.to_owned(), set)).collect();
    let folder = tempdir().unwrap();
    let path = folder.path().join("a.msh");
    write_surface(&path, &mesh).unwrap();
    assert_eq!(read_surface(&path).unwrap(), mesh);
    assert_eq!(mesh.sets["some"].counts_of_triangles(), "3 triangles");
    assert_eq!(mesh.sets["side"].nodes(|element| &mesh.elements[element]).len(), 3);
}

#[test]
fn a_plate_of_other_programs_is_the_same_in_every_file() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("mesh/other_programs/plane");
    let mut files = 0;
    for path in folder.read_dir().unwrap().map(|entry| entry.unwrap().path()) {
        let mesh = read_surface(&path).unwrap();
        assert_eq!((mesh.vertices.len(), mesh.elements.len()), (22, 28), "{}", path.display());
        let found = surface_quality(&mesh);
        assert!((found.area - 1.75).abs() < 1e-6 && found.euler_characteristic == 0, "{}: {found}", path.display());
        assert_eq!(read_mesh(&path).unwrap(), AnyMesh::Triangles(mesh.clone()));
        assert!(read_tetrahedra(&path).unwrap_err().to_string().contains("a mesh of 28 triangles in place of"));
        if path.extension().is_some_and(|extension| extension == "msh") {
            let names: Vec<_> = mesh.sets.keys().map(String::as_str).collect();
            assert_eq!(names, ["clamped", "plate"], "{}", path.display());
            assert_eq!((mesh.sets["plate"].elements.len(), mesh.sets["clamped"].edges.len()), (28, 2));
        }
        files += 1;
    }
    assert_eq!(files, 15);
}

#[test]
fn polygons_of_grids_become_fans_and_curved_ones_are_refused_in_a_surface() {
    let grid = |cells: &str| {
        let points = "POINTS 5 float\n0 0 0 1 0 0 1 1 0 0 1 0 0 0 1\n";
        let text = format!("# vtk DataFile Version 3.0\nt\nASCII\nDATASET UNSTRUCTURED_GRID\n{points}{cells}");
        read_mesh(&folder_with(&[("m.vtk", text.as_bytes())]).1)
    };
    let AnyMesh::Triangles(mesh) = grid("CELLS 3 12\n4 0 1 2 3\n2 0 1\n3 0 1 4\nCELL_TYPES 3\n9 3 5\n").unwrap() else {
        panic!("a surface")
    };
    assert_eq!(mesh.elements, [[0, 1, 2], [0, 2, 3], [0, 1, 4]]);
    let refusal = grid("CELLS 2 9\n3 0 1 4\n4 0 1 2 3\nCELL_TYPES 2\n5 8\n").unwrap_err().to_string();
    assert!(refusal.contains("a surface of pixels (VTK's cell type 8) is not supported; split the"), "{refusal}");
    let beside = grid("CELLS 2 10\n4 0 1 2 3\n4 0 1 2 4\nCELL_TYPES 2\n8 10\n").unwrap();
    assert!(matches!(beside, AnyMesh::Tetrahedra(mesh) if mesh.elements == [[0, 1, 2, 3]]));
    let empty = grid("CELLS 0 0\nCELL_TYPES 0\n").unwrap_err().to_string();
    assert!(empty.contains("the mesh has no tetrahedra or triangles; give one that has some"), "{empty}");
}

#[test]
fn a_body_in_place_of_a_surface_is_refused() {
    let folder = tempdir().unwrap();
    let path = folder.path().join("a.vtk");
    write_mesh(&path, &AnyMesh::Tetrahedra(cube())).unwrap();
    let message = read_surface(&path).unwrap_err().to_string();
    assert!(message.contains("a mesh of 48 tetrahedra in place of triangles is not supported; give a"), "{message}");
}

//! Mutated bytes for every reader of mesh files and of pictures: it reads them or refuses them, without a panic, without a hang, and without
//! memory beyond four times the file.

mod mutation;
mod pictures;
mod rows;

use std::fs;
use std::io::{Read, Write};
use std::path::{Path, PathBuf};

use fem_mesh::generate::delaunay::triangulate;
use fem_mesh::{
    AnyMesh, MeshError, Pattern, SurfaceMesh, TetrahedralMesh, boundary, box_mesh, check, quality, surface_quality,
};
use fem_mesh::{read_mesh, read_points, read_surface, read_tetrahedra, write_mesh};
use flate2::Compression;
use flate2::read::MultiGzDecoder;
use flate2::write::GzEncoder;
use nalgebra::{Vector2, Vector3};
use tempfile::{TempDir, tempdir};

use self::mutation::{fuzz, write_over};

/// Files of other programs.
fn others(ending: &str) -> Vec<Vec<u8>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("mesh/other_programs");
    let mut files: Vec<PathBuf> = [folder.clone(), folder.join("plane")]
        .iter()
        .flat_map(|folder| folder.read_dir().unwrap().map(|entry| entry.unwrap().path()))
        .filter(|path| path.extension().is_some_and(|found| found == ending))
        .collect();
    files.sort();
    files.into_iter().map(|path| fs::read(path).unwrap()).collect()
}

/// Coordinates with all digits.
fn digits(i: usize) -> f64 {
    (i as f64 * 12.9898).sin() / 3.0
}

fn body() -> TetrahedralMesh {
    let mut mesh = box_mesh([1.0, 1.0, 1.0], 2, Pattern::Alternating).unwrap();
    for (i, x) in mesh.vertices.iter_mut().enumerate() {
        *x += 0.1 * Vector3::new(digits(3 * i), digits(3 * i + 1), digits(3 * i + 2));
    }
    let side = fem_mesh::MeshSet { elements: (0..20).collect(), points: vec![3], ..Default::default() };
    mesh.sets.insert("some".to_owned(), side);
    mesh
}

fn plate() -> SurfaceMesh {
    let points: Vec<_> = (0..40).map(|i| Vector2::new(digits(i), digits(1000 + i))).collect();
    let found = triangulate(&points).unwrap().mesh;
    SurfaceMesh::new(found.vertices.iter().map(|x| x.push(0.0)).collect(), found.elements)
}

/// Files that this library writes with an ending: a body, its surface and a plane mesh, as far as the format has them.
fn own(ending: &str) -> Vec<Vec<u8>> {
    let folder = tempdir().unwrap();
    let surface = SurfaceMesh::new(body().vertices, boundary(&body()));
    let meshes = [AnyMesh::Tetrahedra(body()), AnyMesh::Triangles(surface), AnyMesh::Triangles(plate())];
    let path = folder.path().join(format!("m.{ending}"));
    meshes.iter().filter_map(|mesh| write_mesh(&path, mesh).ok().map(|()| fs::read(&path).unwrap())).collect()
}

/// Reads a file in every way.
fn read(path: &Path) -> Result<AnyMesh, MeshError> {
    let _ = (read_tetrahedra(path).is_ok(), read_surface(path).is_ok(), read_points(path).is_ok());
    read_mesh(path)
}

/// Asserts the guarantees of a reader for a mesh, and uses the mesh.
fn go_on(found: Result<AnyMesh, MeshError>) {
    match found {
        Ok(AnyMesh::Tetrahedra(mesh)) => {
            assert!(mesh.elements.iter().flatten().all(|&i| i < mesh.vertices.len()));
            assert!(mesh.vertices.iter().flatten().all(|x| x.is_finite()));
            if check(&mesh, "m".as_ref()).is_ok() {
                assert!(!boundary(&mesh).is_empty() && quality(&mesh).to_string().len() < 5000);
            }
        }
        Ok(AnyMesh::Triangles(mesh)) => {
            assert!(mesh.elements.iter().flatten().all(|&i| i < mesh.vertices.len()));
            assert!(mesh.vertices.iter().flatten().all(|x| x.is_finite()));
            assert_eq!(surface_quality(&mesh).triangles, mesh.elements.len());
        }
        Err(error) => {
            let message = error.to_string();
            assert!(message.len() < 1000 && message.lines().count() == 1, "{message}");
        }
    }
}

/// Mutations of files with that ending; a second file of the pair stays as it is.
fn fuzz_files(ending: &str, files: &[Vec<u8>], partner: Option<(&str, Vec<u8>)>) {
    let folder: TempDir = tempdir().unwrap();
    let path = folder.path().join(format!("m.{ending}"));
    let mut beside = 0;
    if let Some((ending, bytes)) = partner {
        fs::write(folder.path().join(format!("m.{ending}")), &bytes).unwrap();
        beside = bytes.len();
    }
    let size = |bytes: &[u8]| beside + if ending.ends_with(".gz") { unpacked(bytes) } else { bytes.len() };
    let prepare = |bytes: &[u8]| write_over(&path, bytes);
    fuzz(ending, files, size, prepare, |()| read(&path), go_on);
}

/// Bytes that a compressed file holds, as far as a reader unpacks them.
fn unpacked(bytes: &[u8]) -> usize {
    let mut all = Vec::new();
    let _ = MultiGzDecoder::new(bytes).take(200 * bytes.len() as u64).read_to_end(&mut all);
    all.len()
}

fn packed(bytes: &[u8]) -> Vec<u8> {
    let mut encoder = GzEncoder::new(Vec::new(), Compression::default());
    encoder.write_all(bytes).unwrap();
    encoder.finish().unwrap()
}

#[test]
fn mutated_files_of_gmsh_are_read_or_refused() {
    fuzz_files("msh", &[own("msh"), others("msh")].concat(), None);
}

#[test]
fn mutated_files_of_vtk_are_read_or_refused() {
    fuzz_files("vtk", &[own("vtk"), others("vtk")].concat(), None);
}

#[test]
fn mutated_grids_of_vtk_are_read_or_refused() {
    let appended = include_bytes!("../mesh/appended.vtu").to_vec();
    fuzz_files("vtu", &[own("vtu"), others("vtu"), vec![appended]].concat(), None);
}

#[test]
fn mutated_files_of_abaqus_are_read_or_refused() {
    fuzz_files("inp", &own("inp"), None);
}

#[test]
fn mutated_files_of_medit_are_read_or_refused() {
    fuzz_files("mesh", &[own("mesh"), others("mesh")].concat(), None);
}

#[test]
fn mutated_files_of_tetgen_and_triangle_are_read_or_refused() {
    let pair = |which: usize| (own("node")[which].clone(), own("ele")[which].clone());
    for which in [0, 1] {
        let (nodes, elements) = pair(which);
        fuzz_files("node", &[nodes.clone(), others("node").remove(0)], Some(("ele", elements.clone())));
        fuzz_files("ele", &[elements, others("ele").remove(0)], Some(("node", nodes)));
    }
}

#[test]
fn mutated_surfaces_are_read_or_refused() {
    fuzz_files("obj", &own("obj"), None);
    fuzz_files("ply", &[own("ply"), vec![text_ply()]].concat(), None);
    fuzz_files("stl", &[own("stl"), vec![text_stl()]].concat(), None);
}

/// The plate as a text with a colour for each vertex, and its faces as quadrangles where the list says so.
fn text_ply() -> Vec<u8> {
    let mesh = plate();
    let mut text = format!(
        "ply\nformat ascii 1.0\ncomment by hand\nelement vertex {}\nproperty double x\nproperty double y\nproperty double z\n\
         property uchar red\nelement face {}\nproperty list uchar int vertex_indices\nend_header\n",
        mesh.vertices.len(),
        mesh.elements.len()
    );
    mesh.vertices.iter().for_each(|x| text += &format!("{} {} {} 7\n", x.x, x.y, x.z));
    mesh.elements.iter().for_each(|[a, b, c]| text += &format!("3 {a} {b} {c}\n"));
    text.into_bytes()
}

fn text_stl() -> Vec<u8> {
    let mesh = plate();
    let facet = |element: &[usize; 3]| {
        let corners = element.map(|i| mesh.vertices[i]);
        let lines = corners.map(|x| format!("vertex {} {} {}\n", x.x, x.y, x.z)).concat();
        format!("facet normal 0 0 1\nouter loop\n{lines}endloop\nendfacet\n")
    };
    format!("solid plate\n{}endsolid\n", mesh.elements.iter().map(facet).collect::<String>()).into_bytes()
}

#[test]
fn mutated_points_are_read_or_refused() {
    let row = |i: usize, d: usize| (0..d).map(|k| digits(d * i + k).to_string()).collect::<Vec<_>>().join(",");
    let table = |d: usize| (0..60).map(|i| row(i, d) + "\n").collect::<String>().into_bytes();
    let named = [&b"x;y;z\n"[..], &table(3)].concat();
    fuzz_files("csv", &[table(2), table(3), named], None);
}

#[test]
fn mutated_compressed_files_are_read_or_refused() {
    for ending in ["msh", "vtu", "vtk", "mesh", "obj", "ply", "stl"] {
        let files: Vec<Vec<u8>> = own(ending).iter().map(|bytes| packed(bytes)).collect();
        fuzz_files(&format!("{ending}.gz"), &files, None);
    }
}

#[test]
fn compressed_files_with_mutated_content_are_read_or_refused() {
    let folder = tempdir().unwrap();
    let path = folder.path().join("m.msh.gz");
    let prepare = |bytes: &[u8]| write_over(&path, &packed(bytes));
    fuzz("msh in gz", &own("msh"), <[u8]>::len, prepare, |()| read(&path), go_on);
}

#[test]
fn a_large_file_takes_at_most_four_times_its_size() {
    let folder = tempdir().unwrap();
    let mut mesh = box_mesh([1.0, 1.0, 1.0], 16, Pattern::Alternating).unwrap();
    for (i, x) in mesh.vertices.iter_mut().enumerate() {
        *x += 0.01 * Vector3::new(digits(3 * i), digits(3 * i + 1), digits(3 * i + 2));
    }
    let surface = SurfaceMesh::new(mesh.vertices.clone(), boundary(&mesh));
    let plane = SurfaceMesh::new(mesh.vertices.iter().map(|x| Vector3::new(x.x, x.y, 0.0)).collect(), boundary(&mesh));
    let kinds = [
        (AnyMesh::Tetrahedra(mesh), &["node", "mesh", "msh", "vtu", "vtk", "inp"][..]),
        (AnyMesh::Triangles(surface), &["obj", "ply", "stl", "mesh", "msh", "vtu", "vtk"]),
        (AnyMesh::Triangles(plane), &["node"]),
    ];
    for (mesh, endings) in kinds {
        for ending in endings {
            let path = folder.path().join(format!("m.{ending}"));
            write_mesh(&path, &mesh).unwrap();
            let mut size = fs::metadata(&path).unwrap().len();
            if *ending == "node" {
                size += fs::metadata(path.with_extension("ele")).unwrap().len();
            }
            let used = allocation_counter::measure(|| drop(read_mesh(&path).unwrap())).bytes_max;
            println!("{ending}: {size} bytes, memory {:.2} times the file", used as f64 / size as f64);
            assert!(used <= 4 * size, "{ending}: {used} bytes of memory for a file of {size}");
        }
    }
}

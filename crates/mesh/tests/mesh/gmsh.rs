//! Gmsh's versions, as text and binary, and physical groups.

use std::fs;

use fem_mesh::{
    MeshSet, Pattern, TetrahedralMesh, box_mesh, check, read_tetrahedra, refine, volumes, write_tetrahedra,
};
use nalgebra::Vector3;

use crate::folder_with;

fn read(bytes: &[u8]) -> TetrahedralMesh {
    read_tetrahedra(&folder_with(&[("m.msh", bytes)]).1).unwrap()
}

fn refusal(bytes: &[u8]) -> String {
    read_tetrahedra(&folder_with(&[("m.msh", bytes)]).1).unwrap_err().to_string()
}

/// Two tetrahedra glued on a face, with a set in every dimension.
fn with_sets() -> TetrahedralMesh {
    let vertices = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 1.0, 1.0]];
    let mut mesh = TetrahedralMesh::new(vertices.map(Vector3::from).to_vec(), vec![[0, 1, 2, 3], [1, 2, 3, 4]]);
    let sets = [
        ("tip", MeshSet { points: vec![3], ..MeshSet::default() }),
        ("an edge", MeshSet { edges: vec![[0, 1]], ..MeshSet::default() }),
        ("floor", MeshSet { faces: vec![[0, 1, 2]], ..MeshSet::default() }),
        ("all", MeshSet { elements: vec![0, 1], ..MeshSet::default() }),
        ("7", MeshSet { elements: vec![1], ..MeshSet::default() }),
    ];
    mesh.sets = sets.into_iter().map(|(name, set)| (name.to_owned(), set)).collect();
    mesh
}

const NAMES: &str = "$PhysicalNames\n4\n0 1 \"tip\"\n1 2 \"an edge\"\n2 3 \"floor\"\n3 4 \"all\"\n$EndPhysicalNames\n";

/// The same mesh as Gmsh 2.2 text. The second tetrahedron belongs to two groups and stands there twice.
fn text_2() -> String {
    format!(
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n{NAMES}$Nodes\n5\n10 0 0 0\n20 1 0 0\n30 0 1 0\n40 0 0 1\n50 1 1 1\n$EndNodes\n\
         $Elements\n6\n1 15 2 1 1 40\n2 1 2 2 1 20 10\n3 2 2 3 1 30 10 20\n4 4 2 4 1 10 20 30 40\n5 4 2 4 2 20 30 40 50\n\
         6 4 2 7 2 20 30 40 50\n$EndElements\n"
    )
}

fn ints(values: &[i32]) -> Vec<u8> {
    values.iter().flat_map(|value| value.to_le_bytes()).collect()
}

fn longs(values: &[u64]) -> Vec<u8> {
    values.iter().flat_map(|value| value.to_le_bytes()).collect()
}

fn reals(values: &[f64]) -> Vec<u8> {
    values.iter().flat_map(|value| value.to_le_bytes()).collect()
}

/// The same mesh as Gmsh 2.2 binary.
pub fn binary_2() -> Vec<u8> {
    let mut bytes = b"$MeshFormat\n2.2 1 8\n".to_vec();
    bytes.extend(ints(&[1]));
    bytes.extend(format!("\n$EndMeshFormat\n{NAMES}$Nodes\n5\n").bytes());
    for (vertex, tag) in with_sets().vertices.iter().zip([10, 20, 30, 40, 50]) {
        bytes.extend(ints(&[tag]));
        bytes.extend(reals(vertex.as_slice()));
    }
    bytes.extend(b"\n$EndNodes\n$Elements\n6\n");
    bytes.extend(ints(&[15, 1, 2, 1, 1, 1, 40]));
    bytes.extend(ints(&[1, 1, 2, 2, 2, 1, 20, 10]));
    bytes.extend(ints(&[2, 1, 2, 3, 3, 1, 30, 10, 20]));
    bytes.extend(ints(&[4, 3, 2, 4, 4, 1, 10, 20, 30, 40, 5, 4, 2, 20, 30, 40, 50, 6, 7, 2, 20, 30, 40, 50]));
    bytes.extend(b"\n$EndElements\n");
    bytes
}

/// Tag, extent, physical groups, and no bounding entities, of an entity of 4.1 binary.
fn entity(dimension: usize, tag: i32, groups: &[i32]) -> Vec<u8> {
    let extent = if dimension == 0 { 3 } else { 6 };
    let bounding = if dimension == 0 { vec![] } else { longs(&[0]) };
    [ints(&[tag]), reals(&vec![0.0; extent]), longs(&[groups.len() as u64]), ints(groups), bounding].concat()
}

/// The same mesh as Gmsh 4.1 binary, with a section that is skipped.
pub fn binary_4() -> Vec<u8> {
    let mut bytes = b"$MeshFormat\n4.1 1 8\n".to_vec();
    bytes.extend(ints(&[1]));
    bytes.extend(format!("\n$EndMeshFormat\n{NAMES}$Entities\n").bytes());
    bytes.extend(longs(&[1, 1, 1, 2]));
    bytes.extend(entity(0, 1, &[1]));
    bytes.extend(entity(1, 1, &[2]));
    bytes.extend(entity(2, 1, &[-3]));
    bytes.extend(entity(3, 1, &[4]));
    bytes.extend(entity(3, 2, &[4, 7]));
    bytes.extend(b"\n$EndEntities\n$Nodes\n");
    bytes.extend([longs(&[2, 5, 10, 50]), ints(&[2, 1, 1]), longs(&[3, 10, 20, 30])].concat());
    for vertex in &with_sets().vertices[..3] {
        bytes.extend(reals(&[vertex.x, vertex.y, vertex.z, 0.25, 0.75]));
    }
    bytes.extend([ints(&[3, 1, 0]), longs(&[2, 40, 50]), reals(&[0.0, 0.0, 1.0, 1.0, 1.0, 1.0])].concat());
    bytes.extend(b"\n$EndNodes\n$Periodic\n\x00\x01$\xff\n$EndPeriodic\n$Elements\n");
    bytes.extend(longs(&[5, 5, 1, 5]));
    bytes.extend([ints(&[0, 1, 15]), longs(&[1, 1, 40])].concat());
    bytes.extend([ints(&[1, 1, 1]), longs(&[1, 2, 20, 10])].concat());
    bytes.extend([ints(&[2, 1, 2]), longs(&[1, 3, 30, 10, 20])].concat());
    bytes.extend([ints(&[3, 1, 4]), longs(&[1, 4, 10, 20, 30, 40])].concat());
    bytes.extend([ints(&[3, 2, 4]), longs(&[1, 5, 20, 30, 40, 50])].concat());
    bytes.extend(b"\n$EndElements\n");
    bytes
}

#[test]
fn versions_2_2_and_4_1_give_the_same_mesh_and_sets_as_text_and_binary() {
    assert_eq!(read(text_2().as_bytes()), with_sets());
    assert_eq!(read(text_2().replace('\n', "\r\n").as_bytes()), with_sets());
    assert_eq!(read(&binary_2()), with_sets());
    assert_eq!(read(&binary_4()), with_sets());
}

#[test]
fn written_sets_come_back() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("m.msh");
    write_tetrahedra(&path, &with_sets()).unwrap();
    let text = fs::read_to_string(&path).unwrap();
    assert!(text.contains("$PhysicalNames\n5\n") && text.contains("\"an edge\""), "{text}");
    assert_eq!(read_tetrahedra(&path).unwrap(), with_sets());
}

#[test]
fn groups_of_one_name_or_number_in_two_dimensions_are_one_set_whose_nodes_are_those_of_the_lower() {
    let text = text_2().replace(NAMES, "").replace(" 2 2 3 1 30 10 20", " 2 2 4 1 30 10 20");
    let mesh = read(text.as_bytes());
    let set = &mesh.sets["4"];
    assert_eq!((set.faces.len(), set.elements.len()), (1, 2));
    assert_eq!(set.nodes(|element| &mesh.elements[element]), [0, 1, 2]);
    assert_eq!(mesh.sets["7"].nodes(|element| &mesh.elements[element]), [1, 2, 3, 4]);
}

#[test]
fn a_set_keeps_its_part_of_the_body_when_the_mesh_is_refined() {
    let mut mesh = box_mesh([2.0, 1.0, 1.0], 1, Pattern::Alternating).unwrap();
    let half = |mesh: &TetrahedralMesh, element: &[usize; 4]| element.iter().all(|&node| mesh.vertices[node].x <= 1.0);
    let elements = (0..12).filter(|&element| half(&mesh, &mesh.elements[element])).collect();
    mesh.sets
        .insert("half".to_owned(), MeshSet { elements, faces: vec![[0, 1, 4]], edges: vec![[0, 4]], points: vec![5] });
    let fine = refine(mesh, 2, "test".as_ref()).unwrap();
    check(&fine, "test".as_ref()).unwrap();
    let set = &fine.sets["half"];
    let volume: f64 = set.elements.iter().map(|&element| volumes(&fine)[element]).sum();
    approx::assert_relative_eq!(volume, 1.0, max_relative = 1e-12);
    assert!(set.elements.iter().all(|&element| half(&fine, &fine.elements[element])));
    assert_eq!((set.faces.len(), set.edges.len(), &set.points[..]), (16, 4, &[5][..]));
    let area: f64 = set.faces.iter().map(|face| fem_mesh::area_vector(face.map(|i| fine.vertices[i])).norm()).sum();
    approx::assert_relative_eq!(area, 0.5, max_relative = 1e-12);
}

#[test]
fn a_set_with_a_part_that_the_mesh_lacks_is_refused() {
    let refused = |set: MeshSet, part: &str| {
        let mut mesh = with_sets();
        mesh.sets.insert("bad".to_owned(), set);
        let message = check(&mesh, "m.msh".as_ref()).unwrap_err().to_string();
        assert!(message.contains("the set `bad` has ") && message.contains(part), "{message}");
    };
    refused(MeshSet { elements: vec![2], ..MeshSet::default() }, "the element 2");
    refused(MeshSet { faces: vec![[0, 1, 4]], ..MeshSet::default() }, "the triangle [0, 1, 4]");
    refused(MeshSet { edges: vec![[0, 4]], ..MeshSet::default() }, "the edge [0, 4]");
    refused(MeshSet { points: vec![5], ..MeshSet::default() }, "the node 5");
}

#[test]
fn every_truncation_of_a_binary_file_is_refused_or_gives_a_mesh_that_the_check_judges() {
    for whole in [binary_2(), binary_4()] {
        for length in (0..whole.len()).step_by(3) {
            let (_folder, path) = folder_with(&[("m.msh", &whole[..length])]);
            if let Ok(mesh) = read_tetrahedra(&path) {
                assert!(mesh == with_sets() || check(&mesh, &path).is_err(), "{length} bytes");
            }
        }
    }
}

#[test]
fn bad_binary_files_are_refused_at_their_byte() {
    let at = |bytes: &[u8], pattern: &[u8]| bytes.windows(pattern.len()).position(|window| window == pattern).unwrap();
    let mut big_endian = binary_4();
    big_endian[20..24].copy_from_slice(&1_i32.to_be_bytes());
    let message = refusal(&big_endian);
    assert!(message.contains("a big-endian binary file is not supported; convert it with"), "{message}");

    let mut endless = binary_4();
    let nodes = at(&endless, b"$Nodes\n") + 7;
    endless[nodes + 8 * 4 + 12..][..8].copy_from_slice(&u64::MAX.to_le_bytes());
    let message = refusal(&endless);
    assert!(message.contains(", byte ") && message.contains("is not the number of nodes of the block"), "{message}");
    endless[nodes + 8 * 4 + 12..][..8].copy_from_slice(&(1_u64 << 60).to_le_bytes());
    assert!(refusal(&endless).contains("m.msh, byte "), "a count beyond the file");

    let mut hexahedra = binary_2();
    let elements = at(&hexahedra, b"$Elements\n") + 12;
    hexahedra[elements..elements + 4].copy_from_slice(&5_i32.to_le_bytes());
    assert!(refusal(&hexahedra).contains("a mesh of hexahedra (Gmsh's element type 5)"));
    let short = &binary_4()[..nodes + 30];
    assert!(refusal(short).contains(&format!("m.msh, byte {}: ", nodes + 8 * 3)), "{}", refusal(short));
}

#[test]
fn volumes_other_than_tetrahedra_are_refused_by_their_name() {
    let with_kind = |kind: &str| refusal(text_2().replace("4 4 2 4 1", &format!("4 {kind} 2 4 1")).as_bytes());
    for (kind, name) in [("5", "hexahedra"), ("6", "prisms"), ("7", "pyramids"), ("29", "tetrahedra with 20 nodes")] {
        let message = with_kind(kind);
        assert!(message.contains(&format!("line 24: a mesh of {name} (Gmsh's")), "{message}");
        assert!(message.contains("mesh the volumes with tetrahedra of first order"), "{message}");
    }
    let message = refusal(text_2().replace("3 2 2 3 1 30 10 20", "3 3 2 3 1 30 10 20 40").as_bytes());
    assert!(message.contains("a physical group of quadrangles (Gmsh's element type 3) is not supported"), "{message}");
}

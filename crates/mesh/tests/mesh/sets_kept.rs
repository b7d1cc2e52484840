//! Named sets in every format that can hold them, and Abaqus's files.

use fem_mesh::{
    AnyMesh, Mesh, MeshSet, Pattern, SurfaceMesh, TetrahedralMesh, box_mesh, check, rectangle_mesh, volumes,
    write::lost_sets,
};
use fem_mesh::{read_file, read_mesh, read_surface, read_tetrahedra, write_mesh};
use tempfile::tempdir;

use crate::folder_with;

/// Disjoint sets of every kind of part, with names and numbers.
fn body() -> TetrahedralMesh {
    let mut mesh = box_mesh([2.0, 1.0, 1.0], 1, Pattern::Alternating).unwrap();
    let face = |element: usize, skipped: usize| {
        let mut nodes: Vec<usize> = (0..4).filter(|i| *i != skipped).map(|i| mesh.elements[element][i]).collect();
        nodes.sort_unstable();
        [nodes[0], nodes[1], nodes[2]]
    };
    let mut faces = vec![face(0, 0), face(5, 2)];
    faces.sort_unstable();
    let [a, b, ..] = mesh.elements[3];
    let sets = [
        ("7", MeshSet { elements: vec![0, 1, 2], ..MeshSet::default() }),
        ("soft part", MeshSet { elements: vec![4, 11], ..MeshSet::default() }),
        ("clamped", MeshSet { faces, ..MeshSet::default() }),
        ("line", MeshSet { edges: vec![[a.min(b), a.max(b)]], ..MeshSet::default() }),
        ("ends", MeshSet { points: vec![0, 5], ..MeshSet::default() }),
    ];
    mesh.sets = sets.into_iter().map(|(name, set)| (name.to_owned(), set)).collect();
    mesh
}

#[test]
fn sets_survive_every_format_that_can_hold_them() {
    let folder = tempdir().unwrap();
    for format in ["msh", "vtu", "vtk", "mesh"] {
        let path = folder.path().join(format!("a.{format}"));
        assert_eq!(lost_sets(&path, &body()), None, "{format}");
        write_mesh(&path, &AnyMesh::Tetrahedra(body())).unwrap();
        let found = read_file(&path).unwrap();
        assert_eq!(found.mesh, AnyMesh::Tetrahedra(body()), "{format}");
        assert!(found.notes.is_empty(), "{format}: {:?}", found.notes);
    }
    let path = folder.path().join("a.inp");
    assert!(lost_sets(&path, &body()).unwrap().contains("of 1 edges of sets this format keeps the nodes"));
    write_mesh(&path, &AnyMesh::Tetrahedra(body())).unwrap();
    let mut expected = body();
    let line = expected.sets.remove("line").unwrap();
    expected.sets.insert("line".to_owned(), MeshSet { points: line.edges[0].to_vec(), ..MeshSet::default() });
    assert_eq!(read_tetrahedra(&path).unwrap(), expected);
    let path = folder.path().join("a.node");
    assert!(lost_sets(&path, &body()).unwrap().contains("loses 1 edges of sets; .msh, .vtu and .vtk keep all"));
    write_mesh(&path, &AnyMesh::Tetrahedra(body())).unwrap();
    let mut expected = body();
    expected.sets.remove("line");
    assert_eq!(read_tetrahedra(&path).unwrap(), expected);
}

#[test]
fn sets_of_a_plate_survive_every_format_that_can_hold_them() {
    let folder = tempdir().unwrap();
    let mut plate = rectangle_mesh([1.0, 1.0], 3, Pattern::Alternating).unwrap();
    plate.sets.insert("some".to_owned(), MeshSet { elements: vec![0, 3, 7], ..MeshSet::default() });
    for format in ["msh", "vtu", "vtk", "inp", "mesh", "node", "obj"] {
        let path = folder.path().join(format!("a.{format}"));
        assert_eq!(lost_sets(&path, &plate), None, "{format}");
        write_mesh(&path, &AnyMesh::Triangles(plate.clone())).unwrap();
        assert_eq!(read_surface(&path).unwrap(), plate, "{format}");
    }
    plate.sets.insert("more".to_owned(), MeshSet { elements: vec![3, 4], ..MeshSet::default() });
    let told = lost_sets("a.mesh".as_ref(), &plate).unwrap();
    assert!(told.contains("loses 1 parts that are in several sets"), "{told}");
    assert!(lost_sets("a.ply".as_ref(), &plate).unwrap().contains("this format has no sets, and the mesh 2"));
}

#[test]
fn fields_of_integers_are_sets_by_their_numbers_and_further_ones_by_their_names_too() {
    let grid = |data: &str| {
        let points = "POINTS 5 float\n0 0 0 1 0 0 0 1 0\n0 0 1 1 1 1\n";
        let cells = "CELLS 2 10\n4 0 1 2 3\n4 1 2 3 4\nCELL_TYPES 2\n10 10\n";
        let text = format!(
            "# vtk DataFile Version 3.0\nt\nASCII\nDATASET UNSTRUCTURED_GRID\n{points}{cells}CELL_DATA 2\n{data}"
        );
        read_file(&folder_with(&[("m.vtk", text.as_bytes())]).1).unwrap()
    };
    let names = |data: &str| {
        let AnyMesh::Tetrahedra(mesh) = grid(data).mesh else { panic!() };
        mesh.sets.into_iter().map(|(name, set)| format!("{name}: {:?}", set.elements)).collect::<Vec<_>>()
    };
    assert_eq!(names("SCALARS material int\nLOOKUP_TABLE default\n3 0\n"), ["0: [1]", "3: [0]"]);
    assert!(names("SCALARS material int 1\nLOOKUP_TABLE default\n0 0\n").is_empty());
    assert_eq!(names("SCALARS medit:ref long\n0 4\n"), ["4: [1]"]);
    let two = "FIELD f 2\ngmsh:geometrical 1 2 int\n1 1\ngmsh:physical 1 2 int\n9 0\n";
    assert_eq!(names(two), ["9: [0]", "gmsh:geometrical 1: [0, 1]"]);
    let real = grid("SCALARS strain double\nLOOKUP_TABLE default\n0.5 1\nVECTORS v float\n1 2 3 4 5 6\n");
    assert_eq!(real.notes, ["not read: the field `strain`, the field `v`"]);
}

const INPUT: &str = "*Heading\n** any comment\n a title\n*Part, name=BAR\n*Node\n1, 0., 0., 0.\n2, 1., 0., 0.\n3, 0., 1., 0.\n4, 0., 0., 1.\n5, 1., 1., 1.\n\
    *Element, type=C3D4, elset=Lower\n10, 1, 2, 3, 4\n*ELEMENT,\n TYPE=C3D4\n*Nset, nset=Tip, internal\n 5,\n*Nset, nset=All, generate\n1, 5, 1\n\
    *Elset, elset=_Top_S3, internal\n10\n*Surface, type=ELEMENT, name=Top\n_Top_S3, S3\n*End Part\n*Assembly, name=A\n\
    *Instance, name=BAR-1, part=Bar\n 0., 0., 2.\n*End Instance\n*Nset, nset=Corner, instance=BAR-1\n 1, 2\n*End Assembly\n*Material, name=steel\n*Elastic\n1., 0.3\n";

#[test]
fn parts_with_an_instance_are_read_with_their_sets_and_surfaces() {
    let text = INPUT.replace("*ELEMENT,\n TYPE=C3D4\n", "");
    let found = read_file(&folder_with(&[("m.inp", text.as_bytes())]).1).unwrap();
    let AnyMesh::Tetrahedra(mesh) = &found.mesh else { panic!() };
    check(mesh, "m.inp".as_ref()).unwrap();
    assert!(mesh.vertices.iter().all(|x| x.z >= 2.0), "the instance is moved");
    let sets: Vec<String> = mesh.sets.iter().map(|(name, set)| format!("{name}: {}", set.counts())).collect();
    assert_eq!(sets, ["All: 4 points", "Corner: 2 points", "Lower: 1 tetrahedra", "Top: 1 triangles"]);
    assert_eq!(mesh.sets["Top"].faces, [[1, 2, 3]]);
    let expected = [
        "set \"All\": 1 of its 5 nodes belong to no element and are left out",
        "set \"Tip\": 1 of its 1 nodes belong to no element and are left out",
        "1 nodes belong to no element and are left out",
        "not read: *MATERIAL, *ELASTIC",
    ];
    assert_eq!(found.notes, expected);
}

#[test]
fn included_files_continued_rows_and_quadratic_elements_are_read() {
    let main = "*INCLUDE, INPUT=nodes.txt\n*ELEMENT, TYPE=C3D10, ELSET=\"all of it\"\n1, 1, 2, 3, 4, 5, 6, 7,\n8, 9, 10\n*NSET, NSET=fix\n1, 2\n";
    let nodes = "*NODE, NSET=NALL\n1, 0, 0, 0\n2, 1, 0, 0\n3, 0, 1, 0\n4, 0, 0, 1\n5, .5, 0, 0\n6, .5, .5, 0\n7, 0, .5, 0\n8, 0, 0, .5\n9, .5, 0, .5\n10, 0, .5, .5\n";
    let found = read_file(&folder_with(&[("m.inp", main.as_bytes()), ("nodes.txt", nodes.as_bytes())]).1).unwrap();
    let AnyMesh::Tetrahedra(mesh) = &found.mesh else { panic!() };
    assert_eq!(mesh.vertices.len(), 4);
    assert!((volumes(mesh)[0] - 1.0 / 6.0).abs() < 1e-15);
    assert_eq!(mesh.sets["all of it"].elements, [0]);
    assert_eq!(mesh.sets["fix"].points, [0, 1]);
    assert!(
        found.notes.iter().any(|note| note.contains("nodes between the corners of 1 elements")),
        "{:?}",
        found.notes
    );
}

#[test]
fn quadrangles_become_two_triangles_each_with_their_sets_and_sides() {
    let nodes =
        "*NODE\n1, 0, 0\n2, 1, 0\n3, 2, 0\n4, 0, 1\n5, 1, 1\n6, 2, 1\n7, .5, 0\n8, 1, .5\n9, .5, 1\n10, 0, .5\n";
    let sets =
        "*ELEMENT, TYPE=CPE3\n12, 2, 3, 6\n13, 2, 6, 5\n*SURFACE, NAME=left\n11, S4\n*SURFACE, NAME=right\n12, S2\n";
    for element in ["CPS4R, ELSET=quad\n11, 1, 2, 5, 4", "S8R, ELSET=quad\n11, 1, 2, 5, 4, 7, 8, 9, 10"] {
        let text = format!("{nodes}*ELEMENT, TYPE={element}\n{sets}");
        let found = read_file(&folder_with(&[("m.inp", text.as_bytes())]).1).unwrap();
        let AnyMesh::Triangles(mesh) = &found.mesh else { panic!() };
        let places =
            |nodes: &[usize]| nodes.iter().map(|&node| mesh.vertices[node].xy().into()).collect::<Vec<[f64; 2]>>();
        assert_eq!(places(&mesh.elements[0]), [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]]);
        assert_eq!(places(&mesh.elements[1]), [[0.0, 0.0], [1.0, 1.0], [0.0, 1.0]]);
        assert_eq!((mesh.elements.len(), &mesh.sets["quad"].elements[..]), (4, &[0, 1][..]));
        assert_eq!(places(&mesh.sets["left"].edges[0]), [[0.0, 0.0], [0.0, 1.0]]);
        assert_eq!(places(&mesh.sets["right"].edges[0]), [[2.0, 0.0], [2.0, 1.0]]);
    }
}

#[test]
fn names_that_are_no_labels_of_abaqus_stand_in_quotation_marks_and_come_back() {
    let mut mesh = box_mesh([2.0, 1.0, 1.0], 1, Pattern::Alternating).unwrap();
    let half = MeshSet { elements: (0..6).collect(), faces: vec![[0, 3, 9]], ..MeshSet::default() };
    mesh.sets = ["7", "left half", "soft"].map(|name| (name.to_owned(), half.clone())).into();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("m.inp");
    fem_mesh::write_tetrahedra(&path, &mesh).unwrap();
    let text = std::fs::read_to_string(&path).unwrap();
    assert!(["=\"7\"\n", "=\"left half\"\n", "=soft\n"].iter().all(|label| text.contains(label)), "{text}");
    let AnyMesh::Tetrahedra(again) = read_file(&path).unwrap().mesh else { panic!() };
    assert!(again.sets.keys().eq(mesh.sets.keys()), "{:?}", again.sets.keys());
}

#[test]
fn bad_input_files_are_refused_with_their_line() {
    let refused = |from: &str, to: &str, parts: &[&str]| {
        let text = INPUT.replace("*ELEMENT,\n TYPE=C3D4\n", "");
        assert!(text.contains(from), "{from}");
        let message =
            read_file(&folder_with(&[("m.inp", text.replacen(from, to, 1).as_bytes())]).1).unwrap_err().to_string();
        assert!(parts.iter().all(|part| message.contains(part)), "{message}");
    };
    refused("2, 1., 0., 0.", "2, 1., 0., 0., 7", &["m.inp, line 7: `7` stands after the three coordinates of a node"]);
    refused("2, 1., 0., 0.", "2, 1., a, 0.", &["line 7: `a` is not a coordinate"]);
    refused("2, 1., 0., 0.", "1, 1., 0., 0.", &["line 7: the tag 1 is given to two nodes"]);
    refused("10, 1, 2, 3, 4", "10, 1, 2, 3", &["line 12: a node of the element is missing here"]);
    refused("10, 1, 2, 3, 4", "10, 1, 2, 3, 4, 5", &["line 12: `5` stands after the nodes of the element"]);
    refused("10, 1, 2, 3, 4", "10, 1, 2, 3, 6", &["line 12: the file has no node with the tag 6"]);
    refused("type=C3D4", "type=C3D8R", &["line 11: the element type C3D8R is not supported; mesh the volumes"]);
    refused("_Top_S3, S3", "_Top_S3, S5", &["`S5` is not a side of the element"]);
    refused("_Top_S3, S3", "_Top, S3", &["`_Top` is not the name of a set of elements"]);
    refused("part=Bar", "part=Rod", &["`Rod` is not the name of a part"]);
    refused(
        "*Nset, nset=Corner",
        "*Instance, name=B, part=Bar\n*Nset, nset=Corner",
        &["a second instance of the part BAR"],
    );
    refused("*Heading", "*INCLUDE, INPUT=none.inp\n*Heading", &["none.inp: there is no such file"]);
    refused(
        "*Heading",
        "*INCLUDE, INPUT=m.inp\n*Heading",
        &["line 1: a file that is included 16 times deep", "remove the circle"],
    );
}

#[test]
fn a_mesh_survives_abaqus_files_bit_for_bit() {
    let folder = tempdir().unwrap();
    let path = folder.path().join("a.inp.gz");
    let mut mesh = body();
    mesh.vertices.iter_mut().enumerate().for_each(|(i, x)| x.x += 0.01 * (i as f64).sin());
    write_mesh(&path, &AnyMesh::Tetrahedra(mesh.clone())).unwrap();
    let AnyMesh::Tetrahedra(found) = read_mesh(&path).unwrap() else { panic!() };
    assert_eq!((found.vertices, found.elements), (mesh.vertices, mesh.elements));
    let surface: SurfaceMesh = Mesh::new(body().vertices[..4].to_vec(), vec![[0, 1, 3], [1, 2, 3]]);
    write_mesh(&path, &AnyMesh::Triangles(surface.clone())).unwrap();
    assert_eq!(read_surface(&path).unwrap(), surface);
}

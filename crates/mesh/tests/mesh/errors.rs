//! Every bad file ends in one message that names the file, the line or element, and what to do.

use std::path::Path;

use fem_mesh::{read_surface, read_tetrahedra, write_surface, write_tetrahedra};

use crate::{folder_with, two_tetrahedra};

const NODES: &[u8] = b"4 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n";
const ELEMENT: &[u8] = b"1 4 0\n0 0 1 2 3\n";

/// Reads the first file and compares: the message begins with its path and contains these parts.
fn assert_message(files: &[(&str, &[u8])], parts: &[&str]) {
    let (folder, path) = folder_with(files);
    let result = if path.extension().unwrap() == "obj" {
        read_surface(&path).map(drop)
    } else {
        read_tetrahedra(&path).map(drop)
    };
    let message = result.expect_err(&format!("{files:?} was accepted")).to_string();
    assert!(message.starts_with(folder.path().to_str().unwrap()), "{message}");
    assert_eq!(message.lines().count(), 1, "{message}");
    for part in parts {
        assert!(message.contains(part), "`{part}` is not in: {message}");
    }
}

fn assert_tetgen(nodes: &str, elements: &str, parts: &[&str]) {
    assert_message(&[("m.node", nodes.as_bytes()), ("m.ele", elements.as_bytes())], parts);
}

#[test]
fn a_missing_file_is_named() {
    for name in ["no/such.node", "no/such.ele", "no/such.mesh", "no/such.msh", "no/such.vtu"] {
        let message = read_tetrahedra(Path::new(name)).unwrap_err().to_string();
        assert!(message.starts_with(&format!("{name}: there is no such file; check the path")), "{message}");
    }
    assert!(read_surface(Path::new("no/such.obj")).unwrap_err().to_string().contains("no such file"));
}

#[test]
fn a_missing_partner_is_named() {
    assert_message(&[("m.node", NODES)], &["m.node: ", "m.ele` as well", "side by side"]);
    assert_message(&[("m.ele", ELEMENT)], &["m.ele: ", "m.node` as well", "side by side"]);
}

#[test]
fn a_folder_in_place_of_a_file_is_unreadable() {
    let (folder, path) = folder_with(&[("x.node", NODES)]);
    let path = path.with_file_name("folder.mesh");
    std::fs::create_dir(&path).unwrap();
    let message = read_tetrahedra(&path).unwrap_err().to_string();
    assert!(
        message.contains("folder.mesh: cannot be read (") && message.contains("check that it is a file"),
        "{message}"
    );
    drop(folder);
}

#[test]
fn an_unknown_extension_is_refused_with_the_known_ones() {
    let message = read_tetrahedra(Path::new("bunny.stl")).unwrap_err().to_string();
    assert!(message.starts_with("bunny.stl: the extension `.stl` is unknown"), "{message}");
    assert!(message.contains(".node") && message.contains(".msh") && message.contains(".vtu"), "{message}");
    assert!(read_surface(Path::new("bunny")).unwrap_err().to_string().contains(".obj"));
    assert!(write_tetrahedra(Path::new("a.dae"), &two_tetrahedra()).unwrap_err().to_string().contains("use one of"));
    let message = write_tetrahedra(Path::new("a.stl"), &two_tetrahedra()).unwrap_err().to_string();
    assert!(message.starts_with("a.stl: a mesh of tetrahedra in a .stl file"), "{message}");
    assert!(write_surface(Path::new("a.dae"), &Default::default()).unwrap_err().to_string().contains("use one of"));
}

#[test]
fn a_folder_that_does_not_exist_cannot_be_written_to() {
    let message = write_tetrahedra(Path::new("no/such/folder/a.vtu"), &two_tetrahedra()).unwrap_err().to_string();
    assert!(message.starts_with("no/such/folder/a.vtu: cannot be written"), "{message}");
    assert!(message.contains("check that the folder exists"), "{message}");
}

#[test]
fn a_file_that_cannot_be_finished_is_removed() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.vtu");
    std::fs::create_dir(&path).unwrap();
    assert!(write_tetrahedra(&path, &two_tetrahedra()).unwrap_err().to_string().contains("cannot be written"));
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
}

#[test]
fn wrong_counts_of_tetgen_are_refused_with_both_figures() {
    let nodes = str::from_utf8(NODES).unwrap();
    assert_tetgen(
        &nodes.replacen('4', "5", 1),
        "1 4 0\n0 0 1 2 3\n",
        &["m.node: announces 5 nodes and holds 4; correct"],
    );
    assert_tetgen(&nodes.replacen('4', "3", 1), "1 4 0\n0 0 1 2 3\n", &["m.node: announces 3 nodes and holds 4"]);
    assert_tetgen(nodes, "7 4 0\n0 0 1 2 3\n", &["m.ele: announces 7 tetrahedra and holds 1"]);
    assert_tetgen(nodes, "0 4 0\n0 0 1 2 3\n", &["m.ele: announces 0 tetrahedra and holds 1"]);
    assert_tetgen("", "", &["m.node: the mesh has no nodes"]);
}

#[test]
fn bad_lines_of_tetgen_are_refused_with_their_number() {
    let nodes = str::from_utf8(NODES).unwrap();
    let elements = "1 4 0\n0 0 1 2 3\n";
    assert_tetgen(&nodes.replace("0 1 0\n", "0 one 0\n"), elements, &["m.node, line 4: `one` is not a coordinate"]);
    assert_tetgen(&nodes.replace("0 1 0\n", "0 1\n"), elements, &["m.node, line 4: a coordinate", "is missing here"]);
    for word in ["nan", "NaN", "inf", "-inf", "1e999"] {
        let broken = nodes.replace("0 1 0\n", &format!("0 {word} 0\n"));
        assert_tetgen(&broken, elements, &["m.node, line 4", &format!("`{word}` is not finite; give the vertex")]);
    }
    assert_tetgen(nodes, "1 4 0\n0 0 1 2 4\n", &["m.ele, line 2: vertex 4 does not exist", "are 0 to 3; correct"]);
    assert_tetgen(nodes, "1 4 0\n0 0 1 2 -1\n", &["m.ele, line 2: vertex -1 does not exist"]);
    assert_tetgen(nodes, "1 4 0\n0 0 1 2 99999999999999999999\n", &["m.ele, line 2: `99999999999999999999`"]);
    assert_tetgen(nodes, "1 4 0\n5 0 1 2 3\n", &["m.ele, line 2: the number 5 stands in place of 0; number"]);
    assert_tetgen("# 4-D\n4 4 0 0\n", elements, &["m.node, line 2: the dimension 4 is not", "in space"]);
    let plane = "4 2 0 0\n0 0 0\n1 1 0\n2 0 1\n3 1 1\n";
    let too_long = nodes.replacen("4 3", "4 2", 1);
    assert_tetgen(&too_long, elements, &["m.node, line 2: `0` stands after the last entry of the node, where the row"]);
    assert_tetgen(plane, elements, &["m.ele, line 1: a mesh of elements with 4 nodes, and nodes of dimension 2"]);
    assert_tetgen(plane, "1 3 0\n0 0 1 2\n", &["m.node: a mesh of 1 triangles in place of tetrahedra"]);
    assert_tetgen(
        nodes,
        "1 3 0\n0 0 1 2\n",
        &["m.ele, line 1: a mesh of elements with 3 nodes, and nodes of dimension 3"],
    );
    assert_tetgen(nodes, "1 10 0\n", &["m.ele, line 1", "elements with 10 nodes", "without -o2"]);
    assert_tetgen("0 3 0 0\n", elements, &["m.ele, line 2", "no vertices that the index 0"]);
}

#[test]
fn bad_files_of_medit_are_refused() {
    let good = "MeshVersionFormatted 2\nDimension 3\nVertices 4\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\nTetrahedra 1\n1 2 3 4 0\nEnd\n";
    let assert_medit = |from: &str, to: &str, parts: &[&str]| {
        assert!(good.contains(from), "{from}");
        assert_message(&[("m.mesh", good.replacen(from, to, 1).as_bytes())], parts);
    };
    assert_medit("Formatted 2", "Formatted 9", &["m.mesh, line 1: MEDIT version 9 is not supported; save"]);
    assert_medit("MeshVersionFormatted", "\u{1}\0", &["m.mesh, line 1", "not MEDIT's text format", "save the mesh as"]);
    assert_medit("Dimension 3", "Dimension 4", &["line 2: dimension 4 is not supported; give a mesh of `Dimension 2`"]);
    assert_medit(
        "Dimension 3",
        "Dimension 2",
        &["line 4: a row of vertices has 3 entries, and here are 4; correct the row or the dimension"],
    );
    assert_medit("Vertices 4", "Vertices 5", &["line 3: announces 5 vertices and holds 4; correct the count"]);
    assert_medit("Vertices 4", "Vertices 3", &["line 3: announces 3 vertices and holds 4"]);
    assert_medit(
        "Tetrahedra 1",
        "Tetrahedra 1000000000000000000",
        &["announces 1000000000000000000 tetrahedra and holds 1"],
    );
    assert_medit("0 1 0 0", "0 x 0 0", &["line 6: `x` is not a coordinate"]);
    assert_medit("0 1 0 0", "0 nan 0 0", &["line 6", "`nan` is not finite"]);
    assert_medit("1 2 3 4 0", "1 2 3 5 0", &["line 9: vertex 5 does not exist, the file's vertices are 1 to 4"]);
    assert_medit("1 2 3 4 0", "0 2 3 4 0", &["line 9: vertex 0 does not exist"]);
    assert_medit(
        "End",
        "Hexahedra 1\n1 1 1 1 1 1 1 1 0",
        &["1 Hexahedra is not supported; export tetrahedra with 4 nodes"],
    );
    assert_medit("End", "TetrahedraP2\n1\n1 2 3 4 1 1 1 1 1 1 0", &["1 TetrahedraP2 is not supported; export"]);
    assert_medit("End", "7", &["announces 1 tetrahedra and holds 2"]);
}

#[test]
fn bad_files_of_gmsh_are_refused() {
    let good = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 4 1 9\n3 1 0 4\n1\n2\n3\n9\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n\
                $EndNodes\n$Elements\n1 1 1 1\n3 1 4 1\n1 1 2 3 9\n$EndElements\n";
    let assert_gmsh = |from: &str, to: &str, parts: &[&str]| {
        assert!(good.contains(from), "{from}");
        assert_message(&[("m.msh", good.replacen(from, to, 1).as_bytes())], parts);
    };
    assert_gmsh("4.1 0 8", "3 0 8", &["m.msh, line 2: Gmsh format 3 is not supported", "gmsh IN.msh", "msh41"]);
    assert_gmsh("4.1 0 8", "4.0 1 8", &["m.msh, line 2: a binary file of Gmsh format 4.0", "-setnumber Mesh.Binary 0"]);
    assert_gmsh("4.1 0 8", "4.1 1 4", &["m.msh, line 2: a binary Gmsh file with numbers of 4 bytes"]);
    assert_gmsh("4.1 0 8", "4.1 1 8", &["m.msh, byte 24: `", "is not the integer 1 that tells the byte order"]);
    assert_gmsh("$MeshFormat", "$NODE", &["m.msh: ", "without the section $MeshFormat"]);
    assert_gmsh("3 1 0 4", "3 1 0 5", &["m.msh, line 11: announces 5 node tags and holds 4"]);
    assert_gmsh("1 4 1 9", "1 5 1 9", &["m.msh: announces 5 nodes and holds 4"]);
    assert_gmsh("1 1 1 1", "1 2 1 1", &["m.msh: announces 2 elements and holds 1"]);
    assert_gmsh("3 1 4 1\n", "3 1 4 1000000000000000000\n", &["announces 1000000000000000000 elements and holds 1"]);
    assert_gmsh("0 1 0\n", "0 1e400 0\n", &["line 13", "`1e400` is not finite"]);
    assert_gmsh("0 1 0\n", "0 a 0\n", &["line 13: `a` is not a coordinate"]);
    assert_gmsh("1 1 2 3 9", "1 1 2 3 4", &["line 19: the file has no node with the tag 4; correct"]);
    assert_gmsh("2\n3\n9\n", "2\n2\n9\n", &["line 9: the tag 2 is given to two nodes"]);
    assert_gmsh("3 1 4 1\n", "3 1 29 1\n", &["line 18: a mesh of tetrahedra with 20 nodes", "-order 1"]);
    assert_gmsh("3 1 4 1\n", "3 1 5 1\n", &["line 18", "element type 5", "gmsh -3"]);
}

#[test]
fn bad_files_of_vtk_are_refused() {
    let good = r#"<VTKFile type="UnstructuredGrid" byte_order="LittleEndian"><UnstructuredGrid>
<Piece NumberOfPoints="4" NumberOfCells="1">
<Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">0 0 0 1 0 0 0 1 0 0 0 1</DataArray></Points>
<Cells>
<DataArray type="Int64" Name="connectivity" format="ascii">0 1 2 3</DataArray>
<DataArray type="Int64" Name="offsets" format="ascii">4</DataArray>
<DataArray type="UInt8" Name="types" format="ascii">10</DataArray>
</Cells></Piece></UnstructuredGrid></VTKFile>"#;
    let assert_vtu = |from: &str, to: &str, parts: &[&str]| {
        assert!(good.contains(from), "{from}");
        assert_message(&[("m.vtu", good.replacen(from, to, 1).as_bytes())], parts);
    };
    assert_vtu("</Cells>", "", &["m.vtu, line 8", "not well-formed XML", "export the mesh again"]);
    assert_vtu("NumberOfComponents=\"3\"", "NumberOfComponents=\"2\"", &["line 3: 12 coordinates are not three"]);
    assert_vtu("NumberOfPoints=\"4\"", "NumberOfPoints=\"5\"", &["line 2: announces 5 points and holds 4"]);
    assert_vtu("NumberOfCells=\"1\"", "NumberOfCells=\"2\"", &["line 2: announces 2 cells and holds 1"]);
    assert_vtu("0 0 0 1 0", "0 0 0 1 nan", &["line 3: vertex 1 has a coordinate that is not finite"]);
    assert_vtu("0 0 0 1 0", "0 0 0 1 x", &["line 3: `x` is not a number"]);
    assert_vtu("0 0 0 1 0", "0 0 0 1", &["line 3: 11 coordinates are not three"]);
    assert_vtu("0 1 2 3", "0 1 2 4", &["line 4: element 0 names vertex 4", "0 to 3"]);
    assert_vtu("0 1 2 3", "0 1 2 -4", &["line 4: element 0 names vertex -4"]);
    assert_vtu(">4<", ">5<", &["line 4: cell 0 ends at 5 in a connectivity of 4 numbers"]);
    assert_vtu(">4<", ">4 4<", &["line 4: announces 1 cells and holds 2"]);
    assert_vtu(">10<", ">12<", &["line 4: cell 0 of VTK's type 12", "Tetrahedralize"]);
    assert_vtu(">10<", ">24<", &["cell 0 of VTK's type 24"]);
    assert_vtu("\"offsets\"", "\"ofsets\"", &["line 4: Cells has no array offsets"]);
    assert_vtu("<Points>", "<P>", &["not well-formed"]);
    assert_vtu(
        "type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\"",
        "type=\"Float64\" format=\"binary\"",
        &["line 3"],
    );
    let binary = |attribute: &str, parts: &[&str]| {
        let text = good.replace("byte_order=\"LittleEndian\"", attribute).replacen("ascii", "binary", 1);
        assert_message(&[("m.vtu", text.as_bytes())], parts);
    };
    binary(r#"byte_order="BigEndian""#, &["line 3: big-endian data is not supported; save it"]);
    binary(r#"compressor="vtkLZ4DataCompressor""#, &["line 3: the compressor vtkLZ4DataCompressor", "packed by zlib"]);
    binary("", &["line 3: ", "export the mesh again"]);
    assert_message(&[("m.vtu", b"<VTKFile><PolyData/></VTKFile>")], &["line 1: VTKFile has no UnstructuredGrid"]);
}

#[test]
fn bad_surfaces_are_refused_with_the_line() {
    let assert_obj = |text: &str, parts: &[&str]| assert_message(&[("s.obj", text.as_bytes())], parts);
    assert_obj("", &["s.obj: the mesh has no faces; give one"]);
    assert_obj("v 0 0 0\n", &["s.obj: the mesh has no faces"]);
    assert_obj("v 0 0 0\nv 1 0 x\n", &["s.obj, line 2: `x` is not a coordinate"]);
    assert_obj("v 0 0 0\nv 1 0\n", &["s.obj, line 2", "is missing here"]);
    assert_obj("v 0 0 NaN\n", &["s.obj, line 1", "`NaN` is not finite"]);
    let vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    assert_obj(&format!("{vertices}f 1 2\n"), &["s.obj: the mesh has no faces"]);
    assert_obj(
        "v 0 0 0 1 2\n",
        &["s.obj, line 1: `1` stands after a vertex, where the row should end; correct the row"],
    );
    assert_obj(&format!("{vertices}f 1 2 4\n"), &["s.obj, line 4: vertex 4 does not exist", "1 to 3"]);
    assert_obj(&format!("{vertices}f 1 2 0\n"), &["s.obj, line 4: vertex 0 does not exist"]);
    assert_obj(&format!("{vertices}f 1 2 -4\n"), &["s.obj, line 4: vertex 0 does not exist"]);
    assert_obj(&format!("{vertices}f 1 2 /3\n"), &["s.obj, line 4: `/3` is not the index of a vertex"]);
    assert_obj("f 1 2 3\n", &["s.obj, line 1: there are no vertices that the index 1"]);
}

#[test]
fn a_long_word_without_text_is_shown_in_one_short_line() {
    let header = [&b"ply\nformat ascii 1.0\nproperty \x1b[2J\x07"[..], &[b'x'; 5000], b"\n"].concat();
    let message = read_surface(&folder_with(&[("m.ply", &header)]).1).unwrap_err().to_string();
    assert!(message.len() < 400 && !message.contains(char::is_control), "{message}");
    assert!(
        message.contains("line 3: `property") && message.contains("xxx…` is not a line of a .ply header"),
        "{message}"
    );
}

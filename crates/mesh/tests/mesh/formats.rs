//! Good files as other programs write them.

use fem_mesh::{MeshSet, SurfaceMesh, TetrahedralMesh, read_surface, read_tetrahedra};
use flate2::Compression;
use flate2::write::ZlibEncoder;
use nalgebra::Vector3;
use std::io::Write;

use base64::prelude::{BASE64_STANDARD, Engine};

use crate::folder_with;

fn read(files: &[(&str, &[u8])]) -> TetrahedralMesh {
    read_tetrahedra(&folder_with(files).1).unwrap()
}

/// The corner of the unit cube.
fn corner() -> TetrahedralMesh {
    let vertices = vec![Vector3::zeros(), Vector3::x(), Vector3::y(), Vector3::z()];
    TetrahedralMesh::new(vertices, vec![[0, 1, 2, 3]])
}

fn obj(text: &str) -> SurfaceMesh {
    read_surface(&folder_with(&[("s.obj", text.as_bytes())]).1).unwrap()
}

#[test]
fn tetgen_counts_from_1_with_comments_attributes_and_markers() {
    let nodes = "# made by hand\r\n 4  3  1  1 # counts\r\n\r\n1 0 0 0 7.5 0\r\n2 1 0 0 7.5 0\r\n3 0 1 0 7.5 0\r\n4 0 0 1 7.5 -1\r\n# end";
    let elements = "1 4 1\n1 1 2 3 4 17\n# end\n";
    let mut expected = corner();
    expected.sets.insert("17".to_owned(), MeshSet { elements: vec![0], ..MeshSet::default() });
    expected.sets.insert("-1".to_owned(), MeshSet { points: vec![3], ..MeshSet::default() });
    for names in [["m.node", "m.ele"], ["m.NODE", "m.ele"]] {
        assert_eq!(read(&[(names[0], nodes.as_bytes()), (names[1], elements.as_bytes())]), expected);
    }
    assert_eq!(read(&[("m.ele", elements.as_bytes()), ("m.node", nodes.as_bytes())]), expected);
}

#[test]
fn tetgen_may_leave_the_rest_of_the_first_line_out() {
    assert_eq!(read(&[("m.node", b"4\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1"), ("m.ele", b"1\n0 0 1 2 3")]), corner());
}

#[test]
fn medit_puts_keywords_counts_and_sections_in_many_ways() {
    let text = "\u{feff}MeshVersionFormatted\n1\n\n# by hand\nDimension\n3\nTetrahedra 1\n1 2 3 4 5\nTriangles\n1\n1 2 3 0\n\
                Corners 2 1 2\nVertices\r\n4\r\n0 0 0 1\r\n1 0 0 1\r\n0 1 0 1 0 0 1 1\r\nNormals 1 0 nan 1\nPrisms 0 End\n nothing 1 2";
    let mut expected = corner();
    expected.sets.insert("5".to_owned(), MeshSet { elements: vec![0], ..MeshSet::default() });
    expected.sets.insert("1".to_owned(), MeshSet { points: vec![0, 1, 2, 3], ..MeshSet::default() });
    assert_eq!(read(&[("m.mesh", text.as_bytes())]), expected);
}

#[test]
fn gmsh_4_1_has_blocks_scattered_tags_and_other_elements() {
    let text = "$Comments\nany $thing\n$EndComments\n$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n3 1 \"body\"\n\
        $EndPhysicalNames\n$Entities\n1 0 0 1\n1 0 0 0 0\n1 0 0 0 1 1 1 1 1 0\n$EndEntities\n\
        $Nodes\n3 4 5 100\n0 1 0 1\n100\n0 0 0\n2 1 1 2\n7\n5\n1 0 0 0.5 0.5\n0 1 0 0.5 0.5\n3 1 0 1\n50\n0 0 1\n$EndNodes\n\
        $Elements\n3 3 1 3\n0 1 15 1\n1 100\n2 1 2 1\n2 100 7 5\n3 1 4 1\n3 100 7 5 50\n$EndElements\n";
    let mut mesh = read(&[("m.msh", text.replace('\n', "\r\n").as_bytes())]);
    let body = mesh.sets.remove("body").unwrap();
    assert_eq!((body.elements, body.faces), (vec![0], vec![]));
    assert_eq!(mesh, corner());
}

#[test]
fn gmsh_4_0_has_each_tag_beside_its_place() {
    let text = "$MeshFormat\n4 0 8\n$EndMeshFormat\n$Nodes\n2 4\n1 0 0 1\n9 0 0 0\n1 3 0 3\n2 1 0 0\n3 0 1 0\n4 0 0 1\n$EndNodes\n\
        $Elements\n2 2\n3 2 2 1\n1 9 2 3\n1 3 4 1\n2 9 2 3 4\n$EndElements\n";
    assert_eq!(read(&[("m.msh", text.as_bytes())]), corner());
}

#[test]
fn vtk_text_has_pieces_and_cells_that_fill_no_space() {
    let piece = |cells: &str| {
        format!(
            r#"<Piece NumberOfPoints="4" NumberOfCells="2"><PointData/><Points><DataArray type="Float32" format="ascii">
            <InformationKey name="L2_NORM"/>0 0 0 1 0 0  0 1 0 0 0 1 </DataArray></Points><Cells>{cells}</Cells></Piece>"#
        )
    };
    let cells = r#"<DataArray type="Int32" Name="connectivity" format="ascii">0 1 2 0 1 2 3</DataArray>
        <DataArray type="Int32" Name="offsets" format="ascii">3 7</DataArray>
        <DataArray type="UInt8" Name="types" format="ascii">5 10</DataArray>"#;
    let text = format!(
        "\u{feff}<?xml version=\"1.0\"?>\n<!-- by hand --><VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid>{}{}</UnstructuredGrid></VTKFile>",
        piece(cells),
        piece(cells)
    );
    let mesh = read(&[("m.vtu", text.as_bytes())]);
    assert_eq!(mesh.elements, [[0, 1, 2, 3], [4, 5, 6, 7]]);
    assert_eq!(mesh.vertices[4..], corner().vertices);
}

/// The corner's arrays as VTK's bytes: points (Float32), connectivity (Int32), offsets (Int64), types (UInt8).
fn arrays() -> [(&'static str, Vec<u8>); 4] {
    let points = corner().vertices.iter().flatten().flat_map(|&x| (x as f32).to_le_bytes()).collect();
    let connectivity = (0..4_i32).flat_map(i32::to_le_bytes).collect();
    [
        (r#"type="Float32" Name="Points" NumberOfComponents="3""#, points),
        (r#"type="Int32" Name="connectivity""#, connectivity),
        (r#"type="Int64" Name="offsets""#, 4_i64.to_le_bytes().to_vec()),
        (r#"type="UInt8" Name="types""#, vec![10]),
    ]
}

/// A file of these attributes; each array's attributes and content come from its number, and the end of the file from `tail`.
fn vtk(attributes: &str, array: impl Fn(usize) -> (String, String), tail: &[u8]) -> TetrahedralMesh {
    let element = |i: usize| {
        let (format, content) = array(i);
        format!("<DataArray {} {format}>{content}</DataArray>", arrays()[i].0)
    };
    let text = format!(
        "<VTKFile type=\"UnstructuredGrid\" {attributes}><UnstructuredGrid><Piece><Points>{}</Points><Cells>{}{}{}</Cells></Piece></UnstructuredGrid>",
        element(0),
        element(1),
        element(2),
        element(3)
    );
    read(&[("m.vtu", &[text.as_bytes(), tail].concat())])
}

/// An array with its counts: four bytes of length, or the table of blocks (of 7 bytes) and the blocks packed.
fn packed(data: &[u8], zlib: bool) -> [Vec<u8>; 2] {
    if !zlib {
        return [(data.len() as u32).to_le_bytes().to_vec(), data.to_vec()];
    }
    let blocks: Vec<Vec<u8>> = data
        .chunks(7)
        .map(|block| {
            let mut encoder = ZlibEncoder::new(Vec::new(), Compression::default());
            encoder.write_all(block).unwrap();
            encoder.finish().unwrap()
        })
        .collect();
    let mut counts = vec![blocks.len() as u32, 7, (data.len() % 7) as u32];
    counts.extend(blocks.iter().map(|block| block.len() as u32));
    [counts.into_iter().flat_map(u32::to_le_bytes).collect(), blocks.concat()]
}

/// Counts and data, encoded one after the other (as VTK does for packed data) or as one.
fn base64([counts, data]: [Vec<u8>; 2], apart: bool) -> String {
    match apart {
        true => BASE64_STANDARD.encode(counts) + &BASE64_STANDARD.encode(data),
        false => BASE64_STANDARD.encode([counts, data].concat()),
    }
}

#[test]
fn vtk_arrays_may_be_base64_in_place_plain_or_packed() {
    for (zlib, attribute) in [(false, ""), (true, r#"compressor="vtkZLibDataCompressor""#)] {
        for apart in [false, true] {
            let content = |i: usize| format!("\n  {}\n", base64(packed(&arrays()[i].1, zlib), apart));
            let mesh = vtk(attribute, |i| (r#"format="binary""#.to_owned(), content(i)), b"</VTKFile>");
            assert_eq!(mesh, corner(), "{zlib} {apart}");
        }
    }
}

#[test]
fn vtk_arrays_may_be_appended_raw_or_base64_plain_or_packed() {
    for (zlib, attribute) in [(false, ""), (true, r#"compressor="vtkZLibDataCompressor""#)] {
        for encoding in ["raw", "base64"] {
            let mut data = Vec::new();
            let mut offsets = Vec::new();
            for (_, bytes) in arrays() {
                offsets.push(data.len());
                let stored = packed(&bytes, zlib);
                data.extend(if encoding == "raw" { stored.concat() } else { base64(stored, zlib).into_bytes() });
            }
            let open = format!("<AppendedData encoding=\"{encoding}\">\n   _").into_bytes();
            let tail = [open, data, b"\n</AppendedData></VTKFile>".to_vec()].concat();
            let array = |i: usize| (format!(r#"format="appended" offset="{}""#, offsets[i]), String::new());
            assert_eq!(vtk(attribute, array, &tail), corner(), "{zlib} {encoding}");
        }
    }
}

#[test]
fn surfaces_name_vertices_in_every_form_of_the_format() {
    let vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    for face in ["f 1 2 3", "f 1/4 2/5 3/6", "f 1/4/7 2/5/8 3/6/9", "f 1//7 2//8 3//9", "f -3 -2 -1", "f -3/1 2 -1//4"]
    {
        assert_eq!(obj(&format!("{vertices}{face}")).elements, [[0, 1, 2]], "{face}");
    }
}

#[test]
fn polygons_of_surfaces_become_fans() {
    let mesh = obj("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv -1 0 0\nf 1 2 3 4 5\n");
    assert_eq!(mesh.elements, [[0, 1, 2], [0, 2, 3], [0, 3, 4]]);
}

#[test]
fn surfaces_from_scanners_come_with_byte_order_marks_carriage_returns_blanks_and_colours() {
    let text = "\u{feff}# caf\u{e9}\r\n\r\nmtllib a.mtl\r\no x\r\nv  0\t0 0   1 0.5 0.5 \r\n   v 1 0 0 \r\nv 0 1 0\r\nvt 0 0\r\nvn 0 0 1\r\n\
                usemtl b\r\ns off\r\n f  1 2   3 \r\nf 1 1 2\r\nl 1 2\r\n\r\n";
    let mesh = obj(text);
    assert_eq!(mesh.vertices, [Vector3::zeros(), Vector3::x(), Vector3::y()]);
    assert_eq!(mesh.elements, [[0, 1, 2]], "the second face names a vertex twice and has no area");
}

#[test]
fn comments_may_be_in_any_encoding() {
    let file = folder_with(&[("s.obj", b"# caf\xe9 \xff\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")]);
    assert_eq!(read_surface(&file.1).unwrap().elements.len(), 1);
}

//! VTK's old format, in both layouts, as text and binary.

use fem_mesh::{TetrahedralMesh, read_tetrahedra};
use nalgebra::Vector3;

use crate::folder_with;

fn read(bytes: &[u8]) -> TetrahedralMesh {
    read_tetrahedra(&folder_with(&[("m.vtk", bytes)]).1).unwrap()
}

fn refusal(bytes: &[u8]) -> String {
    read_tetrahedra(&folder_with(&[("m.vtk", bytes)]).1).unwrap_err().to_string()
}

/// Two tetrahedra glued on a face.
fn mesh() -> TetrahedralMesh {
    let vertices = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 1.0, 1.0]];
    TetrahedralMesh::new(vertices.map(Vector3::from).to_vec(), vec![[0, 1, 2, 3], [1, 2, 3, 4]])
}

const POINTS: &str = "POINTS 5 float\n0 0 0 1 0 0 0 1 0\n0 0 1 1 1 1\n";

/// The mesh and one of its triangles, before version 5.
const OLD: &str = "CELLS 3 14\n4 0 1 2 3\n3 0 1 2\n4 1 2 3 4\n\nCELL_TYPES 3\n10 5 10\n";

fn text(cells: &str) -> String {
    format!("# vtk DataFile Version 3.0\nany title, #1\nASCII\nDATASET UNSTRUCTURED_GRID\n{POINTS}{cells}")
}

fn big_endian(values: &[i32]) -> Vec<u8> {
    values.iter().flat_map(|value| value.to_be_bytes()).collect()
}

/// The mesh in binary, as VTK 9 writes it or as before.
pub fn binary(is_new: bool) -> Vec<u8> {
    let field = "FIELD FieldData 1\nTIME 1 1 double\n";
    let mut bytes = format!("# vtk DataFile Version 5.1\nt\nBINARY\nDATASET UNSTRUCTURED_GRID\n{field}").into_bytes();
    bytes.extend(0.25_f64.to_be_bytes());
    bytes.extend(b"\nMETADATA\nINFORMATION 0\n\nPOINTS 5 double\n");
    bytes.extend(mesh().vertices.iter().flatten().flat_map(|x| x.to_be_bytes()));
    if is_new {
        bytes.extend(b"\nCELLS 4 11\nOFFSETS vtktypeint64\n");
        bytes.extend([0_i64, 4, 7, 11].iter().flat_map(|x| x.to_be_bytes()));
        bytes.extend(b"\nCONNECTIVITY vtktypeint64\n");
        bytes.extend([0_i64, 1, 2, 3, 0, 1, 2, 1, 2, 3, 4].iter().flat_map(|x| x.to_be_bytes()));
    } else {
        bytes.extend(b"\nCELLS 3 14\n");
        bytes.extend(big_endian(&[4, 0, 1, 2, 3, 3, 0, 1, 2, 4, 1, 2, 3, 4]));
    }
    bytes.extend(b"\nCELL_TYPES 3\n");
    bytes.extend(big_endian(&[10, 5, 10]));
    bytes.extend(b"\nCELL_DATA 3\nSCALARS x float 1\nLOOKUP_TABLE default\n\x00\x01\n3456789ab\n");
    bytes
}

#[test]
fn both_layouts_are_read_as_text_and_binary() {
    assert_eq!(read(text(OLD).as_bytes()), mesh());
    let new = "METADATA\nINFORMATION 1\nNAME x\n\nCELLS 4 11\nOFFSETS vtktypeint64\n0 4 7 11\nCONNECTIVITY vtktypeint64\n\
               0 1 2 3 0 1 2\n1 2 3 4\nCELL_TYPES 3\n10\n5\n10\nPOINT_DATA 5\nSCALARS a double\n0 1 2 3 4\n";
    assert_eq!(read(text(new).as_bytes()), mesh());
    assert_eq!(read(text(OLD).replace('\n', "\r\n").as_bytes()), mesh());
    assert_eq!(read(&binary(false)), mesh());
    assert_eq!(read(&binary(true)), mesh());
}

#[test]
fn bad_files_are_refused_with_line_or_byte() {
    let refused = |from: &str, to: &str, parts: &[&str]| {
        assert!(text(OLD).contains(from), "{from}");
        let message = refusal(text(OLD).replacen(from, to, 1).as_bytes());
        assert!(parts.iter().all(|part| message.contains(part)), "{message}");
    };
    refused("# vtk", "# vkt", &["m.vtk, line 1: a .vtk file that does not begin", "ParaView"]);
    refused("UNSTRUCTURED_GRID", "RECTILINEAR_GRID", &["line 4: the data set `DATASET RECTILINEAR_GRID` is not"]);
    refused("ASCII", "TEXT", &["line 3: `TEXT` is not ASCII or BINARY"]);
    refused("POINTS 5", "POINTS 6", &["line 8: `CELLS` is not a number"]);
    refused("1 1 1\n", "1 1 nan\n", &["vertex 4 has a coordinate that is not finite"]);
    refused("CELLS 3 14", "CELLS 4 14", &["announces 4 cells and holds 3"]);
    refused("CELLS 3 14", "CELLS 3 1000000000000000000", &["`CELL_TYPES` is not an integer"]);
    refused("4 1 2 3 4", "9 1 2 3 4", &["cell 2 announces 9 points and 4 numbers are left"]);
    refused("10 5 10", "10 5 12", &["cell 2 of VTK's type 12 (hexahedron) is not supported; split such cells"]);
    refused("10 5 10", "10 5 24", &["cell 2 of VTK's type 24 (tetrahedron with 10 nodes)"]);
    refused("CELL_TYPES 3\n10 5 10", "CELL_TYPES 2\n10 5", &["announces 2 cells and holds 3"]);
    refused("4 1 2 3 4", "4 1 2 3 5", &["element 2 names vertex 5", "0 to 4"]);
}

#[test]
fn every_truncation_of_a_binary_file_is_refused_or_gives_the_mesh() {
    for whole in [binary(false), binary(true)] {
        for length in (0..whole.len()).step_by(3) {
            if let Ok(found) = read_tetrahedra(&folder_with(&[("m.vtk", &whole[..length])]).1) {
                assert!(found == mesh() || found.elements.is_empty(), "{length} bytes");
            }
        }
        let array = whole.windows(6).position(|window| window == b"POINTS").unwrap();
        let message = refusal(&whole[..array + 40]);
        assert!(message.contains(", byte ") && message.contains("is cut short"), "{message}");
    }
    let absurd = String::from_utf8_lossy(&binary(false)[..60]).into_owned() + "\nPOINTS 9000000000000000000 double\n";
    assert!(refusal(absurd.replace("FIELD FieldDa", "").as_bytes()).contains("m.vtk, byte "));
}

//! Files for other programs: VTK with fields, and glTF.

use std::fs;
use std::path::Path;

use fem_mesh::write::{Field, Frame, write_glb, write_vtu};
use fem_mesh::{Pattern, boundary, box_mesh, read_tetrahedra};
use nalgebra::{Rotation3, Vector3};
use serde_json::Value;
use tempfile::tempdir;

#[test]
fn a_vtk_file_with_fields_still_holds_its_mesh() {
    let folder = tempdir().unwrap();
    let path = folder.path().join("a.vtu");
    let mesh = box_mesh([1.0, 2.0, 1.0], 1, Pattern::Alternating).unwrap();
    let displacement = vec![0.5; 3 * mesh.vertices.len()];
    let stress = vec![1e5; mesh.elements.len()];
    let points = [Field { name: "displacement <m> & \"more\"", components: 3, values: &displacement }];
    let cells = [Field { name: "von Mises stress, Pa", components: 1, values: &stress }];
    write_vtu(&path, &mesh, &points, &cells).unwrap();
    assert_eq!(read_tetrahedra(&path).unwrap(), mesh);
}

#[test]
fn a_field_of_the_wrong_size_is_refused_with_both_figures() {
    let mesh = box_mesh([1.0, 1.0, 1.0], 1, Pattern::Alternating).unwrap();
    let field = [Field { name: "velocity", components: 3, values: &[0.0; 8] }];
    let message = write_vtu(Path::new("a.vtu"), &mesh, &field, &[]).unwrap_err().to_string();
    assert!(message.contains("`velocity` has 8 numbers, and 24 are needed (3 for each point)"), "{message}");
    let message = write_vtu(Path::new("a.vtu"), &mesh, &[], &field).unwrap_err().to_string();
    assert!(message.contains("and 18 are needed (3 for each cell)"), "{message}");
}

/// A box that turns: rest, faces, frames.
fn turning_box(frames: usize) -> (Vec<Vector3<f64>>, Vec<[usize; 3]>, Vec<Frame>) {
    let mesh = box_mesh([2.0, 2.0, 2.0], 1, Pattern::Alternating).unwrap();
    let frame = |k: usize| {
        let turn = Rotation3::from_axis_angle(&Vector3::z_axis(), 0.1 * k as f64);
        Frame { time: 0.04 * k as f64, positions: mesh.vertices.iter().map(|x| turn * x).collect() }
    };
    (mesh.vertices.clone(), boundary(&mesh), (0..frames).map(frame).collect())
}

/// The JSON part and the binary part of a file, after its headers have been compared with its length.
fn chunks(bytes: &[u8]) -> (Value, &[u8]) {
    let number = |at: usize| u32::from_le_bytes(bytes[at..at + 4].try_into().unwrap()) as usize;
    assert_eq!((&bytes[..4], number(4), number(8)), (&b"glTF"[..], 2, bytes.len()));
    let end = 20 + number(12);
    assert_eq!((&bytes[16..20], end % 4), (&b"JSON"[..], 0));
    assert_eq!((&bytes[end + 4..end + 8], end + 8 + number(end)), (&b"BIN\0"[..], bytes.len()));
    (serde_json::from_slice(&bytes[20..end]).unwrap(), &bytes[end + 8..])
}

/// The numbers of an accessor of single precision.
fn floats(json: &Value, binary: &[u8], accessor: usize) -> Vec<f32> {
    let view = &json["bufferViews"][json["accessors"][accessor]["bufferView"].as_u64().unwrap() as usize];
    let (start, length) =
        (view["byteOffset"].as_u64().unwrap() as usize, view["byteLength"].as_u64().unwrap() as usize);
    assert_eq!(start % 4, 0);
    binary[start..start + length].as_chunks().0.iter().map(|&bytes| f32::from_le_bytes(bytes)).collect()
}

#[test]
fn a_moving_surface_holds_each_frame_as_the_rest_plus_a_target() {
    let (rest, faces, frames) = turning_box(5);
    let folder = tempdir().unwrap();
    let path = folder.path().join("a.glb");
    write_glb(&path, &rest, &faces, &frames).unwrap();
    let bytes = fs::read(&path).unwrap();
    let (json, binary) = chunks(&bytes);
    let primitive = &json["meshes"][0]["primitives"][0];
    let base = floats(&json, binary, primitive["attributes"]["POSITION"].as_u64().unwrap() as usize);
    // the node in the middle of the box is on no face
    assert_eq!(base.len(), 3 * 26);
    let used: Vec<usize> = (0..rest.len()).filter(|i| faces.iter().flatten().any(|j| j == i)).collect();
    for (frame, target) in frames.iter().zip(primitive["targets"].as_array().unwrap()) {
        let moved = floats(&json, binary, target["POSITION"].as_u64().unwrap() as usize);
        let expected = used.iter().flat_map(|&i| frame.positions[i].iter().copied());
        for ((base, moved), expected) in base.iter().zip(&moved).zip(expected) {
            approx::assert_abs_diff_eq!(f64::from(base + moved), expected, epsilon = 1e-6);
        }
    }
    let sampler = &json["animations"][0]["samplers"][0];
    let weights = floats(&json, binary, sampler["output"].as_u64().unwrap() as usize);
    let times = floats(&json, binary, sampler["input"].as_u64().unwrap() as usize);
    assert_eq!(times, [0.0, 0.04, 0.08, 0.12, 0.16]);
    assert!(weights.iter().enumerate().all(|(i, &weight)| weight == if i % 6 == 0 { 1.0 } else { 0.0 }));
}

#[test]
fn normals_are_unit_vectors_also_where_faces_cancel() {
    let folder = tempdir().unwrap();
    let path = folder.path().join("a.glb");
    let rest = [Vector3::zeros(), Vector3::x(), Vector3::z()];
    write_glb(&path, &rest, &[[0, 1, 2], [0, 2, 1]], &[]).unwrap();
    let bytes = fs::read(&path).unwrap();
    let (json, binary) = chunks(&bytes);
    assert!(json.get("animations").is_none());
    let normals = floats(&json, binary, 2);
    assert!(normals.chunks(3).all(|n| n.iter().map(|x| x * x).sum::<f32>() == 1.0), "{normals:?}");
}

#[test]
fn frames_that_do_not_fit_the_surface_are_refused_with_their_number() {
    let (rest, faces, mut frames) = turning_box(3);
    let refusal = |frames: &[Frame]| write_glb(Path::new("a.glb"), &rest, &faces, frames).unwrap_err().to_string();
    frames[2].time = frames[1].time;
    assert!(refusal(&frames).contains("a.glb: frame 2 (counted from 0) has the time 0.04 s, which is not after"));
    frames[2].time = f64::NAN;
    assert!(refusal(&frames).contains("frame 2"));
    frames.pop();
    frames[1].positions[3].x = 1e39;
    assert!(refusal(&frames).contains("frame 1 (counted from 0) has a position of vertex 3 that is not finite"));
    frames[1].positions.pop();
    assert!(refusal(&frames).contains("frame 1 (counted from 0) has 26 vertices and the rest 27"));
    assert!(write_glb(Path::new("a.glb"), &rest, &[], &[]).unwrap_err().to_string().contains("no faces"));
}

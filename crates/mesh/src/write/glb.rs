//! A moving surface as binary glTF, for Blender and web viewers. Source: Khronos Group, glTF 2.0 specification.

use std::io::{self, Write};
use std::path::Path;

use nalgebra::Vector3;
use serde_json::{Value, json};

use super::save;
use crate::{MeshError, Problem, area_vector};

// Constants of the specification for component types and buffer targets.
const FLOAT: u32 = 5126;
const UNSIGNED_INT: u32 = 5125;
const VERTICES: u32 = 34962;
const INDICES: u32 = 34963;

/// Positions of the surface at one time.
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    /// Seconds since the start; not negative, and each frame later than the one before.
    pub time: f64,
    /// `(n)` position of each vertex, m.
    pub positions: Vec<Vector3<f64>>,
}

/// Writes a surface with smooth normals, and its motion as one morph target per frame, linear in time between frames.
///
/// `rest  (n)` is the shape without animation, m; `faces` are its triangles, counter-clockwise from outside. Vertices without a
/// face are not written. Positions become single precision. The file takes 24 bytes per written vertex for
/// the rest and again for each frame, 12 per face, and 4 per frame squared: 13 002 vertices in 100 frames are 32 MB, and 4 GiB is the
/// most that the format allows. Panics if a face's index is out of range.
pub fn write_glb(path: &Path, rest: &[Vector3<f64>], faces: &[[usize; 3]], frames: &[Frame]) -> Result<(), MeshError> {
    let (vertices, faces) = compact(rest.len(), faces);
    let in_file = |problem| MeshError::in_file(path, problem);
    if faces.is_empty() {
        return Err(in_file(Problem::Empty { what: "faces" }));
    }
    check_frames(rest, frames).map_err(in_file)?;
    check_size(vertices.len(), faces.len(), frames.len()).map_err(in_file)?;
    let buffer = fill(rest, &vertices, &faces, frames);
    let mut json = document(&buffer, frames.len()).to_string().into_bytes();
    let mut numbers = buffer.bytes;
    // Chunks end at a multiple of 4 bytes.
    json.resize(json.len().next_multiple_of(4), b' ');
    numbers.resize(numbers.len().next_multiple_of(4), 0);
    save(path, &mut |out| write_chunks(out, &json, &numbers))
}

/// The vertices of the faces, ascending, and the faces in the numbers of these vertices.
fn compact(count: usize, faces: &[[usize; 3]]) -> (Vec<usize>, Vec<[u32; 3]>) {
    let mut used = vec![false; count];
    for &vertex in faces.iter().flatten() {
        used[vertex] = true;
    }
    let vertices: Vec<usize> = (0..count).filter(|&vertex| used[vertex]).collect();
    let mut number = vec![0; count];
    for (new, &old) in vertices.iter().enumerate() {
        number[old] = new as u32;
    }
    (vertices, faces.iter().map(|face| face.map(|vertex| number[vertex])).collect())
}

fn check_frames(rest: &[Vector3<f64>], frames: &[Frame]) -> Result<(), Problem> {
    // A number too large for single precision would be infinite in the file.
    let finite = |x: &Vector3<f64>| x.iter().all(|&coordinate| (coordinate as f32).is_finite());
    if let Some(vertex) = rest.iter().position(|x| !finite(x)) {
        return Err(Problem::VertexNotFinite { vertex });
    }
    let mut last = -1.0;
    for (frame, Frame { time, positions }) in frames.iter().enumerate() {
        let refuse = |reason| Err(Problem::Frame { frame, reason });
        let time = *time as f32;
        if !(time.is_finite() && time >= 0.0 && time > last) {
            return refuse(format!("has the time {time} s, which is not after the one before it"));
        }
        last = time;
        if positions.len() != rest.len() {
            return refuse(format!("has {} vertices and the rest {}", positions.len(), rest.len()));
        }
        if let Some(vertex) = positions.iter().position(|x| !finite(x)) {
            return refuse(format!("has a position of vertex {vertex} that is not finite"));
        }
    }
    Ok(())
}

fn check_size(vertices: usize, faces: usize, frames: usize) -> Result<(), Problem> {
    let (v, f, n) = (vertices as f64, faces as f64, frames as f64);
    // At most 500 bytes for the description of each frame and of the rest.
    let bytes = 24.0 * v * (n + 1.0) + 12.0 * f + 4.0 * n * (n + 1.0) + 500.0 * (n + 4.0);
    if bytes > f64::from(u32::MAX) {
        let found = format!("a .glb file of {bytes:e} bytes");
        return Err(Problem::Unsupported {
            found,
            instead: "the format ends at 4 GiB: pass fewer frames or a coarser surface",
        });
    }
    Ok(())
}

/// The binary part of the file, and the descriptions of its arrays.
#[derive(Default)]
struct Buffer {
    bytes: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
}

impl Buffer {
    /// Appends an array of numbers of 4 bytes, so that every array begins at a multiple of 4 as the format asks.
    fn push(&mut self, numbers: impl Iterator<Item = [u8; 4]>, target: Option<u32>, mut accessor: Value) {
        let start = self.bytes.len();
        self.bytes.extend(numbers.flatten());
        let mut view = json!({ "buffer": 0, "byteOffset": start, "byteLength": self.bytes.len() - start });
        if let Some(target) = target {
            view["target"] = json!(target);
        }
        accessor["bufferView"] = json!(self.views.len());
        self.views.push(view);
        self.accessors.push(accessor);
    }

    fn push_vectors(&mut self, vectors: &[Vector3<f32>]) {
        let (mut min, mut max) = (vectors[0], vectors[0]);
        for x in vectors {
            (min, max) = (min.inf(x), max.sup(x));
        }
        let accessor = json!({ "componentType": FLOAT, "count": vectors.len(), "type": "VEC3",
            "min": min.as_slice(), "max": max.as_slice() });
        self.push(vectors.iter().flatten().map(|x| x.to_le_bytes()), Some(VERTICES), accessor);
    }

    fn push_indices(&mut self, faces: &[[u32; 3]]) {
        let accessor = json!({ "componentType": UNSIGNED_INT, "count": 3 * faces.len(), "type": "SCALAR" });
        self.push(faces.iter().flatten().map(|i| i.to_le_bytes()), Some(INDICES), accessor);
    }

    fn push_scalars(&mut self, numbers: &[f32]) {
        let min = numbers.iter().copied().fold(f32::INFINITY, f32::min);
        let max = numbers.iter().copied().fold(f32::NEG_INFINITY, f32::max);
        let accessor =
            json!({ "componentType": FLOAT, "count": numbers.len(), "type": "SCALAR", "min": [min], "max": [max] });
        self.push(numbers.iter().map(|x| x.to_le_bytes()), None, accessor);
    }
}

/// Fills the buffer in this order: indices, positions, normals, then displacements and changes of normals of each frame, then
/// times and weights of the frames.
fn fill(rest: &[Vector3<f64>], vertices: &[usize], faces: &[[u32; 3]], frames: &[Frame]) -> Buffer {
    let mut buffer = Buffer::default();
    buffer.push_indices(faces);
    let shape = |all: &[Vector3<f64>]| -> (Vec<Vector3<f32>>, Vec<Vector3<f32>>) {
        let places: Vec<_> = vertices.iter().map(|&i| all[i]).collect();
        let normals = smooth_normals(&places, faces);
        (single(&places), single(&normals))
    };
    let (places, normals) = shape(rest);
    buffer.push_vectors(&places);
    buffer.push_vectors(&normals);
    for frame in frames {
        let (moved, turned) = shape(&frame.positions);
        buffer.push_vectors(&differences(&moved, &places));
        buffer.push_vectors(&differences(&turned, &normals));
    }
    if !frames.is_empty() {
        let times: Vec<f32> = frames.iter().map(|frame| frame.time as f32).collect();
        buffer.push_scalars(&times);
        let mut weights = vec![0.0; frames.len() * frames.len()];
        weights.iter_mut().step_by(frames.len() + 1).for_each(|weight| *weight = 1.0);
        buffer.push_scalars(&weights);
    }
    buffer
}

fn single(vectors: &[Vector3<f64>]) -> Vec<Vector3<f32>> {
    vectors.iter().map(|x| x.map(|coordinate| coordinate as f32)).collect()
}

fn differences(to: &[Vector3<f32>], from: &[Vector3<f32>]) -> Vec<Vector3<f32>> {
    to.iter().zip(from).map(|(to, from)| to - from).collect()
}

/// Unit normal at each vertex: the sum of its faces' normals weighted by area, or upward if that is zero, which glTF does not
/// allow.
fn smooth_normals(places: &[Vector3<f64>], faces: &[[u32; 3]]) -> Vec<Vector3<f64>> {
    let mut normals = vec![Vector3::zeros(); places.len()];
    for face in faces {
        let normal = area_vector(face.map(|i| places[i as usize]));
        for &vertex in face {
            normals[vertex as usize] += normal;
        }
    }
    normals.iter().map(|normal| normal.try_normalize(0.0).unwrap_or_else(Vector3::y)).collect()
}

/// The JSON part of the file.
fn document(buffer: &Buffer, frames: usize) -> Value {
    let targets: Vec<Value> = (0..frames).map(|k| json!({ "POSITION": 3 + 2 * k, "NORMAL": 4 + 2 * k })).collect();
    let mut primitive = json!({ "attributes": { "POSITION": 1, "NORMAL": 2 }, "indices": 0 });
    let mut document = json!({
        "asset": { "version": "2.0", "generator": "finite-elements-3d" },
        "scene": 0,
        "scenes": [{ "nodes": [0] }],
        "nodes": [{ "mesh": 0, "name": "body" }],
        "buffers": [{ "byteLength": buffer.bytes.len() }],
        "bufferViews": buffer.views,
        "accessors": buffer.accessors,
    });
    let mut mesh = json!({ "name": "surface" });
    if frames > 0 {
        primitive["targets"] = json!(targets);
        mesh["weights"] = json!(vec![0; frames]);
        let (times, weights) = (3 + 2 * frames, 4 + 2 * frames);
        document["animations"] = json!([{
            "name": "motion",
            "samplers": [{ "input": times, "output": weights, "interpolation": "LINEAR" }],
            "channels": [{ "sampler": 0, "target": { "node": 0, "path": "weights" } }],
        }]);
    }
    mesh["primitives"] = json!([primitive]);
    document["meshes"] = json!([mesh]);
    document
}

/// Writes the header and the two chunks.
fn write_chunks(out: &mut dyn Write, json: &[u8], numbers: &[u8]) -> io::Result<()> {
    let length = |bytes: usize| u32::try_from(bytes).map(u32::to_le_bytes).map_err(io::Error::other);
    out.write_all(b"glTF")?;
    out.write_all(&2_u32.to_le_bytes())?;
    out.write_all(&length(12 + 8 + json.len() + 8 + numbers.len())?)?;
    for (kind, bytes) in [(b"JSON", json), (b"BIN\0", numbers)] {
        out.write_all(&length(bytes.len())?)?;
        out.write_all(kind)?;
        out.write_all(bytes)?;
    }
    Ok(())
}

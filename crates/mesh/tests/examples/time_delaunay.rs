//! Times the Delaunay mesh of points for other programs to be compared with:
//! `cargo run --release -p fem-mesh-tests --example time_delaunay -- DIMENSIONS REPEATS POINTS OUT`.
//!
//! `POINTS` are the coordinates as bytes, eight for each, little-endian; `OUT` receives the numbers of the elements' corners, four bytes for each.
//! Prints the time of the fastest run, s.

use std::time::Instant;

use fem_mesh::Mesh;
use fem_mesh::generate::delaunay::{Delaunay, DelaunayError, tetrahedralize, triangulate};
use nalgebra::SVector;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [dimensions, repeats, points, out] = &arguments[..] else {
        return Err("give DIMENSIONS REPEATS POINTS OUT".into());
    };
    let (bytes, repeats) = (std::fs::read(points)?, repeats.parse()?);
    let (seconds, corners) = match dimensions.as_str() {
        "2" => fastest(&bytes, repeats, triangulate)?,
        "3" => fastest(&bytes, repeats, |points| tetrahedralize(points, &|_| ()))?,
        _ => return Err("give 2 or 3 DIMENSIONS".into()),
    };
    std::fs::write(out, corners)?;
    println!("{seconds:.6}");
    Ok(())
}

/// The time of the fastest of some runs, s, and the corners of the elements as bytes.
fn fastest<const D: usize, const N: usize>(
    bytes: &[u8],
    repeats: usize,
    make: fn(&[SVector<f64, D>]) -> Result<Delaunay<D, N>, DelaunayError>,
) -> Result<(f64, Vec<u8>), DelaunayError> {
    let coordinates: Vec<f64> = bytes.as_chunks::<8>().0.iter().map(|&bytes| f64::from_le_bytes(bytes)).collect();
    let points: Vec<SVector<f64, D>> = coordinates.as_chunks::<D>().0.iter().map(|&x| x.into()).collect();
    let (mut seconds, mut mesh) = (f64::INFINITY, Mesh::new(Vec::new(), Vec::new()));
    for _ in 0..repeats {
        let start = Instant::now();
        let found = make(&points)?;
        seconds = seconds.min(start.elapsed().as_secs_f64());
        mesh = found.mesh;
    }
    let corners = mesh.elements.iter().flatten().flat_map(|&corner| (corner as u32).to_le_bytes());
    Ok((seconds, corners.collect()))
}

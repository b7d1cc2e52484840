//! Meshes pictures, times it and writes the meshes for other programs to be compared with:
//! `cargo run --release -p fem-mesh-tests --example mesh_pictures -- FOLDER EDGE ITERATIONS PICTURE…`.
//!
//! Prints a line `name,triangles,wish,worst,99 %,median,seconds from the boundary,seconds from the pixels,pixel` for each; `FOLDER/NAME.poly.csv` holds the edges of the mesh's boundary.

use std::collections::HashSet;
use std::fmt::Write;
use std::path::Path;
use std::time::Instant;

use fem_mesh::generate::picture::{FromPicture, mesh_picture, read_picture};
use fem_mesh::triangle_quality;

/// Meshes that are made of each picture; the fastest counts.
const REPEATS: usize = 25;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [folder, edge, improve, pictures @ ..] = &arguments[..] else {
        return Err("give FOLDER EDGE ITERATIONS PICTURE…".into());
    };
    let options = FromPicture { edge: edge.parse()?, height: 1.0, improve: improve.parse()? };
    for file in pictures.iter().map(Path::new) {
        let picture = read_picture(file)?;
        let mut found = mesh_picture(&picture, options)?;
        let (mut seconds, mut meshing) = (f64::INFINITY, found.meshing);
        for _ in 0..REPEATS {
            let start = Instant::now();
            found = mesh_picture(&picture, options)?;
            seconds = seconds.min(start.elapsed().as_secs_f64());
            meshing = meshing.min(found.meshing);
        }
        let name = file.file_stem().unwrap_or_default().to_string_lossy();
        let quality = triangle_quality(&found.mesh);
        let ratios = [quality.radius_to_edge.value, quality.radius_to_edge_99, quality.median_radius_to_edge];
        println!(
            "{name},{},{:.0},{:.4},{:.4},{:.4},{:.6},{seconds:.6},{}",
            quality.triangles,
            found.wish,
            ratios[0],
            ratios[1],
            ratios[2],
            meshing.as_secs_f64(),
            found.pixel
        );
        let sides = found.mesh.elements.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
        let sides: HashSet<[usize; 2]> = sides.collect();
        let mut boundary: Vec<_> = sides.iter().filter(|[a, b]| !sides.contains(&[*b, *a])).collect();
        boundary.sort_unstable();
        let mut text = String::new();
        for [a, b] in boundary {
            let [a, b] = [a, b].map(|&vertex| found.mesh.vertices[vertex]);
            writeln!(text, "{},{},{},{}", a.x, a.y, b.x, b.y)?;
        }
        std::fs::write(Path::new(folder).join(format!("{name}.poly.csv")), text)?;
    }
    Ok(())
}

//! The thesis' five objects as flat bodies.

use std::path::Path;

use fem_engine::simulator::Simulator;
use fem_mesh::generate::picture::{FromPicture, Picture, PictureMesh, mesh_picture, read_picture};
use fem_mesh::{Mesh, SurfaceMesh};
use fem_model::BodyMesh;

use crate::scenes::double;

/// The objects, each a picture in `data/pictures`.
pub const OBJECTS: [&str; 5] = ["donut", "armadillo", "bunny", "triangle", "square"];

/// Density of the thesis' bodies, kg/m³, and their Lamé constants λ = μ, Pa.
pub const DENSITY: f64 = 140.5;
pub const LAME: f64 = 45_000.0;

/// The picture of an object.
pub fn picture(data: &Path, name: &str) -> Result<Picture, String> {
    read_picture(&data.join(format!("pictures/{name}.png"))).map_err(|error| error.to_string())
}

/// Triangles of a picture for a height of 1 m.
pub fn meshed(picture: &Picture, edge: f64, improve: usize) -> Result<PictureMesh, String> {
    mesh_picture(picture, FromPicture { edge, height: 1.0, improve }).map_err(|error| error.to_string())
}

/// A corotated body of 1 m thickness with λ = μ, which has ν = 1/4 and E = 2.5 μ; its mass is lumped.
pub fn simulator(mesh: &Mesh<2, 3>, lame: f64, method: &str, rest: &str) -> Result<Simulator<f64>, String> {
    let text = format!(
        "pipeline = \"engine\"\n[mesh]\nrectangle = {{ size = [1, 1], cells_per_unit = 1 }}\n[material]\nmodel = \"corotated\"\n\
         young = {:e}\npoisson = 0.25\ndensity = {DENSITY}\n[time]\n{method}\n[mass]\nlumped = true\n{rest}",
        2.5 * lame
    );
    let vertices = mesh.vertices.iter().map(|x| x.push(0.0)).collect();
    let triangles = SurfaceMesh::new(vertices, mesh.elements.clone());
    double(&text, Some(BodyMesh::flat(triangles, 1.0)))
}

/// Displacements of a few parts in a million of the height in which every vibration takes part: multiples of the golden ratio, modulo 1.
pub fn disturb(simulation: &mut Simulator<f64>, size: f64) {
    let nodes = simulation.system().shape.mesh.vertices().len();
    let entry = |k: usize| size * ((k as f64 * 0.618_033_988_749_894_9).fract() - 0.5);
    let displacements: Vec<[f64; 3]> = (0..nodes).map(|node| [entry(2 * node + 1), entry(2 * node + 2), 0.0]).collect();
    simulation.set_state(&displacements, &vec![[0.0; 3]; nodes]);
}

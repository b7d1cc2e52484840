//! The thesis' five objects as flat bodies.

use std::path::Path;

use fem_engine::simulator::Simulator;
use fem_mesh::generate::picture::{FromPicture, Picture, PictureMesh, mesh_picture, read_picture};
use fem_mesh::{Mesh, SurfaceMesh};
use fem_model::{Body, BodyMesh, Damping, DampingForm, Elastic, Integrator, Law, Material, Method};

use crate::study::Result;

/// The objects, each a picture in `data/pictures`.
pub const OBJECTS: [&str; 5] = ["donut", "armadillo", "bunny", "triangle", "square"];

/// Density of the thesis' bodies, kg/m³, and their Lamé constants λ = μ, Pa.
pub const DENSITY: f64 = 140.5;
pub const LAME: f64 = 45_000.0;

/// The picture of an object.
pub fn picture(data: &Path, name: &str) -> Result<Picture> {
    Ok(read_picture(&data.join(format!("pictures/{name}.png")))?)
}

/// Triangles of a picture for a height of 1 m.
pub fn meshed(picture: &Picture, edge: f64, improve: usize) -> Result<PictureMesh> {
    Ok(mesh_picture(picture, FromPicture { edge, height: 1.0, improve })?)
}

/// The corotated law with λ = μ, Pa, which has ν = 1/4 and E = 2.5 μ, and the density of the thesis.
pub fn material(lame: f64) -> Material {
    Material::new(Law::Corotated(Elastic::new(2.5 * lame, 0.25)), DENSITY)
}

/// A body of 1 m thickness with λ = μ and a damping of β, s; its mass is lumped.
pub fn body(mesh: &Mesh<2, 3>, lame: f64, beta: f64) -> Result<Body> {
    let vertices = mesh.vertices.iter().map(|x| x.push(0.0)).collect();
    let triangles = SurfaceMesh::new(vertices, mesh.elements.clone());
    let body = Body::new(BodyMesh::flat(triangles, 1.0), material(lame))?;
    let body = body.damping(Damping { alpha: 0.0, beta, form: DampingForm::default() })?;
    Ok(Body { lumped_mass: true, ..body })
}

/// The simulation of such a body by a method with steps of `dt`, s.
pub fn simulator(
    mesh: &Mesh<2, 3>,
    (lame, beta): (f64, f64),
    (integrator, dt): (Integrator, f64),
) -> Result<Simulator<f64>> {
    Ok(Simulator::new(body(mesh, lame, beta)?, &Method::new(integrator, dt))?)
}

/// Displacements of a few parts in a million of the height in which every vibration takes part: multiples of the golden ratio, modulo 1.
pub fn disturb(simulation: &mut Simulator<f64>, size: f64) {
    let nodes = simulation.system().shape.mesh.vertices().len();
    let entry = |k: usize| size * ((k as f64 * 0.618_033_988_749_894_9).fract() - 0.5);
    let displacements: Vec<[f64; 3]> = (0..nodes).map(|node| [entry(2 * node + 1), entry(2 * node + 2), 0.0]).collect();
    simulation.set_state(&displacements, &vec![[0.0; 3]; nodes]);
}

//! Fields of the nodes of a system, for tests of derivatives.

use std::path::Path;

use fem_engine::simulator::double::{self, System};
use fem_engine::solvers::SolverChoice;

use crate::scene;

/// The system of a scene.
pub fn system(text: &str) -> System {
    let body = fem_scene::body(&scene(text), Path::new("no data")).unwrap_or_else(|error| panic!("{error}"));
    double::system(body, SolverChoice::Cholesky)
}

/// A field that is not affine, in the plane of a flat body, m.
pub fn field(system: &System, size: f64, phase: f64) -> Vec<[f64; 3]> {
    let is_flat = system.shape.mesh.dimension() == 2;
    let entry = |node: usize, i: usize| size * ((node * 3 + i) as f64 * 1.7 + phase).sin();
    (0..system.nodes()).map(|node| [0, 1, 2].map(|i| if is_flat && i == 2 { 0.0 } else { entry(node, i) })).collect()
}

/// a · b
pub fn dot(a: &[[f64; 3]], b: &[[f64; 3]]) -> f64 {
    a.as_flattened().iter().zip(b.as_flattened()).map(|(a, b)| a * b).sum()
}

/// a + factor b
pub fn sum(a: &[[f64; 3]], factor: f64, b: &[[f64; 3]]) -> Vec<[f64; 3]> {
    a.iter().zip(b).map(|(a, b)| std::array::from_fn(|i| a[i] + factor * b[i])).collect()
}

//! Distance between a torus and the tetrahedra inside it, against the edge: `cargo run --release -p fem-mesh-tests --example distance_to_torus`.

use std::f64::consts::TAU;

use fem_mesh::generate::{Solid, StuffingError, stuff_graded};
use fem_mesh::{SurfaceMesh, boundary, quality};
use nalgebra::Vector3;

/// Radii 1 m and 0.4 m.
fn torus(around: usize, across: usize) -> SurfaceMesh {
    let place = |i: usize, j: usize| {
        let (u, v) = (TAU * i as f64 / around as f64, TAU * j as f64 / across as f64);
        let r = 1.0 + 0.4 * v.cos();
        Vector3::new(r * u.cos(), r * u.sin(), 0.4 * v.sin())
    };
    let at = |i: usize, j: usize| (i % around) * across + j % across;
    let two =
        |i: usize, j: usize| [[at(i, j), at(i + 1, j), at(i + 1, j + 1)], [at(i, j), at(i + 1, j + 1), at(i, j + 1)]];
    let cells = || (0..around).flat_map(|i| (0..across).map(move |j| (i, j)));
    SurfaceMesh::new(cells().map(|(i, j)| place(i, j)).collect(), cells().flat_map(|(i, j)| two(i, j)).collect())
}

fn root_mean_square(values: impl Iterator<Item = f64>) -> f64 {
    let (sum, count) = values.fold((0.0, 0.0), |(sum, count), x| (sum + x * x, count + 1.0));
    f64::sqrt(sum / count)
}

fn main() -> Result<(), StuffingError> {
    let surface = torus(960, 480);
    println!("edge, m  doublings  tetrahedra  mesh to torus, m  torus to mesh, m  smallest, largest dihedral angle, °");
    for edge in [0.2, 0.1, 0.05, 0.025] {
        for doublings in [0, 4] {
            let mesh = stuff_graded(&surface, edge, doublings, &|_| ())?;
            let faces = boundary(&mesh);
            let to = root_mean_square(faces.iter().map(|face| {
                let x = face.iter().map(|&i| mesh.vertices[i]).sum::<Vector3<f64>>() / 3.0;
                (x.x.hypot(x.y) - 1.0).hypot(x.z) - 0.4
            }));
            let solid = Solid::new(&SurfaceMesh::new(mesh.vertices.clone(), faces));
            let closest = surface.vertices.iter().filter_map(|x| Some((solid.closest(x)? - x).norm()));
            let [smallest, largest] = quality(&mesh).dihedral_angles.map(|angle| angle.value);
            let from = root_mean_square(closest);
            println!(
                "{edge:7}  {doublings:9}  {:10}  {to:16.2e}  {from:16.2e}  {smallest:.2}, {largest:.2}",
                mesh.elements.len()
            );
        }
    }
    Ok(())
}

//! 4. Mesh in, stress out: a body sags under its weight, and its stress is written for ParaView.
//!
//! `cargo run --release --example 04_mesh_in_stress_out -- MESH OUT.vtu`, MESH a .node (with .ele), .mesh, .msh or .vtu

use std::error::Error;
use std::path::{Path, PathBuf};

use fem_mesh::read_tetrahedra;
use fem_model::{Axis, Body, Elastic, Integrator, Law, Material, Method, Region, Selector};
use fem_output::{export, von_mises};

/// The largest von Mises stress, its element, and the reaction force at the feet.
pub struct Found {
    /// Pa
    pub von_mises: f64,
    pub element: usize,
    /// N
    pub reaction: [f64; 3],
    /// N
    pub weight: f64,
}

const DENSITY: f64 = 1000.0;

pub fn run(mesh: &Path, out: &Path) -> Result<Found, Box<dyn Error>> {
    let rubber = Material::new(Law::StableNeoHookean(Elastic::new(1e6, 0.4)), DENSITY);
    let feet = Selector::Region(Region::Plane { axis: Axis::Y, below: 0.1 });
    let body = Body::new(read_tetrahedra(mesh)?, rubber)?.gravity([0.0, -9.81, 0.0])?.fix(&feet)?;
    let method = Method { load_steps: 4, ..Method::new(Integrator::Static, 1.0) };
    let volume: f64 = body.shape.mesh.volumes().iter().sum();
    let mut simulation = fem_engine::simulator::build(body, &method)?;
    for _ in 0..method.load_steps {
        simulation.step()?;
    }
    export(out, &*simulation, &[])?;
    let stresses = simulation.stresses().into_iter().map(|stress| von_mises(&stress)).enumerate();
    let (element, von_mises) = stresses.max_by(|a, b| a.1.total_cmp(&b.1)).ok_or("the mesh has no element")?;
    let reaction = simulation.reactions().first().ok_or("no node is fixed")?.force;
    Ok(Found { von_mises, element, reaction, weight: 9.81 * DENSITY * volume })
}

#[allow(dead_code)] // the test calls `run`
fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args_os().skip(1).map(PathBuf::from);
    let mesh = arguments.next().unwrap_or_else(|| "data/own/armadillo_own_coarse.node".into());
    let out = arguments.next().unwrap_or_else(|| std::env::temp_dir().join("stress.vtu"));
    let found = run(&mesh.canonicalize()?, &out)?;
    println!("largest von Mises stress: {:.4e} Pa, in element {}", found.von_mises, found.element);
    println!("weight {:.6} N, reaction at the feet {:.6} N", found.weight, found.reaction[1]);
    println!("{}: open it in ParaView", out.display());
    Ok(())
}

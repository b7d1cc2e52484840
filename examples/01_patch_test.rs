//! 1. A law in a patch test: under uniaxial tension, every element of an irregular mesh must have the same stress.
//!
//! `cargo run --release --example 01_patch_test`

use std::error::Error;
use std::path::Path;

use fem_mesh::{Pattern, TetrahedralMesh, box_mesh};
use nalgebra::Vector3;

/// Names and parameters of all laws: Young's modulus 1 MPa and Poisson's ratio 0.3 at small strain.
const LAWS: [(&str, &str); 8] = [
    ("linear", "young = 1e6\npoisson = 0.3"),
    ("corotated", "young = 1e6\npoisson = 0.3"),
    ("st_venant_kirchhoff", "young = 1e6\npoisson = 0.3"),
    ("neo_hookean", "young = 1e6\npoisson = 0.3"),
    ("stable_neo_hookean", "young = 1e6\npoisson = 0.3"),
    ("hencky", "young = 1e6\npoisson = 0.3"),
    ("mooney_rivlin", "C10 = 1.2e5\nC01 = 7.2e4\nD = 4.2e5"),
    ("yeoh", "C1 = 1.92e5\nC2 = -1e4\nC3 = 1e4\nD = 4.2e5"),
];

/// A cube between three rollers whose end is pulled out by 20 %.
fn scene(law: &str, parameters: &str) -> String {
    let roller = |axis: &str, side: &str, displacement: [f64; 3]| {
        format!(
            "[[prescribed]]\non = {{ axis = \"{axis}\", side = \"{side}\", within = 1e-9 }}\n\
             displacement = {displacement:?}\ncomponents = [\"{axis}\"]\n"
        )
    };
    let rollers = ["x", "y", "z"].map(|axis| roller(axis, "min", [0.0; 3])).concat();
    format!(
        "pipeline = \"engine\"\n[mesh]\nbox = {{ size = [1, 1, 1], cells_per_unit = 3 }}\n\
         [material]\nmodel = \"{law}\"\n{parameters}\ndensity = 1000\n\
         [time]\nintegrator = \"static\"\n{rollers}{}",
        roller("x", "max", [0.2, 0.0, 0.0])
    )
}

/// The cube of the scene with its inner nodes moved about.
fn irregular_mesh() -> Result<TetrahedralMesh, Box<dyn Error>> {
    let mut mesh = box_mesh([1.0; 3], 3, Pattern::Alternating)?;
    for (i, x) in mesh.vertices.iter_mut().enumerate().filter(|(_, x)| x.iter().all(|&x| x > 0.1 && x < 0.9)) {
        *x += 0.05 * Vector3::new((7.0 * i as f64).sin(), (8.0 * i as f64).sin(), (9.0 * i as f64).sin());
    }
    Ok(mesh)
}

/// Name of a law, its Cauchy stress along x (Pa), and the largest relative difference between two elements.
type Outcome = (&'static str, f64, f64);

/// The patch test of every law.
pub fn run() -> Result<Vec<Outcome>, Box<dyn Error>> {
    let mut results = Vec::new();
    for (law, parameters) in LAWS {
        let scene = fem_scene::parse(&scene(law, parameters), Path::new("patch.toml"))?;
        let body = fem_scene::body_of(&scene, irregular_mesh()?, Path::new("data"))?;
        let mut simulation = fem_engine::simulator::build(&scene, body)?;
        simulation.step()?;
        let stresses = simulation.stresses();
        let difference = stresses.iter().map(|stress| (stress - stresses[0]).amax()).fold(0.0, f64::max);
        results.push((law, stresses[0][(0, 0)], difference / stresses[0].amax()));
    }
    Ok(results)
}

#[allow(dead_code)] // the test calls `run`
fn main() -> Result<(), Box<dyn Error>> {
    for (law, stress, difference) in run()? {
        println!("{law:<20} stress {stress:.6e} Pa, differs by {difference:.1e} between elements");
    }
    Ok(())
}

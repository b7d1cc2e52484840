//! 1. A law in a patch test: under uniaxial tension, every element of an irregular mesh must have the same stress.
//!
//! `cargo run --release --example 01_patch_test`

use std::error::Error;

use fem_mesh::{Pattern, TetrahedralMesh, box_mesh};
use fem_model::{Axis, Body, Elastic, Integrator, Law, Material, Method, Motion, NeoHookean, Selector};
use nalgebra::Vector3;

/// All laws: Young's modulus 1 MPa and Poisson's ratio 0.3 at small strain.
fn laws() -> [Law; 10] {
    let elastic = Elastic::new(1e6, 0.3);
    [
        Law::Linear(elastic),
        Law::Corotated(elastic),
        Law::StVenantKirchhoff(elastic),
        Law::NeoHookean(NeoHookean::Elastic(elastic)),
        Law::StableNeoHookean(elastic),
        Law::Hencky(elastic),
        Law::MooneyRivlin { C10: 1.2e5, C01: 7.2e4, D: 4.2e5 },
        Law::Gent { C: 1.92e5, Jm: 50.0, D: 4.2e5 },
        Law::Yeoh { C1: 1.92e5, C2: -1e4, C3: 1e4, D: 4.2e5 },
        Law::Ogden { terms: [Some([4.0e5, 1.3]), Some([1.0e3, 5.0]), Some([-1.22e5, -2.0])], D: 4.2e5 },
    ]
}

/// A cube between three rollers whose end is moved out by 20 %.
fn stretched(law: Law) -> Result<Body, Box<dyn Error>> {
    let mut body = Body::new(irregular_mesh()?, Material::new(law, 1000.0))?;
    for (axis, components) in
        [(Axis::X, [true, false, false]), (Axis::Y, [false, true, false]), (Axis::Z, [false, false, true])]
    {
        body = body.prescribe(&Selector::least(axis), components, Motion::by([0.0; 3]))?;
    }
    Ok(body.prescribe(&Selector::most(Axis::X), [true, false, false], Motion::by([0.2, 0.0, 0.0]))?)
}

/// A cube with its inner nodes moved about.
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
    for law in laws() {
        let mut simulation = fem_engine::simulator::build(stretched(law)?, &Method::new(Integrator::Static, 1.0))?;
        simulation.step()?;
        let stresses = simulation.stresses();
        let difference = stresses.iter().map(|stress| (stress - stresses[0]).amax()).fold(0.0, f64::max);
        results.push((law.name(), stresses[0][(0, 0)], difference / stresses[0].amax()));
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

//! 2. A force of one's own through the trait `Potential`: a rubber cube falls onto an elastic floor and comes to rest.
//!
//! `cargo run --release --example 02_own_potential`

use std::error::Error;

use fem_engine::forces::{AddBlock, Energy, HessianKind, Moment, Potential};
use fem_engine::numbering::Numbering;
use fem_engine::simulator::Simulator;
use fem_mesh::{Pattern, box_mesh};
use fem_model::simulation::Simulation;
use fem_model::{Body, Elastic, Integrator, Law, Material, Method, NeoHookean};

/// A floor 0.1 m below the undeformed cube: ½ k z² for every node at a height z < 0 above it.
struct Floor {
    /// k, N/m
    stiffness: f64,
    /// Undeformed height of each node above the floor, m, in the engine's numbering.
    heights: Vec<f64>,
}

impl Floor {
    /// The nodes below the floor, and their (negative) heights, m.
    fn contacts(&self, u: &[[f64; 3]]) -> impl Iterator<Item = (usize, f64)> {
        let heights = self.heights.iter().zip(u).map(|(height, u)| height + u[2]);
        heights.enumerate().filter(|&(_, height)| height < 0.0)
    }
}

impl Potential<f64> for Floor {
    fn name(&self) -> &'static str {
        "floor"
    }

    fn description(&self) -> String {
        format!("an elastic floor of {:e} N/m", self.stiffness)
    }

    fn bytes(&self) -> usize {
        size_of_val(&self.heights[..])
    }

    fn energy(&self, u: &[[f64; 3]], _: Moment) -> Energy {
        self.contacts(u).map(|(_, z)| Energy::of(0.5 * self.stiffness * z * z)).sum()
    }

    fn add_gradient(&self, u: &[[f64; 3]], _: Moment, gradient: &mut [[f64; 3]]) {
        self.contacts(u).for_each(|(node, z)| gradient[node][2] += self.stiffness * z);
    }

    fn hessian(&self, u: &[[f64; 3]], _: Moment, _: HessianKind, add: &mut AddBlock<f64>) {
        let block = [[0.0; 3], [0.0; 3], [0.0, 0.0, self.stiffness]];
        self.contacts(u).for_each(|(node, _)| add(node, node, block));
    }
}

/// The force of the floor after 6 s, and the weight of the cube, N.
pub fn run() -> Result<(f64, f64), Box<dyn Error>> {
    let (mesh, stiffness) = (box_mesh([1.0; 3], 2, Pattern::default())?, 1e6);
    let rubber = Material::new(Law::NeoHookean(NeoHookean::Elastic(Elastic::new(1e5, 0.3))), 1000.0);
    let body = Body::new(mesh, rubber)?.gravity([0.0, 0.0, -9.81])?;
    let method = Method::new(Integrator::ImplicitEuler, 0.02);
    let vertices = body.shape.mesh.vertices().to_vec();
    let floor = |numbering: &Numbering| -> Vec<Box<dyn Potential<f64>>> {
        let heights = numbering.mesh_node.iter().map(|&node| vertices[node as usize].z + 0.1).collect();
        vec![Box::new(Floor { stiffness, heights })]
    };
    let mut simulation = Simulator::<f64>::with_forces(body, &method, &floor)?;
    for _ in 0..300 {
        simulation.step()?;
    }
    let heights: Vec<f64> = simulation.positions().iter().skip(2).step_by(3).map(|z| z + 0.1).collect();
    let force: f64 = heights.iter().filter(|&&z| z < 0.0).map(|z| -stiffness * z).sum();
    Ok((force, 9.81 * 1000.0))
}

#[allow(dead_code)] // the test calls `run`
fn main() -> Result<(), Box<dyn Error>> {
    let (force, weight) = run()?;
    println!("the floor carries {force:.3} N of a weight of {weight:.3} N");
    Ok(())
}

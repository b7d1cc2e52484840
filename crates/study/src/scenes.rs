//! Bodies and simulations of studies as values, and what many of them have in common.

use fem_engine::simulator::Simulator;
use fem_model::simulation::Simulation;
use fem_model::{Axis, Body, Law, Material, Method, Motion, Refusal, Selector, nodes};
use nalgebra::Vector3;

use crate::study::Result;

/// Springs along the edges of the mesh in place of a law.
pub const SPRINGS: &str = Law::SPRINGS.name;

/// A material of a density, kg/m³, by the name of its law in scene files, with Young's modulus, Pa, and Poisson's ratio, which springs have not.
pub fn material(law: &str, young: f64, poisson: f64, density: f64) -> Result<Material> {
    let facts = Law::named(law).ok_or_else(|| format!("there is no law `{law}`"))?;
    let given = |parameter: &str| match parameter {
        "young" => Some(young),
        "poisson" => Some(poisson),
        _ => None,
    };
    Ok(Material::new((facts.of)(&given), density))
}

/// Prescribes the displacement of nodes along one axis, m, which grows with the load steps of a static analysis.
pub fn displaced(body: Body, selector: &Selector, axis: Axis, by: f64) -> Result<Body, Refusal> {
    let components = [Axis::X, Axis::Y, Axis::Z].map(|other| other == axis);
    body.prescribe(selector, components, Motion::by(components.map(|moves| if moves { by } else { 0.0 })))
}

/// Adds a velocity at the start, m/s, to that of some nodes.
pub fn thrown(mut body: Body, selector: &Selector, velocity: [f64; 3]) -> Result<Body, Refusal> {
    let mesh = &body.shape.mesh;
    body.initial_velocity.resize(mesh.vertices().len(), Vector3::zeros());
    for node in nodes("initial_velocity", selector, mesh)? {
        body.initial_velocity[node] += Vector3::from(velocity);
    }
    Ok(body)
}

/// Adds a rotation at the start, 1/s, about an axis through the centre of mass of a uniform body.
pub fn spinning(mut body: Body, axis: [f64; 3], rate: f64) -> Body {
    let (mesh, density) = (&body.shape.mesh, body.material.density);
    let (mut mass, mut moment) = (0.0, Vector3::zeros());
    for (nodes, volume) in mesh.corners().zip(mesh.volumes()) {
        let sum: Vector3<f64> = nodes.iter().map(|&node| mesh.vertices()[node]).sum();
        mass += density * volume;
        moment += density * volume / nodes.len() as f64 * sum;
    }
    let (centre, spin) = (moment / mass, rate * Vector3::from(axis).normalize());
    body.initial_velocity.resize(mesh.vertices().len(), Vector3::zeros());
    for (velocity, x) in body.initial_velocity.iter_mut().zip(mesh.vertices()) {
        *velocity += spin.cross(&(x - centre));
    }
    body
}

/// The simulation of a body in double precision, whose mass is lumped if the method does so by default.
pub fn simulator(body: Body, method: &Method) -> Result<Simulator<f64>, Refusal> {
    Simulator::new(body.lump_mass_for(method), method)
}

/// Advances by one step, which must converge.
pub fn step(simulation: &mut dyn Simulation) -> Result<()> {
    simulation.step()?;
    match simulation.counters().unconverged_steps {
        0 => Ok(()),
        _ => Err(format!("step {} has not converged", simulation.steps()).into()),
    }
}

/// Advances by a number of steps, each of which must converge.
pub fn steps(simulation: &mut dyn Simulation, count: usize) -> Result<()> {
    (0..count).try_for_each(|_| step(simulation))
}

/// Displacement of a node, m.
pub fn displacement(simulation: &dyn Simulation, node: usize) -> Vector3<f64> {
    simulation.positions().fixed_rows::<3>(3 * node) - simulation.shape().mesh.vertices()[node]
}

/// Displacements of all nodes, m.
pub fn displacements(simulation: &dyn Simulation) -> Vec<Vector3<f64>> {
    let (shape, q) = (simulation.shape(), simulation.positions());
    shape.mesh.vertices().iter().enumerate().map(|(i, X)| q.fixed_rows::<3>(3 * i) - X).collect()
}

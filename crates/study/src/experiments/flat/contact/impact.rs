//! A bar that hits a wall: the wave of compression runs to its free end and back.

use fem_mesh::{Pattern, rectangle_mesh};
use fem_model::simulation::{Diagnostics, Simulation};
use fem_model::{Body, BodyMesh, ContactPlane, Integrator, Method};
use nalgebra::Vector3;

use super::{has_barrier, momentum};
use crate::scenes::{material, simulator, step};
use crate::study::Result;

/// 2 L/c for the bar of 1 m and c = 10 m/s, s.
pub const DURATION: f64 = 0.2;
/// ρ c v, Pa.
pub const STRESS: f64 = 1000.0;

/// An impact.
pub struct Impact {
    /// Time in contact, s.
    pub duration: f64,
    /// Mean stress of the wall while the wave runs, Pa.
    pub stress: f64,
    /// Relative difference of the wall's impulse and the change of momentum.
    pub impulse_error: f64,
}

/// A bar of 1 m in so many squares of two triangles of an order, without lateral contraction, which meets a wall at x = 0 with 0.1 m/s. A wave crosses
/// a square in two and a half steps.
pub fn bar(method: Integrator, cells: usize, order: usize) -> Result<Impact> {
    let width = 1.0 / cells as f64;
    let dt = 0.04 * width;
    let mesh = BodyMesh::flat(rectangle_mesh([1.0, width], cells, Pattern::Kuhn)?, 1.0);
    let mesh = mesh.of_order(order).ok_or("there is no such element")?;
    let body = Body::new(mesh, material("linear", 1e5, 0.0, 1000.0)?)?.velocity([-0.1, 0.0, 0.0])?;
    let (has_barrier, method) = (has_barrier(method), Method::new(method, dt));
    let wall = ContactPlane::new(Vector3::new(-1e-6, 0.0, 0.0), Vector3::x());
    let mut contact = body.contact_with(vec![wall], &method)?;
    if has_barrier {
        contact.activation_distance = 2e-3 * width;
    }
    let mut simulation = simulator(Body { contact: Some(contact), ..body }, &method)?;
    let before = momentum(&simulation);
    let (mut first, mut last, mut impulse, mut steady) = (f64::INFINITY, 0.0, 0.0, Vec::new());
    while simulation.time() < 0.3 {
        step(&mut simulation)?;
        let (time, force) = (simulation.time(), simulation.contacts()[0].force[0]);
        impulse += dt * force;
        if force > 0.0 {
            (first, last) = (f64::min(first, time), time);
        }
        if (0.04..0.16).contains(&time) {
            steady.push(force / width);
        }
    }
    let change = momentum(&simulation) - before;
    Ok(Impact {
        duration: last - first,
        stress: steady.iter().sum::<f64>() / steady.len() as f64,
        impulse_error: (impulse / change - 1.0).abs(),
    })
}

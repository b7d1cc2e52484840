//! A block on a floor: at rest on the barrier, and with Coulomb friction on an incline, which is a floor under a tilted gravity.

use fem_engine::simulator::Simulator;
use fem_mesh::{Pattern, rectangle_mesh};
use fem_model::simulation::{Diagnostics, Simulation};
use fem_model::{Body, BodyMesh, ContactPlane, Damping, DampingForm, Integrator, Method, NewtonSettings};
use nalgebra::Vector3;

use super::{has_barrier, momentum, travel};
use crate::scenes::{material, simulator, steps};
use crate::study::Result;

const G: f64 = 9.81;
/// Coefficient of friction.
pub const FRICTION: f64 = 0.4;
/// Velocity of the block that stops on a level floor, m/s.
pub const VELOCITY: f64 = 1.0;
/// Its distance to rest, m.
pub const STOPPING: f64 = VELOCITY * VELOCITY / (2.0 * FRICTION * G);
/// kg
const MASS: f64 = 1000.0;

/// A corotated square of 1 m, 1000 kg/m³ and a Young's modulus, Pa, under gravity, m/s².
fn square(young: f64, gravity: [f64; 3]) -> Result<Body> {
    let mesh = BodyMesh::flat(rectangle_mesh([1.0, 1.0], 1, Pattern::Alternating)?, 1.0);
    Ok(Body::new(mesh, material("corotated", young, 0.3, MASS)?)?.gravity(gravity)?)
}

/// A floor so far below the undeformed block, m.
fn floor(depth: f64) -> ContactPlane {
    ContactPlane::new(Vector3::new(0.0, -depth, 0.0), Vector3::y())
}

/// A stiff square on an incline of tan θ = `factor` μ, that slides down with an initial velocity, m/s. Without damping explicit Euler is
/// unstable; it leaves rigid motions alone.
fn incline(method: Integrator, dt: f64, factor: f64, velocity: f64) -> Result<Simulator<f64>> {
    let angle = (factor * FRICTION).atan();
    let gap = if has_barrier(method) { 9e-4 } else { 0.0 };
    let method = Method::new(method, dt);
    let damping = Damping { alpha: 0.0, beta: 2e-3, form: DampingForm::default() };
    let body =
        square(1e7, [G * angle.sin(), -G * angle.cos(), 0.0])?.damping(damping)?.velocity([velocity, 0.0, 0.0])?;
    let floor = ContactPlane { friction: FRICTION, ..floor(gap) };
    Ok(simulator(body.obstacles(vec![floor], &method)?, &method)?)
}

/// Time step of a method, s.
fn step_of(method: Integrator) -> f64 {
    match method {
        _ if has_barrier(method) => 5e-3,
        // Its vibrations die out slowly, and rock the body.
        Integrator::ExplicitEuler => 5e-5,
        _ => 5e-4,
    }
}

/// Time of a frame whose substeps are compared, s: the longest step at which the method still follows the stop.
pub fn frame(method: Integrator) -> f64 {
    2.0 * step_of(method)
}

/// The way in a second, after two seconds at tan θ = 0.99 μ, m.
pub fn creep(method: Integrator) -> Result<f64> {
    let dt = step_of(method);
    let mut simulation = incline(method, dt, 0.99, 0.0)?;
    steps(&mut simulation, (2.0 / dt) as usize)?;
    let before = travel(&simulation);
    steps(&mut simulation, (1.0 / dt) as usize)?;
    Ok(travel(&simulation) - before)
}

/// Acceleration at tan θ = `factor` μ > μ, found and by Coulomb's law, m/s².
pub fn acceleration(method: Integrator, factor: f64) -> Result<[f64; 2]> {
    let dt = step_of(method);
    let mut simulation = incline(method, dt, factor, 0.2)?;
    steps(&mut simulation, (0.2 / dt) as usize)?;
    let before = momentum(&simulation);
    steps(&mut simulation, (1.0 / dt) as usize)?;
    let angle = (factor * FRICTION).atan();
    Ok([(momentum(&simulation) - before) / MASS, G * (angle.sin() - FRICTION * angle.cos())])
}

/// The way to rest from 1 m/s on a level floor, m.
pub fn way(method: Integrator, dt: f64) -> Result<f64> {
    let mut simulation = incline(method, dt, 0.0, VELOCITY)?;
    steps(&mut simulation, (0.4 / dt).round() as usize)?;
    let speed = momentum(&simulation) / MASS;
    // A decaying shear vibration is left.
    if speed.abs() < 0.02 {
        Ok(travel(&simulation))
    } else {
        Err(format!("{}: the block still slides at {speed} m/s", method.name()).into())
    }
}

/// Weight of the block of 1000 kg, N.
pub const WEIGHT: f64 = 9810.0;
/// The activation distance of a block of 1 m, m.
pub const ACTIVATION: f64 = 1e-3;

/// A block at rest.
pub struct Block {
    /// Distance from the floor, m.
    pub gap: f64,
    /// The distance at which the barrier's force is the weight, m.
    pub root: f64,
    /// Force of the floor, N.
    pub force: f64,
    /// Steps that have not converged.
    pub unconverged: usize,
}

/// A square of 1 m of this Young's modulus (Pa) after 40 s. Displacements of steel are so small that round-off leaves nine
/// digits of a step; steps in which it leaves fewer are counted.
pub fn block(young: f64) -> Result<Block> {
    let newton = NewtonSettings { tolerance: Some(1e-9), ..NewtonSettings::default() };
    let method = Method { newton, ..Method::new(Integrator::ImplicitEuler, 0.02) };
    let body = square(young, [0.0, -G, 0.0])?.obstacles(vec![floor(5e-4)], &method)?;
    let mut simulation = simulator(body, &method)?;
    for _ in 0..2000 {
        simulation.step()?;
    }
    let contact = &simulation.contacts()[0];
    let unconverged = simulation.counters().unconverged_steps;
    Ok(Block { gap: contact.smallest_gap, root: root(young), force: contact.force[1], unconverged })
}

/// The nodes below share the lower side of 1 m²: κ |b'(gap/d̂)| · 1 m² = m g with κ of the shear modulus and the pressure under the weight;
/// by bisection.
fn root(young: f64) -> f64 {
    let stiffness = young / 2.6 + WEIGHT;
    let (mut lower, mut upper) = (1e-6, 1.0);
    for _ in 0..200 {
        let middle = 0.5 * (lower + upper);
        *(if -stiffness * slope(middle) > WEIGHT { &mut lower } else { &mut upper }) = middle;
    }
    lower * ACTIVATION
}

/// b'(s) of the barrier b(s) = −(s − 1)² ln s, Li et al. (2020).
fn slope(s: f64) -> f64 {
    -2.0 * (s - 1.0) * s.ln() - (s - 1.0).powi(2) / s
}

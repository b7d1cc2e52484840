//! Coulomb friction on an incline: a floor under a tilted gravity.

use fem_engine::simulator::Simulator;
use fem_model::Integrator;

use super::{has_barrier, momentum, travel};
use crate::scenes::{double, steps};

const G: f64 = 9.81;
/// Coefficient of friction.
pub const FRICTION: f64 = 0.4;
/// Velocity of the block that stops on a level floor, m/s.
pub const VELOCITY: f64 = 1.0;
/// Its distance to rest, m.
pub const STOPPING: f64 = VELOCITY * VELOCITY / (2.0 * FRICTION * G);
/// kg
const MASS: f64 = 1000.0;

/// A stiff square on an incline of tan θ = `factor` μ, that slides down with an initial velocity, m/s. Without damping explicit Euler is
/// unstable; it leaves rigid motions alone.
fn incline(method: Integrator, dt: f64, factor: f64, velocity: f64) -> Result<Simulator<f64>, String> {
    let angle = (factor * FRICTION).atan();
    let gap = if has_barrier(method) { 9e-4 } else { 0.0 };
    let text = format!(
        "pipeline = \"engine\"\n[mesh]\nrectangle = {{ size = [1, 1], cells_per_unit = 1 }}\n[material]\nmodel = \"corotated\"\nyoung = 1e7\n\
         poisson = 0.3\ndensity = {MASS}\n[time]\ndt = {dt:e}\nintegrator = \"{}\"\n\
         [gravity]\nacceleration = [{:e}, {:e}, 0]\n[[planes]]\npoint = [0, {:e}, 0]\nnormal = [0, 1, 0]\nfriction = {FRICTION}\n\
         [[initial_velocity]]\nvelocity = [{velocity:e}, 0, 0]\n[damping]\nbeta = 2e-3\n",
        method.name(),
        G * angle.sin(),
        -G * angle.cos(),
        -gap
    );
    double(&text, None)
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
pub fn creep(method: Integrator) -> Result<f64, String> {
    let dt = step_of(method);
    let mut simulation = incline(method, dt, 0.99, 0.0)?;
    steps(&mut simulation, (2.0 / dt) as usize)?;
    let before = travel(&simulation);
    steps(&mut simulation, (1.0 / dt) as usize)?;
    Ok(travel(&simulation) - before)
}

/// Acceleration at tan θ = `factor` μ > μ, found and by Coulomb's law, m/s².
pub fn acceleration(method: Integrator, factor: f64) -> Result<[f64; 2], String> {
    let dt = step_of(method);
    let mut simulation = incline(method, dt, factor, 0.2)?;
    steps(&mut simulation, (0.2 / dt) as usize)?;
    let before = momentum(&simulation);
    steps(&mut simulation, (1.0 / dt) as usize)?;
    let angle = (factor * FRICTION).atan();
    Ok([(momentum(&simulation) - before) / MASS, G * (angle.sin() - FRICTION * angle.cos())])
}

/// The way to rest from 1 m/s on a level floor, m.
pub fn way(method: Integrator, dt: f64) -> Result<f64, String> {
    let mut simulation = incline(method, dt, 0.0, VELOCITY)?;
    steps(&mut simulation, (0.4 / dt).round() as usize)?;
    let speed = momentum(&simulation) / MASS;
    // A decaying shear vibration is left.
    if speed.abs() < 0.02 {
        Ok(travel(&simulation))
    } else {
        Err(format!("{}: the block still slides at {speed} m/s", method.name()))
    }
}

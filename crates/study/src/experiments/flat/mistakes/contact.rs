//! Friction, and the order of projection and integration.

use fem_model::Integrator;
use fem_model::simulation::Diagnostics;

use crate::experiments::flat::contact::incline;
use crate::experiments::mistake::Mistake;
use crate::scenes::{double, step};

/// Frames in a second.
const FRAMES: f64 = 60.0;
const G: f64 = 9.81;

/// The way to rest on a level floor with 1, 10 and 40 substeps a frame.
pub fn friction(quick: bool) -> Result<Vec<Mistake>, String> {
    let counts: &[usize] = if quick { &[1, 10] } else { &[1, 10, 40] };
    let row = |&substeps: &usize| {
        let dt = 1.0 / FRAMES / substeps as f64;
        // The contact's part judges how the error falls with the step.
        let tolerance = (incline::VELOCITY * dt).max(0.01 * incline::STOPPING);
        Ok(Mistake {
            rule: "friction multiplies the tangential velocity in each substep",
            right: "Coulomb's law",
            quantity: format!("way to rest with {substeps} substeps a frame (m)"),
            theirs: multiplied(dt),
            ours: incline::way(Integrator::ImplicitEuler, dt)?,
            truth: incline::STOPPING,
            tolerance,
        })
    };
    counts.iter().map(row).collect()
}

/// The way of a sliding body whose velocity each substep multiplies by 1 − μ, m.
fn multiplied(dt: f64) -> f64 {
    let (mut x, mut v) = (0.0, incline::VELOCITY);
    while v > 1e-12 {
        v *= 1.0 - incline::FRICTION;
        x += v * dt;
    }
    x
}

/// Substeps of a frame in the fall.
const SUBSTEPS: f64 = 10.0;

/// The largest depth below a floor after a substep of a fall of 1 m.
pub fn projection() -> Result<Mistake, String> {
    let dt = 1.0 / FRAMES / SUBSTEPS;
    let text = format!(
        "pipeline = \"engine\"\n[mesh]\nrectangle = {{ size = [1, 1], cells_per_unit = 2, pattern = \"kuhn\" }}\n[material]\nmodel = \"corotated\"\nyoung = 112500\n\
         poisson = 0.25\ndensity = 140.5\n[gravity]\nacceleration = [0, -{G}, 0]\n[time]\nintegrator = \"semi_implicit_euler\"\ndt = {dt:e}\n\
         [damping]\nbeta = 1e-3\n[[planes]]\npoint = [0, -1, 0]\nnormal = [0, 1, 0]\n"
    );
    let mut simulation = double(&text, None)?;
    let mut depth = 0.0f64;
    for _ in 0..600 {
        step(&mut simulation)?;
        depth = depth.max(-simulation.contacts()[0].smallest_gap);
    }
    Ok(Mistake {
        rule: "positions projected before the integration",
        right: "no penetration after a step",
        quantity: "largest depth after a fall of 1 m with 10 substeps (m)".to_owned(),
        theirs: projected_first(dt),
        ours: depth,
        truth: 0.0,
        tolerance: 0.0,
    })
}

/// The largest depth of a point after a substep that begins with its projection, m.
fn projected_first(dt: f64) -> f64 {
    let (mut y, mut v, mut depth) = (1.0, 0.0, 0.0f64);
    for _ in 0..600 {
        if y < 0.0 {
            (y, v) = (0.0, 0.0);
        }
        v -= G * dt;
        y += v * dt;
        depth = depth.max(-y);
    }
    depth
}

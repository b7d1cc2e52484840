//! The order of Verlet's method.

use fem_model::simulation::Simulation;

use crate::experiments::mistake::Mistake;
use crate::scenes::{double, steps};

/// The observed order of Verlet's method on a vibrating strip, and on an oscillator.
pub fn verlet() -> Result<Mistake, String> {
    Ok(Mistake {
        rule: "Verlet called of fourth order",
        right: "of second order",
        quantity: "observed order".to_owned(),
        theirs: 4.0,
        ours: strip()?,
        truth: oscillator(),
        tolerance: 0.02,
    })
}

/// The order at which the end of a strip's vibration changes as the time step is halved.
fn strip() -> Result<f64, String> {
    let end = |dt: f64| {
        let text = format!(
            "pipeline = \"engine\"\n[mesh]\nrectangle = {{ size = [2, 1], cells_per_unit = 2, pattern = \"kuhn\" }}\n[material]\nmodel = \"corotated\"\nyoung = 112500\n\
             poisson = 0.25\ndensity = 140.5\n[time]\nintegrator = \"verlet\"\ndt = {dt:e}\n\
             [[initial_velocity]]\non = {{ axis = \"x\", side = \"max\", within = 1e-9 }}\nvelocity = [1, 0.2, 0]\n"
        );
        let mut simulation = double(&text, None)?;
        steps(&mut simulation, (0.05 / dt).round() as usize)?;
        Ok::<_, String>(simulation.positions())
    };
    let [coarse, middle, fine] = [end(1e-3)?, end(5e-4)?, end(2.5e-4)?];
    Ok(((&coarse - &middle).amax() / (&middle - &fine).amax()).log2())
}

/// The order of the error of x'' = −x at t = 1, by Störmer's formula.
fn oscillator() -> f64 {
    let error = |steps: i32| {
        let dt = 1.0 / f64::from(steps);
        // The exact second value, so that the error is that of the formula.
        let (mut before, mut x) = (1.0, dt.cos());
        for _ in 1..steps {
            (before, x) = (x, 2.0 * x - before - dt * dt * x);
        }
        (x - 1f64.cos()).abs()
    };
    (error(1000) / error(2000)).log2()
}

//! 5. A study of one's own: the order of convergence of four time integration methods.
//!
//! `cargo run --release --example 05_own_study`

use std::error::Error;
use std::path::Path;

use nalgebra::DVector;

/// Simulated time, s.
const END: f64 = 0.32;

/// Methods and their orders.
const METHODS: [(&str, f64); 4] =
    [("linearly_implicit_euler", 1.0), ("implicit_euler", 1.0), ("rk2", 2.0), ("verlet", 2.0)];

/// Positions of a soft clamped beam after `END`, m, by one method in this number of steps.
fn positions(method: &str, steps: usize) -> Result<DVector<f64>, Box<dyn Error>> {
    let text = format!(
        "pipeline = \"engine\"\n[mesh]\nbox = {{ size = [1, 0.5, 0.5], cells_per_unit = 4 }}\n\
         [material]\nmodel = \"stable_neo_hookean\"\nyoung = 1e4\npoisson = 0.3\ndensity = 1000\n\
         [gravity]\nacceleration = [0, 0, -1]\n[fixed]\nplane = {{ axis = \"x\", below = 1e-9 }}\n\
         [time]\nintegrator = \"{method}\"\ndt = {}\n",
        END / steps as f64
    );
    let scene = fem_scene::parse(&text, Path::new("beam.toml"))?;
    let body = fem_scene::body(&scene, Path::new("data"))?;
    let mut simulation = fem_engine::simulator::build(&scene, body)?;
    for _ in 0..steps {
        simulation.step()?;
    }
    Ok(simulation.positions())
}

/// The errors of one method.
pub struct Row {
    pub method: &'static str,
    pub expected_order: f64,
    /// Largest distance of a coordinate from the reference for 64, 128 and 256 steps, m.
    pub errors: [f64; 3],
}

impl Row {
    /// The order that the two smallest errors show.
    pub fn observed_order(&self) -> f64 {
        (self.errors[1] / self.errors[2]).log2()
    }
}

/// Compares every method with RK4 in 2048 steps, whose error is far smaller.
pub fn run() -> Result<Vec<Row>, Box<dyn Error>> {
    let reference = positions("rk4", 2048)?;
    let error = |method, steps| Ok::<_, Box<dyn Error>>((positions(method, steps)? - &reference).amax());
    let row = |(method, expected_order)| -> Result<Row, Box<dyn Error>> {
        let errors = [error(method, 64)?, error(method, 128)?, error(method, 256)?];
        Ok(Row { method, expected_order, errors })
    };
    METHODS.into_iter().map(row).collect()
}

#[allow(dead_code)] // the test calls `run`
fn main() -> Result<(), Box<dyn Error>> {
    println!("{:<24} {:>10} {:>10} {:>10} {:>8}", "method", "5 ms", "2.5 ms", "1.25 ms", "order");
    for row in run()? {
        let [a, b, c] = row.errors;
        println!("{:<24} {a:>10.2e} {b:>10.2e} {c:>10.2e} {:>8.3}", row.method, row.observed_order());
    }
    Ok(())
}

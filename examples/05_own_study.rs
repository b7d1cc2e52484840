//! 5. A study of one's own: the order of convergence of four time integration methods.
//!
//! `cargo run --release --example 05_own_study`

use std::error::Error;

use fem_mesh::{Pattern, box_mesh};
use fem_model::{Axis, Body, Elastic, Integrator, Law, Material, Method, Selector};
use nalgebra::DVector;

/// Simulated time, s.
const END: f64 = 0.32;

/// Methods and their orders.
const METHODS: [(Integrator, f64); 4] = [
    (Integrator::LinearlyImplicitEuler, 1.0),
    (Integrator::ImplicitEuler, 1.0),
    (Integrator::Rk2, 2.0),
    (Integrator::Verlet, 2.0),
];

/// Positions of a soft clamped beam after `END`, m, by one method in this number of steps.
fn positions(integrator: Integrator, steps: usize) -> Result<DVector<f64>, Box<dyn Error>> {
    let rubber = Material::new(Law::StableNeoHookean(Elastic::new(1e4, 0.3)), 1000.0);
    let body = Body::new(box_mesh([1.0, 0.5, 0.5], 4, Pattern::default())?, rubber)?;
    let body = body.gravity([0.0, 0.0, -1.0])?.fix(&Selector::least(Axis::X))?;
    let method = Method::new(integrator, END / steps as f64);
    let mut simulation = fem_engine::simulator::build(body, &method)?;
    for _ in 0..steps {
        simulation.step()?;
    }
    Ok(simulation.positions())
}

/// The errors of one method.
pub struct Row {
    pub method: Integrator,
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
    let reference = positions(Integrator::Rk4, 2048)?;
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
        println!("{:<24} {a:>10.2e} {b:>10.2e} {c:>10.2e} {:>8.3}", row.method.name(), row.observed_order());
    }
    Ok(())
}

//! Scenes solved on a graphics device end where they end on the processor. Each test is skipped, with one line, where there is no device.

#![allow(non_snake_case)] // E, G and J are the names that the mathematics uses

mod batch;
mod failures;
mod forces;
mod stiffness;

use std::path::{Path, PathBuf};

use fem_model::simulation::Simulation;
use fem_scene::{Override, body, load_with};
use nalgebra::DVector;

fn data() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../data")
}

/// Newton's method to its rounding error.
const NEWTON: &str = "newton.tolerance=1e-14";

/// A simulation of a scene with changed keys, or why there is none.
fn build(scene: &str, keys: &[&str]) -> Result<Box<dyn Simulation>, String> {
    let keys: Vec<Override> = keys.iter().map(|key| key.parse().unwrap()).collect();
    let scene = load_with(scene, &data(), &keys).unwrap_or_else(|error| panic!("{error}"));
    let body = body(&scene, &data()).unwrap_or_else(|error| panic!("{error}"));
    fem_engine::simulator::build(body, &scene.method()).map_err(|refusal| scene.refused(refusal).to_string())
}

/// The same on the device; `None`, after one line, without one.
fn on_device(scene: &str, keys: &[&str]) -> Option<Box<dyn Simulation>> {
    match build(scene, keys) {
        Ok(simulation) => Some(simulation),
        Err(error) if error.contains("no graphics adapter") || error.contains("double precision") => {
            println!("skipped: {error}");
            None
        }
        Err(error) => panic!("{scene}: {error}"),
    }
}

/// Positions after some steps, all of which have converged, and iterations of the linear solver.
fn run(mut simulation: Box<dyn Simulation>, steps: usize) -> (DVector<f64>, usize) {
    for _ in 0..steps {
        simulation.step().unwrap_or_else(|failure| panic!("{failure}"));
    }
    assert_eq!(simulation.counters().unconverged_steps, 0);
    (simulation.positions(), simulation.counters().solver_iterations)
}

/// Holds the end of a scene on the device to that on the processor, as a part of its largest displacement.
fn compare(scene: &str, keys: &[&str], steps: usize, precision: &str, bound: f64) {
    let solver = format!("solver={{kind=\"gpu\",precision=\"{precision}\",tolerance=1e-13}}");
    let keys = [&[NEWTON], keys].concat();
    let Some(simulation) = on_device(scene, &[&keys[..], &[&solver]].concat()) else { return };
    let start = simulation.positions();
    let (found, iterations) = run(simulation, steps);
    let (expected, _) = run(build(scene, &keys).unwrap(), steps);
    let error = (&found - &expected).amax() / (&expected - &start).amax();
    println!("{scene}, {precision}: {error:e} of the displacement, {iterations} iterations in {steps} steps");
    assert!(iterations > 0, "{scene}: nothing was solved on the device");
    assert!(error < bound, "{scene}, {precision}: {error:e}");
}

#[test]
fn an_armadillo_ends_where_it_ends_on_the_processor() {
    compare("arma-engine", &[], 10, "f32", 1e-10);
    compare("arma-engine", &[], 10, "f64", 1e-12);
}

#[test]
fn a_beam_ends_where_it_ends_on_the_processor() {
    compare("beam", &["mesh.box.cells_per_unit=6"], 5, "f32", 1e-10);
    compare("beam", &["mesh.box.cells_per_unit=6"], 5, "f64", 1e-12);
}

#[test]
fn a_scene_that_does_not_name_the_device_has_no_part_on_it() {
    let simulation = build("arma-engine", &[]).unwrap();
    assert!(simulation.parts().iter().all(|part| !part.why.contains("graphics device")));
    let Some(simulation) = on_device("arma-engine", &["solver={kind=\"gpu\"}"]) else { return };
    let parts = simulation.parts();
    assert!(
        parts.iter().any(|part| part.why.contains("graphics device")),
        "{:?}",
        parts.iter().map(|part| &part.why).collect::<Vec<_>>()
    );
}

#[test]
fn a_static_cantilever_ends_where_it_ends_on_the_processor() {
    compare("cantilever", &[], 1, "f32", 1e-10);
    // The residual of 1e-13 times the condition number.
    compare("cantilever", &[], 1, "f64", 1e-10);
}

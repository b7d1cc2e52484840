//! Batches of many small bodies, of which the device takes whole steps.

use std::time::Instant;

use fem_engine::batch::Batch;
use fem_scene::Scene;

use super::{GPU, check_agreement};
use crate::cli::{RunArguments, SizesArguments};
use crate::end::End;
use crate::race::{Contestant, Time, race};

/// Numbers of environments of `arma-batch`.
const COUNTS: [usize; 3] = [64, 512, 2048];

/// An explicit method, and one with sweeps over colours, with their changes of the scene.
const METHODS: [(&str, &[&str]); 2] = [
    ("`semi_implicit_euler`", &[]),
    (
        "`vbd`, 10 sweeps",
        &["time.integrator=vbd", "time.dt=5e-3", "iterations={count = 10, accept_unconverged = true}"],
    ),
];

/// Largest distance between the two ends of an environment, as a part of the body's largest coordinate: the device computes in single
/// precision.
const AGREEMENT: f64 = 1e-4;

/// Times batches on all threads of the processor and on the device, and prints a table.
pub fn run(arguments: &SizesArguments) -> Result<(), End> {
    println!(
        "| arma-batch by | environments | all threads, environment-steps per second | device, environment-steps per second | device over all threads |"
    );
    println!("|---|---:|---:|---:|---:|");
    for (name, method) in METHODS {
        for count in COUNTS {
            let [here, there] = [scene(arguments, method, count, &[])?, scene(arguments, method, count, &[GPU])?];
            check_ends(&here, &there, arguments)?;
            let contestants: [Contestant; 2] = [&here, &there].map(|scene| timed(scene, arguments));
            let [threads, device] = race(arguments.rounds, &contestants)?[..] else { unreachable!("two contestants") };
            let speeds = [threads, device].map(|time| count as f64 / time.wall);
            println!("| {name} | {count} | {:.0} | {:.0} | {:.2} |", speeds[0], speeds[1], speeds[1] / speeds[0]);
        }
    }
    Ok(())
}

fn scene(arguments: &SizesArguments, method: &[&str], count: usize, solver: &[&str]) -> Result<Scene, End> {
    let count = format!("batch.count={count}");
    let changes = method.iter().chain(solver).copied().chain([&*count]);
    let overrides = changes.map(str::parse).collect::<Result<_, _>>();
    let run = RunArguments {
        scene: "arma-batch".to_owned(),
        steps: Some(arguments.steps),
        cells: None,
        solver: None,
        overrides: overrides.map_err(End::unusable)?,
        data: arguments.data.clone(),
    };
    run.scene().map_err(End::unusable)
}

fn built(scene: &Scene, arguments: &SizesArguments) -> Result<Batch, End> {
    let body = fem_scene::body(scene, &arguments.data).map_err(End::unusable)?;
    Batch::new(body, &scene.method(), scene.environment_values()).map_err(End::unusable)
}

/// Takes the steps, and waits for them: whether an environment has failed is known after the last one.
fn advance(batch: &mut Batch, arguments: &SizesArguments) -> Result<(), End> {
    batch.advance(arguments.steps).map_err(End::wrong)?;
    match batch.failures().map_err(End::wrong)? {
        [] => Ok(()),
        [first, ..] => Err(End::wrong(format!("environment {} failed: {}", first.environment, first.failure))),
    }
}

/// The steps of a batch without its set-up, and without the first one, in which a device compiles.
fn timed<'a>(scene: &'a Scene, arguments: &'a SizesArguments) -> Contestant<'a> {
    Box::new(move || {
        let mut batch = built(scene, arguments)?;
        batch.advance(1).map_err(End::wrong)?;
        batch.failures().map_err(End::wrong)?;
        let start = Instant::now();
        advance(&mut batch, arguments)?;
        let wall = start.elapsed().as_secs_f64() / arguments.steps as f64;
        Ok(Time { wall, cpu: f64::NAN })
    })
}

/// Compares the ends of the first and the last environment.
fn check_ends(here: &Scene, there: &Scene, arguments: &SizesArguments) -> Result<(), End> {
    let [mut here, mut there] = [built(here, arguments)?, built(there, arguments)?];
    for batch in [&mut here, &mut there] {
        advance(batch, arguments)?;
    }
    for environment in [0, here.count() - 1] {
        let states = [&mut here, &mut there].map(|batch| batch.state(environment));
        let [here, there] = states.map(|state| state.map(|state| state.positions.into_flattened()));
        let (here, there) = (here.map_err(End::wrong)?, there.map_err(End::wrong)?);
        check_agreement(&format!("arma-batch, environment {environment}"), &here, &there, AGREEMENT)?;
    }
    Ok(())
}

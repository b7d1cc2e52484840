//! Runs a scene, in a window if one can be opened.

use std::path::Path;

use fem_model::simulation::Simulation;
use fem_output::ElementField;
use fem_scene::Scene;

use crate::build::{Ready, build};
use crate::cli::RunArguments;
use crate::course::Course;
use crate::end::End;
use crate::{batch, explain, headless, results, window};

/// Runs the scene with the options.
pub fn run(course: &Course, arguments: &RunArguments) -> Result<(), End> {
    results::check(arguments)?;
    let scene = scene_with_overrides(course, arguments)?;
    if arguments.explain {
        return explain::print(course, &scene);
    }
    if scene.batch.is_some() {
        return batch::run(course, &scene, arguments);
    }
    let mut ready = build(course, &scene)?;
    check_color(arguments.color, &*ready.simulation)?;
    if let Some(file) = &arguments.resume {
        resume(file, &scene, &mut ready)?;
    }
    let has_no_window = arguments.vtu_series.is_some() || arguments.checkpoint.is_some() || !arguments.probe.is_empty();
    if arguments.headless || has_no_window {
        return headless::run(ready, &scene, arguments);
    }
    match window::available() {
        Ok(()) => window::run(course, ready, &scene, arguments),
        Err(reason) => {
            eprintln!("no window ({reason}); running without one, as --headless does");
            headless::run(ready, &scene, arguments)
        }
    }
}

/// Refuses the colours of a field that the body does not have.
fn check_color(color: Option<ElementField>, simulation: &dyn Simulation) -> Result<(), End> {
    let fields = ElementField::of(simulation);
    let Some(missing) = color.filter(|field| !fields.contains(field)) else { return Ok(()) };
    let others = fields.iter().map(|field| field.name()).collect::<Vec<_>>().join(" or ");
    let remedy = match missing {
        ElementField::Stress | ElementField::Pressure => "a law as material.model",
        ElementField::StressError => "a law as material.model and pipeline = \"engine\"",
        ElementField::PlasticStrain | ElementField::Displacement | ElementField::Quality => "a table [plasticity]",
    };
    Err(End::unusable(format!(
        "--color {missing}: the body has no {}; give the scene {remedy}, or the option {others}",
        missing.label()
    )))
}

/// Continues from a state file; the steps that it has done count.
fn resume(file: &Path, scene: &Scene, ready: &mut Ready) -> Result<(), End> {
    fem_scene::resume(file, scene, &mut *ready.simulation)
        .map_err(|error| End::unusable(format!("--resume {error}")))?;
    let (done, all) = (ready.simulation.steps(), ready.steps);
    if done >= all {
        let problem = format!("is a state after step {done}, and the run ends after step {all}; give more by --steps");
        return Err(End::unusable(format!("--resume {}: {problem}", file.display())));
    }
    ready.steps -= done;
    Ok(())
}

fn scene_with_overrides(course: &Course, arguments: &RunArguments) -> Result<Scene, End> {
    let mut scene = fem_scene::load_with(&arguments.scene, &course.data(), &arguments.set).map_err(End::unusable)?;
    scene.time.dt = arguments.dt.or(scene.time.dt);
    if let Some(integrator) = arguments.integrator {
        scene.time.integrator = integrator;
        for table in scene.remove_unused_tables() {
            eprintln!("note: [{table}] of the scene has no effect with {}", integrator.name());
        }
    }
    scene.time.steps = arguments.steps.or(scene.time.steps);
    scene.check().map_err(End::unusable)?;
    Ok(scene)
}

//! Runs a scene, in a window if one can be opened.

use fem_scene::Scene;

use super::build::build;
use super::cli::RunArguments;
use super::end::End;
use super::{data, explain, headless, results, window};

/// Runs the scene with the options.
pub fn run(arguments: &RunArguments) -> Result<(), End> {
    results::check(arguments)?;
    let scene = scene_with_overrides(arguments)?;
    let ready = build(&scene)?;
    if arguments.explain {
        explain::print(&scene, &*ready.simulation);
        return Ok(());
    }
    if arguments.headless || arguments.vtu_series.is_some() {
        return headless::run(ready, arguments);
    }
    match window::available() {
        Ok(()) => window::run(ready, arguments),
        Err(reason) => {
            eprintln!("no window ({reason}); running without one, as --headless does");
            headless::run(ready, arguments)
        }
    }
}

fn scene_with_overrides(arguments: &RunArguments) -> Result<Scene, End> {
    let mut scene = fem_scene::load_with(&arguments.scene, &data::folder(), &arguments.set).map_err(End::unusable)?;
    scene.time.dt = arguments.dt.or(scene.time.dt);
    scene.time.integrator = arguments.integrator.unwrap_or(scene.time.integrator);
    scene.time.steps = arguments.steps.or(scene.time.steps);
    scene.check().map_err(End::unusable)?;
    Ok(scene)
}

//! A run in a window.

use fem_scene::Scene;

use crate::build::Ready;
use crate::cli::RunArguments;
use crate::course::Course;
use crate::end::End;

/// Checks whether a window can be opened; the error is the reason why not.
#[cfg(feature = "viewer")]
pub fn available() -> Result<(), String> {
    fem_viewer::display_available()
}

/// Without the viewer no window can be opened.
#[cfg(not(feature = "viewer"))]
pub fn available() -> Result<(), String> {
    Err("built without the feature `viewer`".to_owned())
}

/// Shows the simulation until the window is closed, then writes the files that the options name.
#[cfg(feature = "viewer")]
pub fn run(course: &Course, ready: Ready, scene: &Scene, arguments: &RunArguments) -> Result<(), End> {
    use fem_output::Run;
    use fem_viewer::{Stop, WindowError, WindowOptions};

    use crate::headless;
    use crate::results::{Finished, finish};
    use crate::signals::Signals;

    let Ready { simulation, seconds_setup, steps, up, expected_tip } = ready;
    let signals = Signals::catch()?;
    let options = WindowOptions {
        up,
        color: arguments.color,
        screenshot: arguments.screenshot.clone(),
        record: arguments.record.clone(),
        quit_after_steps: arguments.steps.map(|_| steps),
        log_energies: arguments.energies.is_some(),
        editing: editing(course, scene),
        close: signals.number(),
        ..WindowOptions::default()
    };
    let outcome = match fem_viewer::open(simulation, options) {
        Ok(outcome) => outcome,
        Err(WindowError::NoWindow(no_window)) => {
            eprintln!("no window ({}); running without one, as --headless does", no_window.reason);
            return headless::run(
                Ready { simulation: no_window.simulation, seconds_setup, steps, up, expected_tip },
                scene,
                arguments,
            );
        }
        Err(error) => return Err(End::unusable(error)),
    };
    if let Some(error) = outcome.not_written {
        return Err(End::unusable(error));
    }
    let failure = match outcome.stop {
        Some(Stop::Failed(failure)) => Some(failure),
        Some(other) => return Err(End::Stopped(other.to_string())),
        None => None,
    };
    let Some(simulation) = outcome.simulation else { return Err(End::Stopped("the simulation panicked".to_owned())) };
    let signal = signals.received();
    let run = Run { step_seconds: outcome.step_seconds, failure, interrupted: signal.is_some() };
    let finished = Finished {
        simulation: &*simulation,
        scene: outcome.scene.as_ref().unwrap_or(scene),
        signal,
        run,
        seconds_setup,
        energies: outcome.energies,
        frames: Vec::new(),
        expected_tip,
    };
    finish(&finished, arguments)
}

/// The scene for a panel that changes it. The course's pipeline has its own parameters.
#[cfg(feature = "viewer")]
fn editing(course: &Course, scene: &Scene) -> Option<fem_viewer::Editing> {
    use fem_viewer::Editing;

    if scene.pipeline == fem_scene::Pipeline::Course {
        return None;
    }
    let data = course.data();
    let folder = data.clone();
    let builder = std::sync::Arc::new(move |scene: &Scene, shape: Option<&fem_model::simulation::Shape>| {
        crate::build::rebuild(scene, shape, &folder)
    });
    Some(Editing { scene: scene.clone(), objects: pictures(&data), data, builder })
}

/// The pictures that bodies can be made from, sorted by name.
#[cfg(feature = "viewer")]
fn pictures(data: &std::path::Path) -> Vec<std::path::PathBuf> {
    let entries = std::fs::read_dir(data.join("pictures")).into_iter().flatten().flatten();
    let mut pictures: Vec<_> = entries.map(|entry| entry.path()).collect();
    pictures.retain(|path| path.extension().is_some_and(|extension| extension == "png"));
    pictures.sort();
    pictures
}

/// Never called, because no window is available.
#[cfg(not(feature = "viewer"))]
pub fn run(_: &Course, ready: Ready, scene: &Scene, arguments: &RunArguments) -> Result<(), End> {
    crate::headless::run(ready, scene, arguments)
}

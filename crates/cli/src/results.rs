//! Output files and the summary of a run.

use std::path::Path;

use fem_mesh::write::Frame;
use fem_model::simulation::{Failure, PlaneContact, Reaction, Simulation};
use fem_model::{IterationSettings, Method};
use fem_output::{EXPORTS, EnergyRow, Run, Stats, quantile};
use fem_scene::{Pipeline, Scene};
use nalgebra::Vector3;

use crate::cli::RunArguments;
use crate::end::End;
use crate::engine;

/// A run that has ended, with or without a failure.
pub struct Finished<'a> {
    pub simulation: &'a dyn Simulation,
    pub scene: &'a Scene,
    pub run: Run,
    /// Exit code of the signal that has ended the run, if one has.
    pub signal: Option<u8>,
    pub seconds_setup: f64,
    pub energies: Vec<EnergyRow>,
    pub frames: Vec<Frame>,
    /// Timoshenko's displacement of the tip, m, if the scene is a cantilever.
    pub expected_tip: Option<Vector3<f64>>,
}

/// Returns an error for output files that could not be written, before the first step.
pub fn check(arguments: &RunArguments) -> Result<(), End> {
    let files = output_files(arguments);
    for (i, (option, file)) in files.iter().enumerate() {
        check_file(option, file)?;
        if let Some((earlier, _)) = files[..i].iter().find(|(_, other)| other == file) {
            let problem = format!("{earlier} and {option} name the same file {}; give each its own", file.display());
            return Err(End::unusable(problem));
        }
    }
    if let Some(file) = arguments.vtu_series.as_ref().filter(|folder| folder.exists() && !folder.is_dir()) {
        return Err(End::unusable(format!("--vtu-series {}: is a file; give the name of a folder", file.display())));
    }
    match &arguments.export {
        Some(path) if !EXPORTS.iter().any(|known| path.extension().is_some_and(|found| found == *known)) => {
            let extension = path.extension().unwrap_or_default().to_string_lossy();
            Err(End::unusable(format!("--export {}", fem_output::unknown_export(path, &extension))))
        }
        _ => Ok(()),
    }
}

/// The options that name a file to write, with the files.
fn output_files(arguments: &RunArguments) -> Vec<(&'static str, &Path)> {
    let files = [
        ("--state", &arguments.state),
        ("--checkpoint", &arguments.checkpoint),
        ("--stats", &arguments.stats),
        ("--energies", &arguments.energies),
        ("--export", &arguments.export),
        ("--screenshot", &arguments.screenshot),
    ];
    let named = files.into_iter().filter_map(|(option, file)| Some((option, file.as_deref()?)));
    named.chain(arguments.probe.iter().map(|probe| ("--probe", probe.file.as_path()))).collect()
}

fn check_file(option: &str, file: &Path) -> Result<(), End> {
    let folder = file.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    if file.is_dir() || file.file_name().is_none() {
        return Err(End::unusable(format!("{option} {}: is a folder; give the name of a file", file.display())));
    }
    if !folder.is_dir() {
        return Err(End::unusable(format!("{option} {}: its folder does not exist; make it first", file.display())));
    }
    Ok(())
}

/// Writes the files that the options name and prints the summary.
pub fn finish(finished: &Finished, arguments: &RunArguments) -> Result<(), End> {
    let Finished { simulation, scene, run, seconds_setup, energies, frames, expected_tip, .. } = finished;
    let end = end(finished, arguments);
    if let Some(path) = &arguments.state {
        fem_scene::write_state(path, scene, *simulation).map_err(End::unusable)?;
    }
    if let Some(path) = &arguments.energies {
        fem_output::write_energies(path, energies).map_err(End::unusable)?;
    }
    if let Some(path) = &arguments.export {
        fem_output::export(path, *simulation, frames).map_err(End::unusable)?;
    }
    if let Some(path) = &arguments.stats {
        let mut stats = Stats::of(*simulation, run, *seconds_setup);
        if let Err(end @ (End::Stopped(_) | End::Failed(_))) = &end {
            stats.status = format!("failed: {}", end.message());
        }
        stats.write(path).map_err(End::unusable)?;
    }
    print_summary(*simulation, run);
    let (unconverged_steps, steps) = (simulation.counters().unconverged_steps, simulation.steps());
    if scene.pipeline == Pipeline::Course && unconverged_steps > 0 {
        println!(
            "{unconverged_steps} of {steps} steps ended before Newton's method had converged: the stiffness leaves out the spring of the drag; \
             drag.in_stiffness = true puts it in"
        );
    }
    // The theory is that of all loads.
    if let Some(expected) = expected_tip.filter(|_| run.failure.is_none()) {
        engine::print_tip(*simulation, &expected);
    }
    warn(*simulation);
    warn_of_loads(*simulation, run.failure.is_some());
    end
}

/// The failure of the run, a signal, steps that have not converged unless the scene accepts those, or what the last steps have done that no check has seen yet.
fn end(finished: &Finished, arguments: &RunArguments) -> Result<(), End> {
    let Finished { simulation, scene, run, signal, .. } = finished;
    let failed = |failure: Failure| End::Failed(failure.with_critical_time_step(simulation.critical_time_step()));
    if let Some(failure) = run.failure.clone() {
        return Err(failed(failure));
    }
    if let Some(code) = signal {
        return Err(End::Interrupted { code: *code, message: how_to_go_on(*simulation, arguments) });
    }
    unconverged(*simulation, scene).map_or(Ok(()), |message| Err(End::Stopped(message)))?;
    simulation.failure_at_end().map_or(Ok(()), |failure| Err(failed(failure)))
}

/// The error of steps that have not converged; `None` without any, and if the scene accepts them.
fn unconverged(simulation: &dyn Simulation, scene: &Scene) -> Option<String> {
    let (unconverged_steps, steps) = (simulation.counters().unconverged_steps, simulation.steps());
    let method = scene.method();
    // The course takes five Newton iterations, converged or not.
    let is_accepted = method.accepts_unconverged() || scene.pipeline == Pipeline::Course;
    if unconverged_steps == 0 || is_accepted {
        return None;
    }
    Some(match method.integrator.is_iterated() {
        true => not_settled(&method, unconverged_steps, steps),
        false => format!(
            "{unconverged_steps} of {steps} steps ended before Newton's method had converged, so the result is not to be trusted; \
             use a shorter time step or more load steps, a larger newton.max_iterations, or newton.accept_unconverged = true"
        ),
    })
}

/// Warning about a run in which the iterations of some steps have not converged.
fn not_settled(method: &Method, unconverged_steps: usize, steps: usize) -> String {
    let IterationSettings { count, tolerance, .. } = method.iterations;
    let how = match tolerance {
        Some(tolerance) => format!("before the iterations had reached iterations.tolerance = {tolerance}"),
        None => "far from the solution: the body has gained more than 5 % of the energy that it was supplied with"
            .to_owned(),
    };
    format!(
        "{unconverged_steps} of {steps} steps ended {how}, so the result is not to be trusted; use more than {count} \
         iterations.count, a shorter time step, implicit_euler, or iterations.accept_unconverged = true"
    )
}

/// Warns of a misleading result: inverted elements, and what the simulation itself says.
fn warn(simulation: &dyn Simulation) {
    let (name, inverted) = (simulation.name(), simulation.inverted_elements());
    if inverted > 0 {
        let (least, element) = simulation.min_J();
        eprintln!(
            "warning: {name}: {inverted} elements are inverted (det F ≤ 0), element {element} most of all (det F = {least:.3e}); use \
             smaller loads, a finer mesh, or a law that does not allow inversion"
        );
    }
    for warning in simulation.warnings() {
        eprintln!("warning: {name}: {warning}");
    }
    let fallbacks = simulation.counters().solver_fallbacks;
    if fallbacks > 0 {
        eprintln!(
            "note: {name}: the iterative solver broke down, and a Cholesky factorisation took over ({fallbacks} matrices); \
             solver.kind = \"cholesky\" starts with it"
        );
    }
}

/// Warns of loads that are not fully applied; after a failure they are those of the last state that was reached.
fn warn_of_loads(simulation: &dyn Simulation, has_failed: bool) {
    let Some(factor) = simulation.load_factor().filter(|factor| *factor < 1.0) else { return };
    let (name, percent) = (simulation.name(), (1e6 * factor).round() / 1e4);
    let more = match has_failed {
        true => " in the last state that was reached",
        false => "; make as many steps as static.load_steps, or leave --steps and time.steps out",
    };
    eprintln!("warning: {name}: {percent} % of the loads and prescribed motions are on{more}");
}

/// The step that an interrupted run has reached, and how to go on from there.
fn how_to_go_on(simulation: &dyn Simulation, arguments: &RunArguments) -> String {
    let remedy = match arguments.state.as_ref().or(arguments.checkpoint.as_ref()) {
        Some(file) => format!("go on with --resume {}", file.display()),
        None => "with --state FILE.json the run could be resumed from here".to_owned(),
    };
    format!("the run ended after step {} (t = {:.6} s); {remedy}", simulation.steps(), simulation.time())
}

fn print_summary(simulation: &dyn Simulation, run: &Run) {
    let (energies, (minimum, _)) = (simulation.energies(), simulation.min_J());
    let median = quantile(&run.step_seconds, 0.5)
        .map_or(String::new(), |seconds| format!(", {:.3} ms a step (median)", 1e3 * seconds));
    let (name, integrator, steps) = (simulation.name(), simulation.integrator(), simulation.steps());
    // The time of an equilibrium has no meaning.
    let end = match integrator {
        "static" => "load steps".to_owned(),
        _ => format!("steps to t = {:.4} s", simulation.time()),
    };
    say!("{name}, {integrator}: {steps} {end}{median}");
    say!(
        "kinetic {:.4e} J, potential {:.4e} J, total {:.4e} J, minimum of det F {minimum:.4}",
        energies.kinetic,
        energies.potential,
        energies.total(),
    );
    for Reaction { name, force: [x, y, z] } in simulation.reactions() {
        say!("reaction force of {name}: ({x:.4e}, {y:.4e}, {z:.4e}) N");
    }
    for PlaneContact { name, force: [x, y, z], smallest_gap } in simulation.contacts() {
        say!("force of {name}: ({x:.4e}, {y:.4e}, {z:.4e}) N, smallest gap {smallest_gap:.3e} m");
    }
}

//! `--explain`: the parts that a scene builds and those that it leaves out.

use fem_model::simulation::{Part, Simulation, least_stable_substeps};
use fem_model::{Body, Integrator, SolverKind};
use fem_scene::tables::BatchTable;
use fem_scene::{Pipeline, Scene};

use crate::build;
use crate::course::Course;
use crate::end::End;
use crate::engine;

/// Largest number of nodes for which the critical time step is computed: it needs the whole body.
pub const MOST_NODES: usize = 50_000;

/// Prints a line for every part.
pub fn print(course: &Course, scene: &Scene) -> Result<(), End> {
    let (parts, lines) = match scene.pipeline {
        Pipeline::Course => (parts(course, scene)?, Vec::new()),
        Pipeline::Engine => {
            let body = build::body(course, scene)?;
            let parts = engine::planned_parts(scene, &body)?;
            let moduli = engine::line_of_moduli(&body)?;
            let has_limit = scene.time.integrator.is_explicit() || is_conditional_newmark(scene);
            let stability = has_limit.then(|| stability(scene, &body)).transpose()?;
            (parts, [stability, moduli].into_iter().flatten().collect())
        }
    };
    say!("{}: {}", scene.name, scene.about);
    let pipeline = match scene.pipeline {
        Pipeline::Course => "course",
        Pipeline::Engine => "engine",
    };
    let step = match scene.time.integrator {
        Integrator::Static => format!("load steps: {}", scene.method().load_steps),
        _ if scene.time.adaptive.is_some() => {
            format!("dt = {} s in parts by their estimated error", scene.time.dt())
        }
        _ => match scene.method().substeps {
            1 => format!("dt = {} s", scene.time.dt()),
            substeps => format!("dt = {} s in {substeps} substeps", scene.time.dt()),
        },
    };
    say!("pipeline {pipeline}, {}, {step}", scene.time.integrator.name());
    if let Some(batch) = &scene.batch {
        say!("{}", of_batch(scene, batch));
    }
    for line in lines {
        say!("{line}");
    }
    for part in parts {
        let word = if part.built { "builds" } else { "leaves out" };
        say!("  {word:<10} {:<14} {}", part.name, part.why);
    }
    Ok(())
}

/// Returns true if Newmark's method has a critical time step with these parameters.
fn is_conditional_newmark(scene: &Scene) -> bool {
    scene.time.integrator == Integrator::Newmark && !scene.method().newmark.is_unconditionally_stable()
}

/// The environments of a batch, each of which has the parts.
fn of_batch(scene: &Scene, batch: &BatchTable) -> String {
    let (first, last) = (batch.values(0), batch.values(batch.count - 1));
    let ranges = first.varied().zip(last.varied());
    let ranges: String = ranges.map(|((key, from), (_, to))| format!(", {key} from {from} to {to}")).collect();
    let is_on_device = scene.solver.as_ref().is_some_and(|solver| solver.kind == SolverKind::Gpu);
    let place = if is_on_device { "the graphics device" } else { "the processor" };
    format!("batch: {} environments on {place}{ranges}", batch.count)
}

/// The parts of a scene. Those of the engine are known before anything is built.
pub fn parts(course: &Course, scene: &Scene) -> Result<Vec<Part>, End> {
    match scene.pipeline {
        Pipeline::Course => Ok(build::build(course, scene)?.simulation.parts()),
        Pipeline::Engine => engine::planned_parts(scene, &build::body(course, scene)?),
    }
}

/// The critical time step of a method that has one beside the one in use, s.
fn stability(scene: &Scene, body: &Body) -> Result<String, End> {
    if body.shape.mesh.vertices().len() > MOST_NODES {
        return Ok(format!("critical time step: not computed for more than {MOST_NODES} nodes"));
    }
    let simulation = least_stable(scene, body)?;
    Ok(match simulation.critical_time_step() {
        None => "critical time step: none, as the body has no stiffness".to_owned(),
        Some(0.0) => "critical time step: none, as the method is unstable at any time step without damping".to_owned(),
        Some(critical) => verdict(critical, &*simulation),
    })
}

/// The simulation of a scene; of a batch, that of its first or last environment, whose critical time step is shorter.
pub fn least_stable(scene: &Scene, body: &Body) -> Result<Box<dyn Simulation>, End> {
    let environment = |number: usize| {
        let environment = scene.environment(number);
        let body = Body { material: environment.material.value(), ..body.clone() };
        engine::build(&environment, body)
    };
    let mut simulation = environment(0)?;
    if scene.environments() > 1 {
        let last = environment(scene.environments() - 1)?;
        let is_shorter = last.critical_time_step() < simulation.critical_time_step();
        simulation = if is_shorter { last } else { simulation };
    }
    Ok(simulation)
}

/// Says whether a step is shorter than the critical one, s, and names the remedy.
pub fn verdict(critical: f64, simulation: &dyn Simulation) -> String {
    let substeps = simulation.substeps();
    let (dt, step) = (simulation.dt() / substeps as f64, if substeps == 1 { "dt" } else { "a substep" });
    let verdict =
        if dt < critical { "shorter: stable for small vibrations" } else { "too long: motions grow without bound" };
    let least = least_stable_substeps(simulation.dt(), critical);
    let remedy = if least > substeps { format!("; time.substeps = {least} is stable") } else { String::new() };
    format!("critical time step: about {critical:.3e} s; {step} is {verdict}{remedy}")
}

/// Names of the parts that are built, for the list of scenes.
pub fn built(parts: &[Part]) -> String {
    let names: Vec<_> = parts.iter().filter(|part| part.built).map(|part| part.name).collect();
    names.join(", ")
}

//! `--explain`: the parts that a scene builds and those that it leaves out.

use fem_scene::simulation::{Part, Simulation};
use fem_scene::{Integrator, Pipeline, Scene};

/// Prints a line for every part.
pub fn print(scene: &Scene, simulation: &dyn Simulation) {
    say!("{}: {}", scene.name, scene.about);
    let pipeline = match scene.pipeline {
        Pipeline::Course => "course",
        Pipeline::Engine => "engine",
    };
    let step = match scene.time.integrator {
        Integrator::Static => format!("load steps: {}", scene.method().load_steps),
        _ => format!("dt = {} s", simulation.dt()),
    };
    say!("pipeline {pipeline}, {}, {step}", simulation.integrator());
    if let Some(critical) = simulation.critical_time_step() {
        say!("{}", stability(critical, simulation.dt()));
    }
    for part in simulation.parts() {
        let word = if part.built { "builds" } else { "leaves out" };
        let size =
            if part.built && part.bytes > 0 { format!(" ({} KiB)", part.bytes.div_ceil(1024)) } else { String::new() };
        say!("  {word:<10} {:<14} {}{size}", part.name, part.why);
    }
}

/// The critical time step of an explicit method beside the one in use, s.
fn stability(critical: f64, dt: f64) -> String {
    if critical == 0.0 {
        return "critical time step: none, as the method is unstable at any time step without damping".to_owned();
    }
    let verdict =
        if dt < critical { "shorter: stable for small vibrations" } else { "too long: motions grow without bound" };
    format!("critical time step: about {critical:.3e} s; dt is {verdict}")
}

/// Names of the parts that are built, for the list of scenes.
pub fn built(parts: &[Part]) -> String {
    let names: Vec<_> = parts.iter().filter(|part| part.built).map(|part| part.name).collect();
    names.join(", ")
}

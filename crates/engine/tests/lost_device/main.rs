//! A device that is lost in the middle of a run: a program of its own, since all simulations of a process share the device.

use fem_engine::solvers::open_device;
use fem_model::simulation::{Breakdown, Cause};
use fem_scene::{body, parse};

const SCENE: &str = r#"pipeline = "engine"
mesh.box = { size = [2, 1, 1], cells_per_unit = 2 }
material = { model = "MODEL", young = 2e5, poisson = 0.3, density = 1000 }
gravity.acceleration = [0, 0, -9.81]
fixed.plane = { axis = "x", below = 1e-9 }
time = { dt = 0.01, integrator = "implicit_euler" }
solver.kind = "gpu"
"#;

/// Runs two laws: the device assembles the matrices of the first law, and the processor those of the second.
#[test]
fn a_run_whose_device_is_lost_ends_with_its_last_state_and_says_so() {
    let device = match open_device() {
        Ok(device) => device,
        Err(error) => return println!("skipped: {error}"),
    };
    let start = |model: &str| {
        let scene = parse(&SCENE.replace("MODEL", model), "lost.toml".as_ref()).unwrap();
        let body = body(&scene, "no data".as_ref()).unwrap();
        let mut simulation = fem_engine::simulator::build(body, &scene.method()).unwrap();
        simulation.step().unwrap();
        simulation
    };
    let runs = ["neo_hookean", "hencky"].map(start);
    device.lose();
    for mut run in runs {
        let last = run.positions();
        let failure = run.step().unwrap_err();
        assert_eq!(failure.cause, Cause::Solver(Breakdown::DeviceFailed), "{failure}");
        assert!(failure.to_string().ends_with("out of memory; use solver.kind = \"pcg\""), "{failure}");
        assert_eq!(run.positions(), last);
    }
}

//! Prescribed motions under explicit methods: they are followed along their arc, so that methods keep their order, and their work is
//! the energy that the body gains.

use std::path::Path;

use fem_engine::forces::Moment;
use fem_engine::integrators::{ExplicitEuler, Integrator, Rk2, Rk4, SemiImplicitEuler, Verlet};
use fem_engine::materials::AnyLaw;
use fem_engine::model::state::State;
use fem_engine::model::system::System;
use fem_engine::solvers::SolverChoice;
use fem_model::simulation::Counters;
use nalgebra::DVector;

use crate::{build, distance, run, scene, soft};

/// One end of the box is fixed, and the other turns and moves to and fro. A consistent mass couples this motion to the other nodes; a
/// lumped mass does not.
const SWUNG: &str = r#"[fixed]
plane = { axis = "x", below = 1e-9 }
[[prescribed]]
on = { axis = "x", side = "max", within = 1e-9 }
rotation = { axis = "x", center = [0, 0.5, 0.5], turns = 0.2 }
displacement = [0.1, 0, 0.2]
curve = { sine = { frequency = 2.5 } }
"#;

/// The other end turns at constant speed, from the first step on.
const TURNED: &str = r#"[fixed]
plane = { axis = "x", below = 1e-9 }
[[prescribed]]
on = { axis = "x", side = "max", within = 1e-9 }
rotation = { axis = "x", center = [0, 0.5, 0.5], turns = 0.4 }
over = 0.4
"#;

const LUMPED: &str = "[mass]\nlumped = true\n";
const DAMPED: &str = "[damping]\nalpha = 2.0\nbeta = 0.004\n";

/// Positions and velocities after so many steps of 0.2 s in all.
fn end(integrator: &str, steps: usize, rest: &str) -> DVector<f64> {
    let mut simulation = build(&soft(integrator, 0.2 / steps as f64, rest));
    run(&mut *simulation, steps);
    let (q, v) = (simulation.positions(), simulation.velocities());
    DVector::from_iterator(q.len() + v.len(), q.iter().chain(v.iter()).copied())
}

#[test]
fn methods_keep_their_order_where_nodes_follow_a_motion() {
    for motion in [SWUNG, TURNED] {
        for more in ["", LUMPED, DAMPED] {
            let rest = format!("{motion}{more}");
            let reference = end("rk4", 6400, &rest);
            for (integrator, order, steps) in [("verlet", 2.0, 200), ("rk2", 2.0, 400), ("rk4", 4.0, 400)] {
                let errors = [steps, 2 * steps].map(|steps| distance(&end(integrator, steps, &rest), &reference));
                let measured = (errors[0] / errors[1]).log2();
                assert!((measured - order).abs() < 0.1, "{integrator}: order {measured}, errors {errors:?}, {rest}");
            }
        }
    }
}

/// The energy that the body has gained after so many steps of 0.2 s in all, and the work of the motions, J.
fn gained(
    build: fn(&System<f64>) -> Box<dyn Integrator<f64>>,
    steps: usize,
    rest: &str,
) -> Result<[f64; 2], fem_model::simulation::Cause> {
    let scene = scene(&soft("rk4", 1e-3, rest));
    let body = fem_scene::body(&scene, Path::new("no data")).unwrap();
    let system = System::<f64>::new(body, AnyLaw::new(&scene.material.value()).unwrap(), SolverChoice::Cholesky);
    let (mut integrator, dt) = (build(&system), 0.2 / steps as f64);
    let (mut state, mut counters) = (State::at_start(system.nodes(), &[]), Counters::default());
    let mut work = 0.0;
    for _ in 0..steps {
        integrator.step(&system, &mut state, dt, &mut counters)?;
        state.time += dt;
        work += integrator.work_of_stages().map(|work| work.motions + work.jump).unwrap();
    }
    let energy = system.mass.kinetic_energy(&state.v) + system.potential(&state.u, Moment::at(state.time)).value;
    Ok([energy, work])
}

#[test]
fn the_work_of_a_motion_is_the_energy_that_the_body_gains() {
    type Build = fn(&System<f64>) -> Box<dyn Integrator<f64>>;
    let methods: [(&str, Build, usize, f64); 5] = [
        ("explicit_euler", |system| Box::new(ExplicitEuler::new(system)), 4000, 2e-2),
        ("semi_implicit_euler", |system| Box::new(SemiImplicitEuler::new(system)), 4000, 2e-2),
        ("rk2", |system| Box::new(Rk2::new(system)), 400, 1e-3),
        ("verlet", |system| Box::new(Verlet::new(system)), 400, 1e-2),
        ("rk4", |system| Box::new(Rk4::new(system)), 400, 1e-7),
    ];
    for motion in [SWUNG, TURNED] {
        for mass in ["", LUMPED] {
            for (name, build, steps, tolerance) in methods {
                let [energy, work] = gained(build, steps, &format!("{motion}{mass}")).unwrap();
                assert!(
                    (work - energy).abs() < tolerance * energy,
                    "{name}: {work} J against {energy} J, {motion}{mass}"
                );
            }
        }
    }
}

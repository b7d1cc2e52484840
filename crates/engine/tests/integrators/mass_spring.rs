//! Mass-spring bodies in motion and in equilibrium: closed forms, orders, what is conserved, and what is not built.

use fem_model::BodyMesh;
use fem_model::simulation::Simulation;
use nalgebra::{DVector, Vector3};

use crate::{DYNAMIC, SECOND_ORDER, build, distance, node_masses, of_kuhn, run, scene, soft};

/// The box of 2 × 1 × 1 m with a spring along every edge; `rest` are further tables.
fn springs(integrator: &str, dt: f64, damping: f64, rest: &str) -> String {
    let material = format!("model = \"mass_spring\"\nstiffness = 2e4\ndamping = {damping:?}");
    soft(integrator, dt, rest).replace("model = \"neo_hookean\"\nC = 1e4\nD = 4e4", &material)
}

const PULLED: &str = r#"[gravity]
acceleration = [0, -20, 3]
[fixed]
plane = { axis = "x", below = 1e-9 }
[drag]
vertex = 5
stiffness = 2e3
direction = [1, 0, 0.5]
amplitude = 0.3
frequency = 2.0
"#;

/// Positions and velocities after so many steps of 0.2 s in all.
fn end(integrator: &str, steps: usize, rest: &str) -> DVector<f64> {
    let mut simulation = build(&springs(integrator, 0.2 / steps as f64, 60.0, rest));
    run(&mut *simulation, steps);
    let (q, v) = (simulation.positions(), simulation.velocities());
    DVector::from_iterator(q.len() + v.len(), q.iter().chain(v.iter()).copied())
}

#[test]
fn every_method_converges_to_the_same_damped_motion_with_its_order() {
    let newton = format!("{PULLED}[newton]\ntolerance = 1e-14\n");
    let reference = end("rk4", 4000, PULLED);
    let one = ["explicit_euler", "semi_implicit_euler", "linearly_implicit_euler", "implicit_euler"];
    let methods = one.iter().map(|method| (*method, 1.0, 800));
    let methods = methods.chain([("rk2", 2.0, 200), ("verlet", 2.0, 200), ("rk4", 4.0, 100)]);
    for (integrator, order, steps) in methods.chain(SECOND_ORDER.map(|method| (method, 2.0, 320))) {
        let has_newton = integrator == "implicit_euler" || SECOND_ORDER.contains(&integrator);
        let rest = if has_newton { &newton } else { PULLED };
        let errors = [steps, 2 * steps].map(|steps| distance(&end(integrator, steps, rest), &reference));
        let measured = (errors[0] / errors[1]).log2();
        assert!((measured - order).abs() < 0.1, "{integrator}: order {measured}, errors {errors:?}");
    }
}

/// A free body with an initial velocity that strains and turns it.
const THROWN: &str = "[[initial_velocity]]\nvelocity = [1, 2, -1]\nangular = { axis = [1, 1, 0], rate = 2.0 }\n\
                      [[initial_velocity]]\nnodes = [11]\nvelocity = [3, 1, 0]\n";

fn node(values: &DVector<f64>, node: usize) -> Vector3<f64> {
    values.fixed_rows::<3>(3 * node).into()
}

/// Σ m v, and Σ m |v| to measure it by.
fn momentum(simulation: &dyn Simulation) -> (Vector3<f64>, f64) {
    let v = simulation.velocities();
    let masses = node_masses(simulation, 1000.0).into_iter().enumerate();
    masses.fold((Vector3::zeros(), 0.0), |(sum, size), (i, m)| (sum + m * node(&v, i), size + m * node(&v, i).norm()))
}

#[test]
fn every_method_keeps_the_momentum_of_a_free_mass_spring_body() {
    for integrator in DYNAMIC {
        for (damping, lumped) in [(0.0, false), (40.0, true)] {
            let rest = format!("{THROWN}[mass]\nlumped = {lumped}\n");
            let mut simulation = build(&springs(integrator, 5e-4, damping, &rest));
            let (before, scale) = momentum(&*simulation);
            run(&mut *simulation, 400);
            let change = (momentum(&*simulation).0 - before).amax() / scale;
            assert!(change < 1e-12, "{integrator}, damping {damping}: {change:e}");
        }
    }
}

#[test]
fn verlet_keeps_the_energy_of_springs_but_for_a_swing_of_second_order_and_dampers_lower_it() {
    let swing = |dt: f64| {
        let mut simulation = build(&springs("verlet", dt, 0.0, THROWN));
        let start = simulation.energies().total();
        let mut largest: f64 = 0.0;
        for _ in 0..(2.0 / dt) as usize {
            run(&mut *simulation, 1);
            largest = largest.max((simulation.energies().total() / start - 1.0).abs());
        }
        largest
    };
    let swings = [2e-3, 1e-3].map(swing);
    let order = (swings[0] / swings[1]).log2();
    assert!(swings[0] < 1e-2 && (order - 2.0).abs() < 0.2, "{swings:?}: order {order}");
    let mut simulation = build(&springs("rk4", 1e-3, 40.0, THROWN));
    let mut before = simulation.energies().total();
    for step in 0..200 {
        run(&mut *simulation, 1);
        let now = simulation.energies().total();
        assert!(now < before, "step {step}: {now} J after {before} J");
        before = now;
    }
}

/// A triangle whose two lower nodes are fixed and whose top moves along y: two springs of 100 N/m that lean by 60°, which come to
/// 150 N/m along y. A third of the triangle's mass of √3/4 · 30 kg is the top's.
fn tuned(integrator: &str, dt: f64, damping: f64) -> Box<dyn Simulation> {
    let text = format!(
        r#"pipeline = "engine"
[mesh]
rectangle = {{ size = [1, 1], cells_per_unit = 1 }}
[material]
model = "mass_spring"
stiffness = 100.0
damping = {damping:?}
density = 30.0
[mass]
lumped = true
[fixed]
nodes = [0, 1]
[[prescribed]]
nodes = [2]
displacement = [0, 0, 0]
components = ["x"]
[[initial_velocity]]
nodes = [2]
velocity = [0, 1e-6, 0]
[time]
dt = {dt:e}
integrator = "{integrator}"
"#
    );
    let scene = scene(&text);
    let vertices = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.5, 0.75f64.sqrt(), 0.0]].map(Vector3::from).to_vec();
    let triangles = fem_mesh::SurfaceMesh::new(vertices, vec![[0, 1, 2]]);
    let mesh = BodyMesh::flat(triangles, 1.0);
    let body = fem_scene::body_of(&scene, mesh, std::path::Path::new("no data")).unwrap();
    fem_engine::simulator::build(body, &scene.method()).unwrap()
}

#[test]
fn a_node_on_two_springs_vibrates_as_a_damped_oscillator() {
    let mass = 30.0 * 0.75f64.sqrt() / 6.0;
    for damping in [0.0, 5.0] {
        let (omega2, decay) = (150.0 / mass, 0.75 * damping / mass);
        let omega = (omega2 - decay * decay).sqrt();
        let steps = 300;
        for (integrator, tolerance) in [("rk4", 3e-6), ("verlet", 3e-3), ("implicit_midpoint", 5e-3), ("bdf2", 2e-2)] {
            let dt = 3.0 / f64::from(steps);
            let mut simulation = tuned(integrator, dt, damping);
            let rest = simulation.positions()[7];
            for step in 1..=steps {
                run(&mut *simulation, 1);
                let t = dt * f64::from(step);
                let expected = 1e-6 * (-decay * t).exp() * (omega * t).sin() / omega;
                let error = (simulation.positions()[7] - rest - expected).abs() / (1e-6 / omega);
                // Springs are linear to first order alone: an amplitude of 2e-7 leaves less than 1e-6.
                assert!(error < tolerance + 1e-6, "{integrator}, damping {damping}, step {step}: {error:e}");
            }
        }
    }
}

#[test]
fn the_longest_stable_step_is_known_with_dampers_too() {
    for integrator in ["verlet", "semi_implicit_euler", "rk4"] {
        let undamped = kicked(integrator, 0.0);
        let damped = kicked(integrator, 40.0);
        // The region of stability of rk4 begins to grow with the damping.
        assert!(
            (damped < undamped) == (integrator != "rk4"),
            "{integrator}: {damped} s with dampers, {undamped} s without"
        );
    }
}

/// The critical time step, s, on whose two sides the motion stays and grows.
fn kicked(integrator: &str, damping: f64) -> f64 {
    let kick = "[[initial_velocity]]\nnodes = [0]\nvelocity = [1e-4, -2e-4, 1e-4]\n";
    let critical = build(&springs(integrator, 1.0, damping, "")).critical_time_step().unwrap();
    for (part, is_stable) in [(0.98, true), (1.03, false)] {
        let mut simulation = build(&springs(integrator, part * critical, damping, kick));
        let end = (0..3000).try_for_each(|_| simulation.step());
        assert_eq!(end.is_ok(), is_stable, "{integrator}, damping {damping}: {part} of {critical} s");
    }
    critical
}

#[test]
fn the_reactions_of_a_hanging_net_are_its_weight() {
    let net = |integrator: &str, rest: &str| {
        format!(
            "pipeline = \"engine\"\n[mesh]\nrectangle = {{ size = [1, 0.5], cells_per_unit = 8 }}\n[material]\n\
             model = \"mass_spring\"\nyoung = 2e4\ndamping = 4.0\ndensity = 20.0\n[gravity]\nacceleration = [0, -9.81, 0]\n\
             [fixed]\nnodes = [36, 44]\n[time]\ndt = 0.02\nintegrator = \"{integrator}\"\n{rest}"
        )
    };
    let weight = 20.0 * 0.5 * 9.81;
    let mut at_rest = build(&net("static", "[static]\nload_steps = 2\n"));
    run(&mut *at_rest, 2);
    let force = at_rest.reactions()[0].force;
    assert!((force[1] - weight).abs() < 1e-8 * weight && force[0].abs() < 1e-8 * weight, "{force:?}");
    // A net that falls into its supports comes to rest in that equilibrium.
    let mut falling = build(&net("bdf2", "[damping]\nalpha = 4.0\n"));
    run(&mut *falling, 600);
    let force = falling.reactions()[0].force;
    assert!((force[1] - weight).abs() < 1e-5 * weight, "{force:?}");
    assert!(distance(&falling.positions(), &at_rest.positions()) < 1e-5, "it hangs elsewhere");
}

#[test]
fn a_mass_spring_body_builds_springs_and_no_element() {
    for integrator in ["verlet", "implicit_euler", "static"] {
        let rest = if integrator == "static" { "[fixed]\nplane = { axis = \"x\", below = 0.5 }\n" } else { "" };
        let of_springs = build(&springs(integrator, 1e-3, 0.0, rest)).parts();
        let of_elements = build(&soft(integrator, 1e-3, rest)).parts();
        let find = |parts: &[fem_model::simulation::Part], name: &str| {
            let part = parts.iter().find(|part| part.name == name).unwrap();
            (part.built, part.bytes)
        };
        assert_eq!(find(&of_springs, "mesh"), (true, 0), "{integrator}: no storage of elements");
        assert_eq!(find(&of_springs, "forces"), (false, 0), "{integrator}");
        assert!(find(&of_springs, "mass_spring").0 && find(&of_springs, "mass_spring").1 > 0, "{integrator}");
        assert_eq!(find(&of_elements, "mass_spring"), (false, 0), "{integrator}");
        assert!(find(&of_elements, "forces").0 && find(&of_elements, "mesh").1 > 0, "{integrator}");
    }
}

#[test]
fn springs_have_no_stress_but_their_elements_still_have_a_volume() {
    let mut simulation = build(&of_kuhn(&springs("verlet", 1e-3, 0.0, THROWN)));
    assert!(!simulation.has_stress() && simulation.stresses().is_empty());
    assert!((simulation.min_J().0 - 1.0).abs() < 1e-14 && simulation.inverted_elements() == 0);
    run(&mut *simulation, 50);
    assert!(simulation.min_J().0 < 1.0);
}

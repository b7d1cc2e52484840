//! References in time: closed forms, conservation, prescribed motion, and the integrators that approach them.

use std::path::Path;

use fem_reference::time::{Equations, Phase, SELF_CHECK, Scratch, reference};
use fem_scene::{body, parse};
use nalgebra::Vector3;

fn equations(text: &str) -> Equations {
    let scene = parse(text, Path::new("folder/name.toml")).unwrap();
    let body = body(&scene, Path::new("no data")).unwrap();
    Equations::new(body).unwrap()
}

#[test]
fn free_fall_is_exact() {
    let text = "pipeline = \"engine\"\n[mesh]\nbox = { size = [1, 1, 1], cells_per_unit = 1 }\n[material]\n\
        model = \"neo_hookean\"\nC = 1e4\nD = 4e4\ndensity = 1000.0\n[gravity]\nacceleration = [0, -9.81, 0]\n\
        [time]\ndt = 0.01\nintegrator = \"verlet\"\n";
    let reference = reference(&equations(text), 0.5, 60.0).unwrap();
    assert!(reference.check.0 <= SELF_CHECK.0 && reference.check.1 <= SELF_CHECK.1);
    for (i, v) in reference.qdot.iter().enumerate() {
        let expected = if i % 3 == 1 { -9.81 * 0.5 } else { 0.0 };
        assert!((v - expected).abs() < 1e-11, "{v} {expected}");
    }
}

#[test]
fn a_node_on_a_spring_follows_the_cosine() {
    // All nodes but one are constrained and the body is too soft to matter: ü = 1 − ω² u, ω² = k/m.
    let text = "pipeline = \"engine\"\n[mesh]\nbox = { size = [2, 1, 1], cells_per_unit = 1, pattern = \"kuhn\" }\n[material]\n\
        model = \"linear\"\nyoung = 1e-9\npoisson = 0.0\ndensity = 1000.0\n[mass]\nlumped = true\n[gravity]\n\
        acceleration = [1, 0, 0]\n[fixed]\nnodes = [0, 1, 2, 3, 4, 6, 7, 8, 9, 10, 11]\n[[springs]]\nnodes = [4, 5]\n\
        stiffness = 1e4\n[time]\ndt = 0.01\nintegrator = \"verlet\"\n";
    let equations = equations(text);
    let fastest = equations.fastest();
    let found = reference(&equations, 3.0, 60.0).unwrap();
    let expected = (1.0 - (fastest * 3.0).cos()) / (fastest * fastest);
    let moved = found.q[15] - 2.0;
    assert!((moved - expected).abs() < 1e-9 * (2.0 / (fastest * fastest)), "{moved} {expected}");
}

#[test]
fn energy_is_conserved_to_the_self_check() {
    let text = "pipeline = \"engine\"\n[mesh]\nbox = { size = [2, 1, 1], cells_per_unit = 1, pattern = \"kuhn\" }\n[material]\n\
        model = \"neo_hookean\"\nC = 1e4\nD = 4e4\ndensity = 1000.0\n[gravity]\nacceleration = [0, -9.81, 0]\n\
        [fixed]\nplane = { axis = \"x\", below = 1e-9 }\n[time]\ndt = 0.01\nintegrator = \"verlet\"\n";
    let found = reference(&equations(text), 0.3, 60.0).unwrap();
    assert!((found.kinetic + found.potential).abs() < 1e-9 * found.kinetic, "{found:?}");
}

/// A box of 12 nodes so soft that only springs and mass matter.
fn soft_box(tables: &str) -> Equations {
    equations(&format!(
        "pipeline = \"engine\"\n[mesh]\nbox = {{ size = [2, 1, 1], cells_per_unit = 1, pattern = \"kuhn\" }}\n[material]\nmodel = \"linear\"\n\
         young = 1e-9\npoisson = 0.0\ndensity = 1000.0\n[time]\ndt = 0.01\nintegrator = \"verlet\"\n{tables}"
    ))
}

const TOWED: &str = "[fixed]\nnodes = [0, 1, 2, 3, 6, 7, 8, 9, 10, 11]\n[[springs]]\nnodes = [4, 5]\nstiffness = 1e4\n\
     [[prescribed]]\nnodes = [4]\ndisplacement = [0.2, 0, 0]\nover = 1.0\n";

/// Displacement V t + (v − V)/ω sin ωt and velocity of a node with initial velocity v, on a spring whose other end moves at V.
fn towed(omega: f64, V: f64, v: f64, t: f64) -> [f64; 2] {
    [V * t + (v - V) / omega * (omega * t).sin(), V + (v - V) * (omega * t).cos()]
}

#[test]
fn a_towed_node_follows_the_sine_and_swings_after_the_tow() {
    let equations = soft_box(&format!("[mass]\nlumped = true\n{TOWED}"));
    let omega = equations.fastest();
    let found = reference(&equations, 1.0, 60.0).unwrap();
    let [u, v] = towed(omega, 0.2, 0.0, 1.0);
    assert!((found.q[15] - 2.0 - u).abs() < 1e-9 && (found.qdot[15] - v).abs() < 1e-7, "{found:?}");
    let later = reference(&equations, 1.7, 60.0).unwrap();
    let (c, s) = ((omega * 0.7).cos(), (omega * 0.7).sin());
    let expected = 0.2 + (u - 0.2) * c + v / omega * s;
    assert!((later.q[15] - 2.0 - expected).abs() < 1e-9, "{} {expected}", later.q[15] - 2.0);
}

#[test]
fn a_velocity_jump_gives_neighbours_an_impulse_through_the_consistent_mass() {
    let equations = soft_box(TOWED);
    let (node, towed_node) =
        (equations.system.numbering.engine_node[5] as usize, equations.system.numbering.engine_node[4] as usize);
    let mass = |from: usize| {
        let (mut unit, mut force) = (vec![[0.0; 3]; 12], vec![[0.0; 3]; 12]);
        unit[from][0] = 1.0;
        equations.system.mass.add_times(1.0, &unit, &mut force);
        force[node][0]
    };
    let [u, _] = towed(equations.fastest(), 0.2, -0.2 * mass(towed_node) / mass(node), 0.5);
    let found = reference(&equations, 0.5, 60.0).unwrap();
    assert!(mass(towed_node) > 0.1 * mass(node));
    assert!((found.q[15] - 2.0 - u).abs() < 1e-9, "{} {u}", found.q[15] - 2.0);
}

/// Prescribed displacements and velocities at a time of the interval that begins at another, zero elsewhere.
fn prescribed(equations: &Equations, begin: f64, time: f64, scratch: &mut Scratch) -> Phase {
    let mut phase = equations.start();
    equations.prescribe(begin, time, &mut phase, scratch);
    phase
}

/// Panics unless velocities and accelerations of the prescribed node 4 are differences of its displacements and velocities over a step h, up to
/// these errors. The other nodes show its acceleration: nothing but their masses resists the motion.
fn matches_differences(equations: &Equations, h: f64, errors: [f64; 2]) {
    let node = equations.system.numbering.engine_node[4] as usize;
    let mut scratch = Scratch::default();
    let mut at = |time: f64| prescribed(equations, 0.0, time, &mut scratch).map(|of_all| Vector3::from(of_all[node]));
    let (before, after) = (at(0.8 - h), at(0.8 + h));
    let [velocity, acceleration] = [0, 1].map(|i| (after[i] - before[i]) / (2.0 * h));
    let [u, v] = prescribed(equations, 0.0, 0.8, &mut scratch);
    assert!((velocity - Vector3::from(v[node])).norm() < errors[0], "{velocity} {v:?}");
    let (mut a, mut force, mut weight) = (vec![[0.0; 3]; 12], vec![[0.0; 3]; 12], vec![[0.0; 3]; 12]);
    equations.accelerations(&u, &v, 0.8, &mut a, &mut scratch);
    assert_eq!(a[node], [0.0; 3]);
    a[node] = acceleration.into();
    equations.system.mass.add_times(1.0, &a, &mut force);
    let mut unit = vec![[0.0; 3]; 12];
    unit[node] = [1.0; 3];
    equations.system.mass.add_times(1.0, &unit, &mut weight);
    let neighbours: Vec<usize> = (0..12).filter(|&other| other != node && weight[other][0] > 0.0).collect();
    assert!(!neighbours.is_empty());
    for other in neighbours {
        let error = Vector3::from(force[other]).norm() / weight[other][0];
        assert!(error < errors[1], "{error}: {acceleration} {a:?}");
    }
}

#[test]
fn prescribed_velocities_and_accelerations_match_finite_differences() {
    let equations = soft_box(
        "[[prescribed]]\nnodes = [4]\ndisplacement = [0.2, -0.1, 0.4]\nover = 2.0\n\
         rotation = { axis = \"y\", center = [0.3, 0.1, 0.2], turns = 0.7 }\n",
    );
    matches_differences(&equations, 1e-4, [1e-6, 1e-6]);
    let [_, v] = prescribed(&equations, 2.0, 2.5, &mut Scratch::default());
    assert_eq!(v, vec![[0.0; 3]; 12]);
}

#[test]
fn a_thrown_body_under_growing_gravity_moves_in_closed_form() {
    let curves = [
        ("{ ramp = 0.3 }", 0.35, 0.35 * 0.35 / 2.0 + 0.3 * 0.3 / 24.0),
        ("{ on = 0.1, off = 0.4 }", 0.3, 0.3 * 0.3 / 2.0 + 0.3 * 0.1),
    ];
    for (curve, impulse, fallen) in curves {
        let equations = soft_box(&format!(
            "[gravity]\nacceleration = [0, -10, 0]\ncurve = {curve}\n[[initial_velocity]]\nvelocity = [2, 3, 0]\n"
        ));
        let found = reference(&equations, 0.5, 60.0).unwrap();
        let (moved, velocity) = (found.q.fixed_rows::<3>(0).into_owned(), found.qdot.fixed_rows::<3>(0).into_owned());
        assert!((velocity - Vector3::new(2.0, 3.0 - 10.0 * impulse, 0.0)).norm() < 1e-11, "{curve}: {velocity}");
        assert!((moved - Vector3::new(1.0, 1.5 - 10.0 * fallen, 0.0)).norm() < 1e-11, "{curve}: {moved}");
    }
}

#[test]
fn a_motion_on_a_sine_has_the_velocities_of_the_sine() {
    let equations = soft_box(
        "[[prescribed]]\nnodes = [4]\ndisplacement = [0.2, 0, 0]\ncurve = { sine = { frequency = 0.7 } }\n\
         rotation = { axis = \"y\", center = [0.3, 0.1, 0.2], turns = 0.7 }\n",
    );
    matches_differences(&equations, 1e-5, [1e-5, 1e-4]);
}

#[test]
fn a_release_has_no_reference() {
    let text = "pipeline = \"engine\"\n[mesh]\nbox = { size = [2, 1, 1], cells_per_unit = 1, pattern = \"kuhn\" }\n[material]\nmodel = \"linear\"\n\
        young = 1e3\npoisson = 0.0\ndensity = 1000.0\n[fixed]\nnodes = [0]\nuntil = 1\n[time]\ndt = 0.01\nintegrator = \"verlet\"\n";
    let scene = parse(text, Path::new("folder/name.toml")).unwrap();
    let body = body(&scene, Path::new("no data")).unwrap();
    assert!(Equations::new(body).is_err_and(|reason| reason.contains("become free")));
}

#[test]
fn displacements_that_jump_have_no_reference() {
    let equations = soft_box("[[prescribed]]\nnodes = [4]\ndisplacement = [0.2, 0, 0]\n");
    assert!(reference(&equations, 1.0, 60.0).unwrap_err().contains("over"));
}

#[test]
fn explicit_methods_follow_a_turning_clamp_to_the_reference_with_their_order() {
    let text = "pipeline = \"engine\"\n[mesh]\nbox = { size = [2, 1, 1], cells_per_unit = 1, pattern = \"kuhn\" }\n[material]\n\
        model = \"neo_hookean\"\nC = 1e4\nD = 4e4\ndensity = 1000.0\n[fixed]\nplane = { axis = \"x\", below = 1e-9 }\n\
        [[prescribed]]\non = { axis = \"x\", side = \"max\", within = 1e-9 }\n\
        rotation = { axis = \"x\", center = [0, 0.5, 0.5], turns = 0.2 }\ndisplacement = [0.1, 0, 0.2]\n\
        curve = { sine = { frequency = 2.5 } }\n[time]\ndt = DT\nintegrator = \"METHOD\"\n";
    let of = |method: &str, steps: usize| {
        let text = text.replace("DT", &format!("{:e}", 0.2 / steps as f64)).replace("METHOD", method);
        parse(&text, Path::new("folder/name.toml")).unwrap()
    };
    let scene = of("rk4", 100);
    let exact = reference(&Equations::new(body(&scene, Path::new("")).unwrap()).unwrap(), 0.2, 60.0).unwrap();
    for (method, order, steps) in [("verlet", 2.0, 200), ("rk2", 2.0, 400), ("rk4", 4.0, 200)] {
        let error = |steps: usize| {
            let scene = of(method, steps);
            let mut simulation =
                fem_engine::simulator::build(body(&scene, Path::new("")).unwrap(), &scene.method()).unwrap();
            (0..steps).for_each(|_| simulation.step().unwrap());
            f64::max((simulation.positions() - &exact.q).amax(), 0.1 * (simulation.velocities() - &exact.qdot).amax())
        };
        let [coarse, fine] = [steps, 2 * steps].map(error);
        let measured = (coarse / fine).log2();
        assert!((measured - order).abs() < 0.1, "{method}: order {measured}, errors {coarse:e} and {fine:e}");
    }
}

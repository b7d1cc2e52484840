use std::path::Path;

use fem_scene::{body, parse};
use nalgebra::Vector3;

use super::equations::kinematics;
use super::*;

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

#[test]
fn prescribed_velocities_and_accelerations_match_finite_differences() {
    let equations = soft_box(
        "[[prescribed]]\nnodes = [4]\ndisplacement = [0.2, -0.1, 0.4]\nover = 2.0\n\
         rotation = { axis = \"y\", center = [0.3, 0.1, 0.2], turns = 0.7 }\n",
    );
    let motion = &equations.system.dirichlet.motions().next().unwrap().1;
    let at = |time: f64| kinematics(motion, &Vector3::new(1.0, 2.0, -1.0), 0.0, time);
    let (h, [_, v, a]) = (1e-4, at(0.8));
    let (before, after) = (at(0.8 - h), at(0.8 + h));
    assert!(((after[0] - before[0]) / (2.0 * h) - v).norm() < 1e-6);
    assert!(((after[1] - before[1]) / (2.0 * h) - a).norm() < 1e-6);
    assert_eq!(kinematics(motion, &Vector3::new(1.0, 2.0, -1.0), 2.0, 2.5)[1], Vector3::zeros());
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
    let motion = &equations.system.dirichlet.motions().next().unwrap().1;
    let at = |time: f64| kinematics(motion, &Vector3::new(1.0, 2.0, -1.0), 0.0, time);
    let (h, [_, v, a]) = (1e-5, at(0.8));
    let (before, after) = (at(0.8 - h), at(0.8 + h));
    assert!(((after[0] - before[0]) / (2.0 * h) - v).norm() < 1e-5);
    assert!(((after[1] - before[1]) / (2.0 * h) - a).norm() < 1e-4);
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

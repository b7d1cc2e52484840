//! `[[force]]`: dead loads on single nodes, under every method.

use fem_engine::forces::dead_load;
use nalgebra::Vector3;

use crate::{DYNAMIC, build, distance, node_masses, run, soft};

const CLAMP: &str = "[fixed]\nplane = { axis = \"x\", below = 1e-9 }\n";

/// 3 N along x and −5 N along y on each of the four nodes of the end of largest x.
const END: &str = "[[force]]\non = { axis = \"x\", side = \"max\", within = 1e-9 }\nvalue = [3, -5, 0]\n";

#[test]
fn each_node_carries_the_whole_value_and_several_tables_add_up() {
    let simulation =
        build(&soft("implicit_euler", 1e-3, &format!("{END}[[force]]\nnodes = [2, 5, 2]\nvalue = [0, 1, 7]\n")));
    let force = simulation.nodal_forces().unwrap();
    let shape = simulation.shape();
    for (node, place) in shape.mesh.vertices().iter().enumerate() {
        let end = if place.x > 1.9 { Vector3::new(3.0, -5.0, 0.0) } else { Vector3::zeros() };
        let listed = if [2, 5].contains(&node) { Vector3::new(0.0, 1.0, 7.0) } else { Vector3::zeros() };
        assert_eq!(Vector3::from(force.fixed_rows::<3>(3 * node)), end + listed, "node {node}");
    }
}

#[test]
fn at_equilibrium_the_reaction_balances_the_sum_of_the_nodal_forces() {
    for rest in ["[static]\nload_steps = 3\n", "[static]\nload_steps = 4\narc_length = true\n"] {
        let mut simulation = build(&soft("static", 1.0, &format!("{CLAMP}{END}{rest}[newton]\ntolerance = 1e-13\n")));
        for _ in 0..100 {
            simulation.step().unwrap();
        }
        let reaction = simulation.reactions()[0].force;
        for (found, expected) in reaction.iter().zip([-12.0, 20.0, 0.0]) {
            assert!((found - expected).abs() < 1e-7, "{rest}: {reaction:?}");
        }
    }
}

#[test]
fn the_impulse_of_a_nodal_force_is_the_same_under_every_method() {
    let sweeps = ["xpbd", "pbd", "vbd", "projective_dynamics"];
    for integrator in DYNAMIC.into_iter().chain(sweeps) {
        let mut simulation = build(&crate::of_law(
            if sweeps.contains(&integrator) { "corotated" } else { "yeoh" },
            &soft(integrator, 1e-3, END),
        ));
        run(&mut *simulation, 20);
        let (v, masses) = (simulation.velocities(), node_masses(&*simulation, 1000.0));
        let momentum: Vector3<f64> = masses.iter().enumerate().map(|(i, m)| *m * v.fixed_rows::<3>(3 * i)).sum();
        let expected = Vector3::new(12.0, -20.0, 0.0) * 0.02;
        assert!((momentum - expected).norm() < 1e-4 * expected.norm(), "{integrator}: {momentum}");
    }
}

#[test]
fn the_work_of_a_constant_nodal_force_is_its_potential_energy() {
    let mut simulation = build(&soft("implicit_midpoint", 1e-3, &format!("{CLAMP}{END}")));
    let start = simulation.positions();
    run(&mut *simulation, 30);
    let moved = simulation.positions() - &start;
    let shape = simulation.shape();
    let end = shape.mesh.vertices().iter().enumerate().filter(|(_, place)| place.x > 1.9);
    let work: f64 = end.map(|(node, _)| 3.0 * moved[3 * node] - 5.0 * moved[3 * node + 1]).sum();
    let energies = simulation.energies();
    let elastic = energies.potential + work;
    assert!(work > 0.0 && elastic > 0.0 && energies.kinetic > 0.0);
    assert!((energies.kinetic + elastic - work).abs() < 1e-5 * work, "{energies:?} {work}");
}

#[test]
fn nodal_forces_with_a_factor_of_time_act_as_the_traction_of_the_same_size() {
    let curve = "curve = { table = [[0, 0], [0.02, 1], [0.05, -1]] }\n";
    // The corners of the end share its triangles unevenly: 2/6, 1/6, 1/6 and 2/6 of 12 N.
    let of_traction = format!(
        "{CLAMP}[[traction]]\non = {{ axis = \"x\", side = \"max\", within = 1e-9 }}\nforce_per_area = [0, 12, 0]\n{curve}"
    );
    let traction = build(&soft("implicit_euler", 1e-2, &of_traction));
    let mut shares = Vec::new();
    {
        let mut still = build(&soft("implicit_euler", 1e-2, &of_traction.replace(curve, "")));
        let force = still.nodal_forces().unwrap();
        for node in 0..still.shape().mesh.vertices().len() {
            if force[3 * node + 1] != 0.0 {
                shares.push(format!("[[force]]\nnodes = [{node}]\nvalue = [0, {:e}, 0]\n{curve}", force[3 * node + 1]));
            }
        }
        run(&mut *still, 1);
    }
    assert_eq!(shares.len(), 4);
    let (mut traction, mut nodal) =
        (traction, build(&soft("implicit_euler", 1e-2, &format!("{CLAMP}{}", shares.concat()))));
    assert!(nodal.parts().iter().any(|part| part.name == dead_load::NAME));
    run(&mut *traction, 10);
    run(&mut *nodal, 10);
    assert!(distance(&traction.positions(), &nodal.positions()) < 1e-14);
}

//! Quadratic triangles in motion.

use fem_model::element::shares::{load_shares, lumped_mass_shares};
use fem_model::simulation::Simulation;
use fem_output::export;
use fem_scene::{resume, write_state};
use nalgebra::Vector3;

use crate::quadratic::quadratic;
use crate::{DYNAMIC, build, distance, of_law, run, soft};

const LUMPED: &str = "[mass]\nlumped = true\n";

#[test]
fn a_free_body_falls_without_deformation_with_every_method_and_either_mass() {
    for method in DYNAMIC {
        for mass in ["", LUMPED] {
            let (dt, steps) = (1e-3, 20);
            let text = quadratic(&soft(method, dt, &format!("[gravity]\nacceleration = [0.5, -2, 0]\n{mass}")));
            let mut simulation = build(&text);
            run(&mut *simulation, steps);
            let (v, time) = (simulation.velocities(), dt * steps as f64);
            for v in v.as_slice().chunks(3) {
                assert!((v[0] - 0.5 * time).abs() < 1e-10 && (v[1] + 2.0 * time).abs() < 1e-10, "{method}: {v:?}");
                assert_eq!(v[2], 0.0, "{method}");
            }
        }
    }
}

/// Row sums of the mass of each node, kg.
pub fn masses(simulation: &dyn Simulation, lumped: bool) -> Vec<f64> {
    let mesh = &simulation.shape().mesh;
    let shares = if lumped { lumped_mass_shares } else { load_shares }(mesh.element());
    let mut masses = vec![0.0; mesh.vertices().len()];
    for (nodes, volume) in mesh.corners().zip(mesh.volumes()) {
        nodes.iter().zip(&shares).for_each(|(&node, share)| masses[node] += 1000.0 * volume * share);
    }
    masses
}

/// Σ m v and Σ m |v|.
pub fn momentum(simulation: &dyn Simulation, masses: &[f64]) -> (Vector3<f64>, f64) {
    let v = simulation.velocities();
    let at = |node: usize| Vector3::from(v.fixed_rows::<3>(3 * node));
    masses.iter().enumerate().fold((Vector3::zeros(), 0.0), |(sum, size), (node, mass)| {
        (sum + *mass * at(node), size + mass.abs() * at(node).norm())
    })
}

/// A free strip whose right half moves off.
const THROWN: &str = "[[initial_velocity]]\nbox = { min = [1, 0, 0], max = [2, 1, 0] }\nvelocity = [1, 2, 0]\n";

#[test]
fn every_method_keeps_the_momentum_of_a_free_body() {
    for method in DYNAMIC {
        for (rest, lumped) in [("", false), (LUMPED, true), ("[damping]\nbeta = 1e-3\n", false)] {
            let mut simulation = build(&quadratic(&soft(method, 5e-4, &format!("{THROWN}{rest}"))));
            let masses = masses(&*simulation, lumped);
            assert!((masses.iter().sum::<f64>() - 600.0).abs() < 1e-9);
            let (before, scale) = momentum(&*simulation, &masses);
            run(&mut *simulation, 200);
            let change = (momentum(&*simulation, &masses).0 - before).amax() / scale;
            assert!(change < 1e-12, "{method} {rest:?}: {change:e}");
        }
    }
}

#[test]
fn verlet_keeps_the_energy_of_a_vibrating_body_with_either_mass() {
    for mass in ["", LUMPED] {
        let mut simulation = build(&quadratic(&soft("verlet", 2e-4, &format!("{THROWN}{mass}"))));
        let start = simulation.energies().total();
        run(&mut *simulation, 1000);
        let part = simulation.energies().total() / start - 1.0;
        assert!(part.abs() < 1e-3, "{part:e}");
    }
}

#[test]
fn the_critical_time_step_separates_runs_that_last_from_runs_that_end() {
    for mass in ["", LUMPED] {
        let text = |dt: f64| quadratic(&of_law("linear", &soft("verlet", dt, &format!("{THROWN}{mass}"))));
        let critical = build(&text(1e-3)).critical_time_step().unwrap();
        let lasts = |part: f64| {
            let mut simulation = build(&text(part * critical));
            (0..2000).all(|_| simulation.step().is_ok())
        };
        assert!(lasts(0.98) && !lasts(1.03), "{mass:?}: {critical:e} s");
    }
}

#[test]
fn a_plastic_strip_flows_as_one_of_linear_triangles_does_where_the_strain_is_uniform() {
    let stretched = |order: &dyn Fn(&str) -> String| {
        let tables = crate::side("x", "min", 0.0) + &crate::side("x", "max", 0.3) + &crate::side("y", "min", 0.0);
        let flow = "[plasticity]\nmodel = \"j2\"\nyield_stress = 2e3\nhardening = 5e3\n";
        let mut simulation = build(&order(&crate::block("hencky", &(tables + flow))));
        run(&mut *simulation, 1);
        (simulation.plastic_flow().unwrap(), simulation.reactions()[1].force[0])
    };
    let (linear, quadratic) = (stretched(&crate::flat::flat), stretched(&quadratic));
    assert_eq!(linear.0.strains.len(), quadratic.0.strains.len());
    assert!(linear.0.strains[0] > 0.05);
    for (a, b) in linear.0.strains.iter().zip(&quadratic.0.strains) {
        assert!((a - b).abs() < 1e-10, "{a} {b}");
    }
    assert!((linear.0.dissipated - quadratic.0.dissipated).abs() < 1e-9 * linear.0.dissipated);
    assert!((linear.1 - quadratic.1).abs() < 1e-9 * linear.1, "{} {}", linear.1, quadratic.1);
}

#[test]
fn a_resumed_plastic_run_ends_bit_for_bit_where_the_uninterrupted_one_does() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("state.json");
    let flow = "[plasticity]\nmodel = \"additive\"\nyield_strain = 0.02\ncreep = 5.0\nmaximum = 0.3\n";
    for method in ["verlet", "implicit_euler"] {
        let text = quadratic(&of_law("corotated", &soft(method, 1e-3, &format!("{THROWN}{flow}"))));
        let scene = crate::scene(&text);
        let mut simulation = build(&text);
        run(&mut *simulation, 40);
        write_state(&file, &scene, &*simulation).unwrap();
        run(&mut *simulation, 10);
        let mut resumed = build(&text);
        resume(&file, &scene, &mut *resumed).unwrap();
        run(&mut *resumed, 10);
        assert!(simulation.plastic_flow().unwrap().largest_strain() > 0.0, "{method}");
        assert_eq!(resumed.positions(), simulation.positions(), "{method}");
        assert_eq!(resumed.plastic_flow(), simulation.plastic_flow(), "{method}");
    }
}

#[test]
fn a_drag_a_spring_and_a_prescribed_motion_move_the_nodes_at_mid_sides() {
    let tables = "[fixed]\nplane = { axis = \"x\", below = 1e-9 }\n\
                  [drag]\nvertex = 60\nstiffness = 1e4\ndirection = [0, 1, 0]\namplitude = 0.1\nfrequency = 1.0\n\
                  [[springs]]\nnodes = [30, 61]\nstiffness = 1e3\n";
    let [coarse, fine] = [2e-3, 1e-3].map(|dt| {
        let mut simulation = build(&quadratic(&soft("implicit_euler", dt, tables)));
        assert!(simulation.shape().mesh.vertices().len() > 61);
        run(&mut *simulation, (0.1 / dt) as usize);
        simulation.positions()
    });
    let rest = build(&quadratic(&soft("implicit_euler", 1e-3, tables))).positions();
    assert!((coarse[3 * 60 + 1] - rest[3 * 60 + 1]) > 1e-3);
    assert!(distance(&coarse, &fine) < 0.1 * distance(&coarse, &rest));
}

#[test]
fn exports_have_quadratic_triangles_in_vtu_and_four_linear_ones_for_each_elsewhere() {
    let folder = tempfile::tempdir().unwrap();
    let mut simulation = build(&quadratic(&soft("verlet", 1e-3, THROWN)));
    run(&mut *simulation, 3);
    let mesh = simulation.shape().mesh.clone();
    let path = |name: &str| folder.path().join(name);
    for name in ["a.vtu", "a.obj", "a.glb"] {
        export(&path(name), &*simulation, &[]).unwrap();
    }
    let surface = fem_mesh::read_surface(&path("a.obj")).unwrap();
    assert_eq!((surface.vertices.len(), surface.elements.len()), (mesh.vertices().len(), 4 * mesh.elements()));
    let text = std::fs::read_to_string(path("a.vtu")).unwrap();
    let (points, cells) = (mesh.vertices().len(), mesh.elements());
    assert!(text.contains(&format!("NumberOfPoints=\"{points}\" NumberOfCells=\"{cells}\"")));
    // It is read by its corners.
    let linear = fem_mesh::read_surface(&path("a.vtu")).unwrap();
    assert!((0..cells).all(|element| mesh.corners_of(element) == linear.elements[element]));
}

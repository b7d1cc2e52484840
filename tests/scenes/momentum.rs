//! Momentum of a free body: without external forces it is conserved, at every size.

use fem_model::Integrator;
use fem_model::simulation::{Pull, Simulation};
use finite_elements_3d::mass_matrix_mesh;
use nalgebra::Vector3;

use crate::scene_text::{INTEGRATORS, build_with, edit, free_cube};

const DENSITY: f64 = 1000.0;

/// Steps of one second.
const STEPS: usize = 100;

/// 1ᵀ M v, kg m/s.
fn momentum(simulation: &dyn Simulation) -> Vector3<f64> {
    let shape = simulation.shape();
    let v = simulation.velocities();
    let M = mass_matrix_mesh(v.len(), shape.mesh.tetrahedra(), DENSITY, &shape.mesh.volumes());
    let p = M * v;
    (0..p.len() / 3).map(|node| Vector3::new(p[3 * node], p[3 * node + 1], p[3 * node + 2])).sum()
}

/// Drags a corner by a tenth of the edge for a few steps, so that the cube flies off, turns and wobbles.
fn throw(simulation: &mut dyn Simulation, edge: f64) {
    let corner = (26, simulation.shape().mesh.vertices()[26]);
    simulation.pull(Some(Pull { anchors: vec![corner], offset: Vector3::new(0.1, 0.05, -0.02) * edge }));
    (0..5).for_each(|_| simulation.step().unwrap());
    simulation.pull(None);
}

/// The part of its momentum that a thrown cube loses within a second.
fn lost_in_a_second(text: &str, edge: f64, integrator: Integrator) -> f64 {
    let mut simulation = build_with(&edit(text, "[material]", &format!("scale = {edge}\n[material]")), integrator);
    throw(&mut simulation, edge);
    let before = momentum(&simulation);
    assert!(before.norm() > 0.0);
    (0..STEPS).for_each(|_| simulation.step().unwrap());
    (momentum(&simulation) - before).norm() / before.norm()
}

#[test]
fn a_free_body_of_any_size_conserves_momentum_for_a_second() {
    for edge in [1.0, 1e-2, 1e-3] {
        // As soft as it is small, it moves like the large one.
        let (C, D) = (1e5 * edge * edge, 4e5 * edge * edge);
        let text = edit(&free_cube(), "C = 1e5\nD = 4e5\n", &format!("C = {C:e}\nD = {D:e}\n"));
        for integrator in INTEGRATORS {
            let lost = lost_in_a_second(&text, edge, integrator);
            assert!(lost <= 1e-12, "{}, {edge} m: {lost:e} of the momentum is lost", integrator.name());
        }
    }
}

#[test]
fn a_small_body_of_the_same_material_conserves_momentum() {
    for edge in [1.0, 1e-2, 1e-3] {
        for integrator in INTEGRATORS {
            let lost = lost_in_a_second(&free_cube(), edge, integrator);
            assert!(lost <= 1e-12, "{}, {edge} m: {lost:e} of the momentum is lost", integrator.name());
        }
    }
}

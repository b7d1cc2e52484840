//! The scenes of `data` that have a closed form or an invariant.

use fem_engine::cantilever;
use fem_model::Integrator;
use fem_model::simulation::Simulation;
use fem_scene::{Scene, load};
use nalgebra::{DVector, Vector3};

use crate::run;
use crate::shipped_scenes::data;

fn shipped(name: &str) -> Scene {
    load(name, &data()).unwrap_or_else(|error| panic!("{error}"))
}

fn built(scene: &Scene) -> Box<dyn Simulation> {
    let body = fem_scene::body(scene, &data()).unwrap();
    fem_engine::simulator::build(body, &scene.method()).unwrap()
}

fn node(values: &DVector<f64>, node: usize) -> Vector3<f64> {
    values.fixed_rows::<3>(3 * node).into()
}

/// Mass, centre of mass, momentum and angular momentum about the origin of a body with a lumped mass of 1000 kg/m³.
fn momenta(simulation: &dyn Simulation) -> (f64, Vector3<f64>, Vector3<f64>, Vector3<f64>) {
    let (x, v) = (simulation.positions(), simulation.velocities());
    let mut sums = (0.0, Vector3::zeros(), Vector3::zeros(), Vector3::zeros());
    for (i, m) in crate::node_masses(simulation, 1000.0).into_iter().enumerate() {
        sums.0 += m;
        sums.1 += m * node(&x, i);
        sums.2 += m * node(&v, i);
        sums.3 += m * node(&x, i).cross(&node(&v, i));
    }
    (sums.0, sums.1 / sums.0, sums.2, sums.3)
}

/// Relative drift of the angular momentum of `spinning` in a second.
fn drift(integrator: Integrator, dt: f64) -> f64 {
    let mut scene = shipped("spinning");
    (scene.time.integrator, scene.time.dt) = (integrator, Some(dt));
    let mut simulation = built(&scene);
    let (_, centre, _, before) = momenta(&*simulation);
    run(&mut *simulation, (1.0 / dt).round() as usize);
    let (mass, moved, momentum, after) = momenta(&*simulation);
    let name = integrator.name();
    assert!((moved - centre).norm() < 1e-12 && momentum.norm() < 1e-11 * mass, "{name}: {moved} {momentum}");
    (after - before).norm() / before.norm()
}

/// The largest drift of each method at a time step, s: docs/book/integrators.md shows the figures.
const DRIFTS: &[(Integrator, f64, f64)] = &[
    (Integrator::SemiImplicitEuler, 1e-3, 1e-13),
    (Integrator::Verlet, 1e-3, 1e-13),
    (Integrator::Rk4, 1e-3, 1e-10),
    (Integrator::Rk2, 1e-3, 1.6e-5),
    (Integrator::ExplicitEuler, 1e-4, 4e-3),
    (Integrator::LinearlyImplicitEuler, 1e-3, 0.03),
    (Integrator::ImplicitEuler, 1e-3, 0.03),
    (Integrator::ImplicitMidpoint, 1e-3, 1e-8),
    (Integrator::Newmark, 1e-3, 1e-5),
    (Integrator::GeneralizedAlpha, 1e-3, 1e-6),
    (Integrator::Bdf2, 1e-3, 4e-5),
    (Integrator::Bathe, 1e-3, 1e-5),
];

#[test]
fn the_spinning_bar_keeps_its_angular_momentum_as_well_as_its_method_can() {
    for &(integrator, dt, bound) in DRIFTS {
        let found = drift(integrator, dt);
        println!("{} at {dt}: {found:.1e}", integrator.name());
        assert!(found <= bound, "{}: {found:e}", integrator.name());
    }
}

#[test]
fn the_spinning_bar_starts_with_the_angular_momentum_of_a_rigid_body() {
    let simulation = built(&shipped("spinning"));
    let (x, masses) = (simulation.positions(), crate::node_masses(&*simulation, 1000.0));
    let (mass, centre, momentum, angular) = momenta(&*simulation);
    let moment: f64 = (0..masses.len()).map(|i| masses[i] * (node(&x, i) - centre).xy().norm_squared()).sum();
    assert!((mass - 125.0).abs() < 1e-10 && momentum.norm() < 1e-11 * mass, "{momentum}");
    assert!((angular.z - 4.0 * moment).abs() < 1e-10 * angular.z, "{angular} {moment}");
}

#[test]
fn the_released_bar_keeps_its_momentum_and_loses_energy() {
    let mut simulation = built(&shipped("released"));
    run(&mut *simulation, 75);
    let (mass, _, before, _) = momenta(&*simulation);
    let mut energy = simulation.energies().total();
    assert!(energy > 100.0, "{energy} J");
    // The external force has no component across its direction, so the momentum there is zero at all times.
    assert!(before.yz().norm() < 1e-9 * mass, "{before}");
    for step in 0..125 {
        run(&mut *simulation, 1);
        let after = simulation.energies().total();
        assert!(after <= energy * (1.0 + 1e-12), "step {step}: {energy} J, then {after} J");
        energy = after;
    }
    let momentum = momenta(&*simulation).2;
    assert!((momentum - before).norm() < 1e-9 * mass, "{before} {momentum}");
}

#[test]
fn the_column_under_growing_weight_ends_at_the_static_deflection() {
    let mut scene = shipped("gravity-ramp");
    let mut moving = built(&scene);
    run(&mut *moving, scene.time.steps.unwrap());
    scene.time.integrator = Integrator::Static;
    scene.damping = None;
    scene.gravity.as_mut().unwrap().curve = None;
    let mut still = built(&scene);
    run(&mut *still, 1);
    let size = (still.positions() - DVector::from_iterator(still.positions().len(), rest(&*still))).amax();
    let apart = (moving.positions() - still.positions()).amax();
    assert!(size > 0.02 && apart < 1e-3 * size, "{apart:e} of {size:e} m");
    // The base carries the weight of 0.25 m³.
    let reaction = moving.reactions()[0].force[2];
    assert!((reaction / (250.0 * 9.81) - 1.0).abs() < 1e-3, "{reaction} N");
}

fn rest(simulation: &dyn Simulation) -> Vec<f64> {
    simulation.shape().mesh.vertices().iter().flat_map(|x| [x.x, x.y, x.z]).collect()
}

#[test]
fn the_glued_column_stretches_like_two_springs_in_series() {
    let mut simulation = built(&shipped("glued"));
    run(&mut *simulation, 1);
    let (x, shape) = (simulation.positions(), simulation.shape());
    for (i, X) in shape.mesh.vertices().iter().enumerate() {
        // σ = 1000 Pa everywhere: a strain of 1 % below z = 1 m and of 5 % above.
        let expected = 0.01 * X.z.min(1.0) + 0.05 * (X.z - 1.0).max(0.0);
        let found = node(&x, i) - X;
        assert!((found - Vector3::new(0.0, 0.0, expected)).norm() < 1e-9, "node {i}: {found} {expected}");
    }
    assert_stress(&*simulation, 2);
}

#[test]
fn the_bar_of_named_groups_stretches_like_two_springs_in_series() {
    let mut simulation = built(&shipped("groups"));
    run(&mut *simulation, 1);
    let (x, shape) = (simulation.positions(), simulation.shape());
    for (i, X) in shape.mesh.vertices().iter().enumerate() {
        let expected = 0.01 * X.x.min(1.0) + 0.05 * (X.x - 1.0).max(0.0);
        let found = node(&x, i) - X;
        assert!((found - Vector3::new(expected, 0.0, 0.0)).norm() < 1e-9, "node {i}: {found} {expected}");
    }
    assert_stress(&*simulation, 0);
    let reaction = simulation.reactions()[0].force;
    assert!((reaction[0] + 250.0).abs() < 1e-6, "{reaction:?} N");
}

#[test]
fn the_cantilever_locks_as_the_warning_says() {
    for (poisson, part) in [(0.3, 0.885), (0.45, 0.750), (0.49, 0.452), (0.499, 0.104), (0.4999, 0.025)] {
        let mut scene = shipped("cantilever");
        scene.material.poisson = Some(poisson);
        let body = fem_scene::body(&scene, &data()).unwrap();
        let warnings = fem_scene::warnings(&scene, &body);
        assert_eq!(warnings.len(), usize::from(poisson > 0.45), "{warnings:?}");
        let told = format!("{part:.2} of the true distance at ν = {poisson}");
        let told = if poisson > 0.3 { format!("{part:.2} at ν = {poisson}") } else { told };
        assert!(warnings.iter().all(|text| text.contains(&told)), "{told}: {warnings:?}");
        let mut simulation = built(&scene);
        run(&mut *simulation, 1);
        let expected = cantilever::expected_tip_displacement(&body, &scene.method()).unwrap();
        let found = cantilever::tip_displacement(&*simulation).dot(&expected) / expected.norm_squared();
        assert!((found - part).abs() < 1e-3, "ν = {poisson}: {found}");
    }
}

/// The stress along the axis is 1000 Pa in every element, up to the strain of 5 % that tells Cauchy's from the engineering stress.
fn assert_stress(simulation: &dyn Simulation, axis: usize) {
    for (element, stress) in simulation.stresses().into_iter().enumerate() {
        assert!((stress[(axis, axis)] - 1000.0).abs() < 60.0, "element {element}: {stress}");
    }
}

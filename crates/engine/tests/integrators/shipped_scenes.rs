//! The engine's scenes in `data`.

use std::path::PathBuf;

use fem_engine::simulator::{build, planned_parts};
use fem_model::Integrator;
use fem_model::simulation::{Part, Simulation};
use fem_scene::{Pipeline, Scene, body, body_of_shape, load, names};

/// The repository's `data`.
pub fn data() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../../data")
}

#[test]
fn the_large_armadillo_has_as_many_nodes_and_tetrahedra_as_it_says() {
    let mesh = body(&load("arma-large", &data()).unwrap(), &data()).unwrap().shape.mesh;
    assert_eq!((mesh.vertices().len(), mesh.elements()), (21639, 107712));
}

#[test]
fn the_fine_armadillo_is_made_inside_its_surface_with_the_angles_of_isosurface_stuffing() {
    let mesh = body(&load("armadillo-fine", &data()).unwrap(), &data()).unwrap().shape.mesh;
    assert_eq!((mesh.vertices().len(), mesh.elements()), (9331, 42382));
    let [smallest, largest] = fem_mesh::quality(&mesh.mesh().unwrap()).dihedral_angles.map(|angle| angle.value);
    assert!(smallest >= 10.7 && largest <= 164.8, "{smallest} {largest}");
}

#[test]
fn the_engine_s_armadillo_differs_from_that_of_the_course_in_name_and_pipeline_alone() {
    let course = load("arma", &data()).unwrap();
    let mut engine = load("arma-engine", &data()).unwrap();
    assert_ne!(engine.pipeline, course.pipeline);
    (engine.name, engine.path, engine.about) = (course.name.clone(), course.path.clone(), course.about.clone());
    (engine.pipeline, engine.source) = (course.pipeline, course.source.clone());
    assert_eq!(engine, course);
}

fn is_large(name: &str) -> bool {
    ["arma-large", "armadillo-fine"].contains(&name)
}

/// Returns true if the engine alone can build a scene: pictures need a feature of the program.
fn is_built_here(scene: &Scene) -> bool {
    scene.pipeline == Pipeline::Engine && scene.mesh.picture.is_none() && !is_large(&scene.name)
}

#[test]
fn the_planned_parts_of_every_scene_and_method_are_those_that_are_built() {
    let scenes = names(&data()).into_iter().map(|name| load(&name, &data()).unwrap());
    for scene in scenes.filter(is_built_here) {
        let shape = body(&scene.environment(0), &data()).unwrap().shape;
        for integrator in Integrator::ALL {
            // That of a batch is the same for each of its environments.
            let mut scene = scene.environment(0);
            scene.time.integrator = integrator;
            scene.time.dt = Some(1e-3);
            scene.remove_unused_tables();
            // What an iterated method cannot be combined with is refused.
            if integrator.is_iterated() && scene.check().is_err() {
                continue;
            }
            if !scene.planes.is_empty() && scene.check().is_err() {
                continue;
            }
            let body = body_of_shape(&scene, shape.clone(), &data()).unwrap();
            // A free body has no equilibrium.
            let Ok(planned) = planned_parts(&body, &scene.method()) else {
                assert_eq!(integrator, Integrator::Static, "{}", scene.name);
                assert!(build(body, &scene.method()).is_err(), "{}", scene.name);
                continue;
            };
            let all = |parts: Vec<Part>| parts.into_iter().map(|part| (part.name, part.built, part.why));
            let simulation = build(body, &scene.method()).unwrap();
            assert!(all(planned).eq(all(simulation.parts())), "{}, {}", scene.name, integrator.name());
        }
    }
}

#[test]
fn flat_bodies_from_pictures_move_as_their_scenes_say_to_the_end() {
    for (name, triangles) in [("donut-glued", 850..1050), ("gear", 2000..2600)] {
        let scene = load(name, &data()).unwrap();
        let body = body(&scene, &data()).unwrap();
        assert!(triangles.contains(&body.shape.mesh.elements()), "{name}: {}", body.shape.mesh.elements());
        let mut simulation = build(body, &scene.method()).unwrap_or_else(|error| panic!("{name}: {error}"));
        let start = simulation.positions();
        let mut farthest = 0.0_f64;
        for step in 1..=scene.time.steps.unwrap() {
            simulation.step().unwrap_or_else(|failure| panic!("{name}, step {step}: {failure}"));
            let q = simulation.positions();
            farthest = farthest.max(q.iter().zip(&start).map(|(x, rest)| (x - rest).abs()).fold(0.0, f64::max));
        }
        assert_eq!(simulation.counters().unconverged_steps, 0, "{name}");
        assert!(simulation.min_J().0 > 0.1 && farthest > 0.1 && farthest < 1.0, "{name}: {farthest} m");
    }
}

/// Runs a scene to its end; every step converges.
fn ended(name: &str) -> Box<dyn Simulation> {
    let scene = load(name, &data()).unwrap();
    let body = body(&scene, &data()).unwrap();
    let mut simulation = build(body, &scene.method()).unwrap_or_else(|error| panic!("{name}: {error}"));
    for step in 1..=scene.time.steps.unwrap() {
        simulation.step().unwrap_or_else(|failure| panic!("{name}, step {step}: {failure}"));
    }
    assert_eq!(simulation.counters().unconverged_steps, 0, "{name}");
    simulation
}

#[test]
fn dropped_bodies_end_on_the_planes_which_carry_their_weight() {
    for name in ["donut", "armadillo-flat", "bunny-flat", "triangle", "square", "one-triangle"] {
        let simulation = ended(name);
        let area: f64 = simulation.shape().mesh.volumes().iter().sum();
        let weight = 140.5 * 9.81 * area;
        let carried: f64 = simulation.contacts().iter().map(|contact| contact.force[1]).sum();
        assert!((carried - weight).abs() < 0.01 * weight, "{name}: {carried} of {weight} N");
        assert!(simulation.contacts().iter().all(|contact| contact.smallest_gap > 0.0), "{name}");
        // The donut still rolls.
        assert!(simulation.velocities().amax() < 0.1, "{name}: {} m/s", simulation.velocities().amax());
    }
}

#[test]
fn the_pressed_block_keeps_a_dent_and_its_volume_after_its_release() {
    let simulation = ended("press");
    let q = simulation.positions();
    let heights = q.iter().skip(1).step_by(3);
    let (low, high) = heights.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), y| (y.min(a), y.max(b)));
    // Squashed to 0.6 m, it springs back by its elastic strain alone.
    assert!((0.62..0.8).contains(&(high - low)), "{} m high", high - low);
    let flow = simulation.plastic_flow().unwrap();
    assert!(flow.largest_strain() > 0.3 && flow.dissipated > 1e3, "{} {}", flow.largest_strain(), flow.dissipated);
    assert!(simulation.contacts()[1].force[1].abs() < 1.0, "{:?}", simulation.contacts());
    let volume: f64 = simulation
        .shape()
        .mesh
        .corners()
        .map(|corners| {
            let x = |i: usize| nalgebra::Vector3::new(q[3 * corners[i]], q[3 * corners[i] + 1], q[3 * corners[i] + 2]);
            (x(1) - x(0)).cross(&(x(2) - x(0))).dot(&(x(3) - x(0))) / 6.0
        })
        .sum();
    assert!((volume - 1.0).abs() < 0.01, "{volume} m³");
}

//! Forces of elements on a device beside those on the processor, for random deformations of each element by itself.

use fem_engine::simulator::{Compiled, Simulator};
use fem_gpu::{Bodies, Body, Device, Environment, Law, Method, Number, Scheme, Tetrahedra};
use fem_mesh::TetrahedralMesh;
use fem_scene::parse;
use nalgebra::{Matrix3, Vector3};
use rand::{RngExt, SeedableRng};

const SCENE: &str = r#"pipeline = "engine"
[mesh]
box = { size = [3, 2, 2], cells_per_unit = 1 }
[material]
model = "MODEL"
young = 1e5
poisson = 0.35
density = 1000
[mass]
lumped = true
[time]
dt = 0.001
integrator = "semi_implicit_euler"
"#;

/// The laws of the device, by their names and with their parameters for the scene's moduli.
pub(crate) fn device_laws() -> [(&'static str, Law, [f64; 2]); 5] {
    let (E, nu): (f64, f64) = (1e5, 0.35);
    let lame = [E / (2.0 * (1.0 + nu)), E * nu / ((1.0 + nu) * (1.0 - 2.0 * nu))];
    let neo_hookean = [E / (4.0 * (1.0 + nu)), E / (6.0 * (1.0 - 2.0 * nu))];
    [
        ("linear", Law::Linear, lame),
        ("corotated", Law::Corotated, lame),
        ("st_venant_kirchhoff", Law::StVenantKirchhoff, lame),
        ("stable_neo_hookean", Law::StableNeoHookean, lame),
        ("neo_hookean", Law::NeoHookean, neo_hookean),
    ]
}

/// The elements of the scene's box, each with four nodes of its own.
fn parted(model: &str) -> (fem_scene::Scene, fem_model::Body) {
    let scene = parse(&SCENE.replace("MODEL", model), "parted.toml".as_ref()).unwrap();
    let whole = fem_scene::body(&scene, "no data".as_ref()).unwrap();
    let mut mesh: TetrahedralMesh = whole.shape.mesh.mesh().unwrap();
    mesh.vertices = mesh.elements.iter().flatten().map(|&node| mesh.vertices[node]).collect();
    for (number, element) in mesh.elements.iter_mut().enumerate() {
        *element = [0, 1, 2, 3].map(|corner| 4 * number + corner);
    }
    let body = fem_scene::body_of(&scene, mesh, "no data".as_ref()).unwrap();
    (scene, body)
}

/// The same elements as arrays, in the mesh's numbering.
pub(crate) fn tetrahedra(body: &fem_model::Body) -> Tetrahedra {
    let mesh = &body.shape.mesh;
    let mut arrays = Tetrahedra::default();
    for element in mesh.tetrahedra() {
        let x = element.map(|node| mesh.vertices()[node]);
        let edges = Matrix3::from_columns(&[x[1] - x[0], x[2] - x[0], x[3] - x[0]]);
        let inverse = edges.try_inverse().unwrap();
        arrays.corners.push(element.map(|node| node as u32));
        arrays.gradients.push([0, 1, 2].map(|row| [0, 1, 2].map(|column| inverse[(row, column)])));
        arrays.volumes.push(edges.determinant().abs() / 6.0);
    }
    arrays
}

/// Displacements up to an amplitude (m) under which each element has more than so much of its volume.
fn displacements(body: &fem_model::Body, amplitude: f64, least: f64) -> Vec<[f64; 3]> {
    let mut random = rand::rngs::ChaCha8Rng::seed_from_u64(7);
    let mesh = &body.shape.mesh;
    let mut u = vec![[0.0; 3]; mesh.vertices().len()];
    for element in 0..mesh.elements() {
        loop {
            for node in &mut u[4 * element..4 * element + 4] {
                // Numbers that single precision has.
                *node = [0, 1, 2].map(|_| f64::from((amplitude * random.random_range(-1.0..1.0)) as f32));
            }
            let G = mesh.displacement_gradient(element, |node| Vector3::from(u[node]));
            if (Matrix3::identity() + G).determinant() > least {
                break;
            }
        }
    }
    u
}

/// Largest difference of a force from that on the processor, as a part of the largest force on the element.
fn error<T: Compiled, N: Number>(device: &std::sync::Arc<Device>, law: usize, (amplitude, least): (f64, f64)) -> f64 {
    let (name, law, moduli) = device_laws()[law];
    let (scene, body) = parted(name);
    let u = displacements(&body, amplitude, least);
    let method = Method { scheme: Scheme::SemiImplicitEuler, dt: 1e-3, alpha: 0.0 };
    let environments = [Environment { moduli, weight: 1.0, density: 1.0 }; 3];
    let nodes = u.len();
    let arrays = Body {
        tetrahedra: tetrahedra(&body),
        inverse_masses: vec![[1.0; 3]; nodes],
        weights: vec![[0.0; 3]; nodes],
        loads: vec![[0.0; 3]; nodes],
        velocities: Vec::new(),
    };
    let mut bodies = Bodies::<N>::new(device, &arrays, law, &method, &environments).unwrap();
    bodies.set_state(1, &u, &vec![[0.0; 3]; u.len()]).unwrap();
    let found = bodies.elastic_forces(1).unwrap();
    assert!(bodies.elastic_forces(2).unwrap().iter().flatten().all(|force| force.as_f64() == 0.0), "{name}: at rest");
    let simulator = Simulator::<T>::new(body, &scene.method()).unwrap();
    let system = simulator.system();
    let in_order: Vec<[T; 3]> = system.numbering.mesh_node.iter().map(|&node| u[node as usize].map(T::of)).collect();
    let mut gradient = vec![[T::default(); 3]; u.len()];
    system.elements.add_gradient(&in_order, &mut gradient);
    let expected = system.numbering.to_mesh(&gradient);
    let mut worst: f64 = 0.0;
    for (expected, found) in expected.chunks(4).zip(found.chunks(4)) {
        let size = expected.iter().flatten().fold(0.0, |size: f64, force| size.max(force.as_f64().abs()));
        for (expected, found) in expected.iter().flatten().zip(found.iter().flatten()) {
            worst = worst.max((expected.as_f64() + found.as_f64()).abs() / size);
        }
    }
    println!("{name}, {amplitude} m, {}: {worst:.1e}", N::WGSL);
    worst
}

#[test]
fn forces_of_every_law_are_those_of_the_processor() {
    let device = match Device::open() {
        Ok(device) => device,
        Err(error) => return println!("skipped: {error}"),
    };
    for law in 0..device_laws().len() {
        for displacements in [(0.3, 0.1), (1e-4, 0.1)] {
            assert!(error::<f32, f32>(&device, law, displacements) < 1e-5);
            if device.has_double_precision() {
                assert!(error::<f64, f64>(&device, law, displacements) < 1e-12);
            } else {
                println!("skipped: no double precision");
            }
        }
    }
}

/// Of the corotated law this includes rotations that the closed form does not give.
#[test]
fn forces_of_inverted_elements_are_those_of_the_processor() {
    let device = match Device::open() {
        Ok(device) if device.has_double_precision() => device,
        Ok(_) => return println!("skipped: no double precision"),
        Err(error) => return println!("skipped: {error}"),
    };
    for law in (0..device_laws().len()).filter(|&law| device_laws()[law].1 != Law::NeoHookean) {
        assert!(error::<f64, f64>(&device, law, (2.0, f64::NEG_INFINITY)) < 1e-9);
    }
}

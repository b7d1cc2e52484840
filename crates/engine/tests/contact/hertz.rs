//! Hertz's contact of a cylinder with a rigid plane: Johnson, Contact Mechanics (1985), section 4.2.

use fem_engine::simulator::Simulator;
use fem_mesh::SurfaceMesh;
use fem_scene::BodyMesh;
use fem_scene::simulation::Simulation;
use nalgebra::Vector3;

use crate::{floor, run, scene, text};

/// Half-width of the contact that the mesh is made for, m; the cylinder has a radius of 1 m.
const WIDTH: f64 = 0.06;

/// Distances from 0 to 1, of `h` up to 1.5 widths, then growing.
fn graded(h: f64) -> Vec<f64> {
    let (mut x, mut step, mut all) = (0.0, h, vec![0.0]);
    while x < 1.0 {
        if x > 1.5 * WIDTH {
            step *= 1.25;
        }
        x += step;
        all.push(x);
    }
    let end = x;
    // The last of them is 1; those of the fine part stay.
    let squeeze = |x: f64| {
        if x <= 1.5 * WIDTH { x } else { 1.5 * WIDTH + (x - 1.5 * WIDTH) * (1.0 - 1.5 * WIDTH) / (end - 1.5 * WIDTH) }
    };
    all.into_iter().map(squeeze).collect()
}

/// A quarter of a disc about (0, 1), fine where it touches the floor y = 0.
fn quarter(h: f64) -> SurfaceMesh {
    let (depths, angles) = (graded(h), graded(h));
    let rings = depths.len() - 1;
    let mut vertices = vec![Vector3::new(0.0, 1.0, 0.0)];
    for depth in &depths[..rings] {
        for part in &angles {
            // Arc lengths near the contact, a right angle at the end.
            let angle = part + (std::f64::consts::FRAC_PI_2 - 1.0) * part.powi(4);
            let radius = 1.0 - depth;
            vertices.push(Vector3::new(radius * angle.sin(), 1.0 - radius * angle.cos(), 0.0));
        }
    }
    let node = |ring: usize, place: usize| 1 + ring * angles.len() + place;
    let mut triangles = Vec::new();
    for place in 0..angles.len() - 1 {
        for ring in 0..rings - 1 {
            let [a, b, c, d] =
                [node(ring, place), node(ring, place + 1), node(ring + 1, place + 1), node(ring + 1, place)];
            triangles.extend([[a, b, c], [a, c, d]]);
        }
        triangles.push([node(rings - 1, place), node(rings - 1, place + 1), 0]);
    }
    // The symmetry plane is exact.
    vertices.iter_mut().filter(|x| x.x.abs() < 1e-12).for_each(|x| x.x = 0.0);
    SurfaceMesh::new(vertices, triangles)
}

/// Half-width of the contact by the second moment of the pressure, and by Hertz's formula from the force; m.
fn widths(h: f64) -> [f64; 2] {
    let tables = "[newton]\ntolerance = 1e-12\n[static]\nload_steps = 4\n\
         [[prescribed]]\non = { axis = \"x\", side = \"min\", within = 1e-9 }\ndisplacement = [0, 0, 0]\ncomponents = [\"x\"]\n\
         [[prescribed]]\non = { axis = \"y\", side = \"max\", within = 1e-9 }\ndisplacement = [0, -0.0063, 0]\ncomponents = [\"y\"]\n\
         [contact]\nactivation_distance = 1e-5\n"
        .to_owned()
        + &floor(-1e-6, "");
    let scene =
        scene(&text("rectangle = { size = [1, 1], cells_per_unit = 1 }", "linear", 1e7, "static", 1.0, &tables));
    let mesh = BodyMesh::Flat { triangles: quarter(h), thickness: 1.0 };
    let body = fem_scene::body_of(&scene, mesh, "no data".as_ref()).unwrap();
    let mut simulation = Simulator::<f64>::new(&scene, body).unwrap();
    run(&mut simulation, 4);
    assert_eq!(simulation.counters().unconverged_steps, 0);
    let force = 2.0 * simulation.contacts()[0].force[1];
    let modulus = 1e7 / (1.0 - 0.09);
    let expected = (4.0 * force / (std::f64::consts::PI * modulus)).sqrt();
    // Undeformed places, as in the theory of small strain: the contact contracts by 2 %.
    let (shape, forces) = (simulation.shape(), simulation.contact_forces().unwrap());
    let nodes = shape.mesh.vertices().iter().zip(forces.as_slice().chunks(3));
    let moment: f64 = nodes.map(|(x, force)| x.x * x.x * force[1]).sum();
    // ∫ x² p dx = F a²/4 for p = p₀ √(1 − x²/a²).
    [2.0 * (moment / (0.5 * force)).sqrt(), expected]
}

#[test]
fn the_contact_of_a_cylinder_is_as_wide_as_hertz_says() {
    let [found, expected] = widths(WIDTH / 8.0);
    assert!((expected - WIDTH).abs() < 0.2 * WIDTH, "the mesh is made for {WIDTH} m and not for {expected}");
    let error = |[found, expected]: [f64; 2]| (found - expected).abs() / expected;
    let (coarse, fine) = (error([found, expected]), error(widths(WIDTH / 16.0)));
    assert!(coarse < 0.03 && fine < coarse, "errors {coarse} and {fine} with 8 and 16 elements on a half-width");
}

//! Hertz's contact of a cylinder and of a ball with a rigid plane: Johnson, Contact Mechanics (1985), sections 4.2 and 4.3.

use std::f64::consts::{FRAC_PI_2, PI};

use fem_engine::simulator::Simulator;
use fem_mesh::{Pattern, SurfaceMesh, TetrahedralMesh, box_mesh};
use fem_model::Axis::{X, Y, Z};
use fem_model::simulation::{Diagnostics, Simulation};
use fem_model::{Body, BodyMesh, Contact, ContactPlane, Integrator, Method, NewtonSettings, Selector};
use nalgebra::Vector3;

use crate::scenes::{displaced, material, simulator, steps};
use crate::study::Result;

/// A body above a plane y = −`floor`, m, which acts from 1e-5 m on, in so many load steps to a tolerance of Newton's method.
fn pressed(body: Body, floor: f64, tolerance: f64, load_steps: usize) -> Result<Simulator<f64>> {
    let newton = NewtonSettings { tolerance: Some(tolerance), ..NewtonSettings::default() };
    let method = Method { load_steps, newton, ..Method::new(Integrator::Static, 1.0) };
    let plane = ContactPlane::new(Vector3::new(0.0, -floor, 0.0), Vector3::y());
    let contact = Contact { activation_distance: 1e-5, ..body.contact_with(vec![plane], &method)? };
    Ok(simulator(Body { contact: Some(contact), ..body }, &method)?)
}

/// Half-width of the contact that the mesh is made for, m; the cylinder has a radius of 1 m.
pub const WIDTH: f64 = 0.06;

/// Distances from 0 to 1 in steps of `h` up to `fine`, which then grow by `growth`.
fn graded(h: f64, fine: f64, growth: f64) -> Vec<f64> {
    let (mut x, mut step, mut all) = (0.0, h, vec![0.0]);
    while x < 1.0 {
        if x > fine {
            step *= growth;
        }
        x += step;
        all.push(x);
    }
    let end = x;
    // The last of them is 1; those of the fine part stay.
    let squeeze = |x: f64| if x <= fine { x } else { fine + (x - fine) * (1.0 - fine) / (end - fine) };
    all.into_iter().map(squeeze).collect()
}

/// A quarter of a disc about (0, 1), fine where it touches the floor y = 0.
fn quarter(h: f64) -> SurfaceMesh {
    let depths = graded(h, 1.5 * WIDTH, 1.25);
    let angles = depths.clone();
    let rings = depths.len() - 1;
    let mut vertices = vec![Vector3::new(0.0, 1.0, 0.0)];
    for depth in &depths[..rings] {
        for part in &angles {
            // Arc lengths near the contact, a right angle at the end.
            let angle = part + (FRAC_PI_2 - 1.0) * part.powi(4);
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

/// Half-width of the contact by the second moment of the pressure, and by Hertz's formula from the force, with elements of `h`; m.
pub fn widths(h: f64) -> Result<[f64; 2]> {
    let body = Body::new(BodyMesh::flat(quarter(h), 1.0), material("linear", 1e7, 0.3, 1000.0)?)?;
    let body = displaced(body, &Selector::least(X), X, 0.0)?;
    let body = displaced(body, &Selector::most(Y), Y, -0.0063)?;
    let mut simulation = pressed(body, 1e-6, 1e-12, 4)?;
    steps(&mut simulation, 4)?;
    let force = 2.0 * simulation.contacts()[0].force[1];
    let modulus = 1e7 / (1.0 - 0.09);
    let expected = (4.0 * force / (PI * modulus)).sqrt();
    // Undeformed places, as in the theory of small strain: the contact contracts by 2 %.
    let (shape, forces) = (simulation.shape(), simulation.contact_forces().ok_or("the cylinder has no contact")?);
    let nodes = shape.mesh.vertices().iter().zip(forces.as_slice().chunks(3));
    let moment: f64 = nodes.map(|(x, force)| x.x * x.x * force[1]).sum();
    // ∫ x² p dx = F a²/4 for p = p₀ √(1 − x²/a²).
    Ok([2.0 * (moment / (0.5 * force)).sqrt(), expected])
}

/// Radius of the contact that the mesh is made for, and of the ball, m.
pub const RADIUS: f64 = 0.04;
const BALL: f64 = 4.0;
/// Young's modulus, Pa, and Poisson's ratio.
const YOUNG: f64 = 1e7;
const POISSON: f64 = 0.3;
/// Height of the plane below the undeformed ball, m.
const FLOOR: f64 = 1e-7;
/// Growth of the elements beyond the contact.
const GROWTH: f64 = 1.5;
const LOAD_STEPS: usize = 2;
/// Depth of the point that stands for the distant ones, in contact radii.
const DISTANT: f64 = 8.0;

/// Found and by Hertz.
pub struct Hertz {
    /// Force at the approach d: 4/3 E* √R d^1.5, N.
    pub force: [f64; 2],
    /// Radius of the contact at the force F: (3 F R/(4 E*))^(1/3), m; found by the second moment of the pressure.
    pub radius: [f64; 2],
    /// Number of nodes.
    pub nodes: usize,
}

/// Presses a quarter of a block of 2 × 1 × 2 m whose lower side is a ball onto a plane, with elements of `h` (m) at the contact.
///
/// Hertz's bodies are half-spaces, and the approach is that of their distant points. A block of 25 contact radii is too small for its
/// upper side to be distant: the force would be 4 % too large. So the approach is that of a point on the axis at about 8 radii, and the
/// displacement of that point in a half-space under the same force, Boussinesq's, is added to it.
pub fn contact(h: f64) -> Result<Hertz> {
    let depth = RADIUS * RADIUS / BALL;
    let body = Body::new(block(h)?, material("linear", YOUNG, POISSON, 1000.0)?)?;
    let body = displaced(body, &Selector::least(X), X, 0.0)?;
    let body = displaced(body, &Selector::least(Z), Z, 0.0)?;
    let body = displaced(body, &Selector::most(Y), Y, -depth)?;
    let mut simulation = pressed(body, FLOOR, 1e-9, LOAD_STEPS)?;
    steps(&mut simulation, LOAD_STEPS)?;
    let contact = &simulation.contacts()[0];
    let support = simulation.reactions()[2].force[1];
    if !((contact.force[1] + support).abs() < 1e-3 * contact.force[1]) {
        return Err(format!("the plane carries {} N and the support {support} N", contact.force[1]).into());
    }
    let (force, modulus) = (4.0 * contact.force[1], YOUNG / (1.0 - POISSON * POISSON));
    // The plane acts at the distance of the barrier.
    let approach = contact.smallest_gap - FLOOR - distant_displacement(&simulation, force)?;
    let (shape, forces) = (simulation.shape(), simulation.contact_forces().ok_or("the ball has no contact")?);
    let nodes = shape.mesh.vertices().iter().zip(forces.as_slice().chunks(3));
    let moment: f64 = nodes.map(|(x, force)| (x.x * x.x + x.z * x.z) * force[1]).sum();
    Ok(Hertz {
        nodes: forces.len() / 3,
        force: [force, 4.0 / 3.0 * modulus * BALL.sqrt() * approach.powf(1.5)],
        // ∫ r² p dA = 2 F a²/5 for p = p₀ √(1 − r²/a²).
        radius: [(2.5 * moment / contact.force[1]).sqrt(), (0.75 * force * BALL / modulus).cbrt()],
    })
}

/// Upward displacement of the distant points of a half-space, m: that of a point on the axis, less Boussinesq's under a force (N),
/// F (1 + ν) (3 − 2ν)/(2π E y).
fn distant_displacement(simulation: &Simulator<f64>, force: f64) -> Result<f64> {
    let (shape, q) = (simulation.shape(), simulation.positions());
    let on_axis = shape.mesh.vertices().iter().enumerate().filter(|(_, x)| x.x == 0.0 && x.z == 0.0);
    let far = |x: &Vector3<f64>| (x.y - DISTANT * RADIUS).abs();
    let node = on_axis.min_by(|(_, a), (_, b)| far(a).total_cmp(&far(b)));
    let (node, x) = node.ok_or("the ball has no axis")?;
    let boussinesq = force * (1.0 + POISSON) * (3.0 - 2.0 * POISSON) / (2.0 * PI * YOUNG * x.y);
    Ok(q[3 * node + 1] - x.y - boussinesq)
}

/// A quarter of the block about the y axis, whose lower side y = R − √(R² − x² − z²) is fine near the origin.
fn block(h: f64) -> Result<TetrahedralMesh> {
    let places = graded(h, 1.3 * RADIUS, GROWTH);
    let cells = places.len() - 1;
    let mut mesh = box_mesh([1.0; 3], cells, Pattern::Kuhn)?;
    let place = |x: f64| places[((x * cells as f64).round() as usize).min(cells)];
    for vertex in &mut mesh.vertices {
        let [x, t, z] = [vertex.x, vertex.y, vertex.z].map(place);
        let bottom = BALL - (BALL * BALL - x * x - z * z).sqrt();
        *vertex = Vector3::new(x, bottom + t * (1.0 - bottom), z);
    }
    Ok(mesh)
}

//! Hertz's contact of a ball with a rigid plane: Johnson, Contact Mechanics (1985), section 4.3.

use std::f64::consts::PI;

use fem_engine::simulator::Simulator;
use fem_mesh::{Pattern, TetrahedralMesh, box_mesh};
use fem_model::BodyMesh;
use fem_model::simulation::{Diagnostics, Simulation};
use nalgebra::Vector3;

use super::cylinder::graded;
use crate::scenes::{double, steps};

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
pub fn contact(h: f64) -> Result<Hertz, String> {
    let depth = RADIUS * RADIUS / BALL;
    let side = |axis: &str, side: &str, u: f64| {
        let u = if axis == "y" { u } else { 0.0 };
        format!(
            "[[prescribed]]\non = {{ axis = \"{axis}\", side = \"{side}\", within = 1e-9 }}\ndisplacement = [0, {u:e}, 0]\ncomponents = [\"{axis}\"]\n"
        )
    };
    let text = format!(
        "pipeline = \"engine\"\n[mesh]\nbox = {{ size = [1, 1, 1], cells_per_unit = 1 }}\n[material]\nmodel = \"linear\"\nyoung = {YOUNG:e}\n\
         poisson = {POISSON}\ndensity = 1000\n[time]\nintegrator = \"static\"\n[newton]\ntolerance = 1e-9\n[static]\nload_steps = {LOAD_STEPS}\n\
         {}{}{}[contact]\nactivation_distance = 1e-5\n[[planes]]\npoint = [0, {:e}, 0]\nnormal = [0, 1, 0]\n",
        side("x", "min", 0.0),
        side("z", "min", 0.0),
        side("y", "max", -depth),
        -FLOOR
    );
    let mut simulation = double(&text, Some(BodyMesh::solid(block(h)?)))?;
    steps(&mut simulation, LOAD_STEPS)?;
    let contact = &simulation.contacts()[0];
    let support = simulation.reactions()[2].force[1];
    if !((contact.force[1] + support).abs() < 1e-3 * contact.force[1]) {
        return Err(format!("the plane carries {} N and the support {support} N", contact.force[1]));
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
fn distant_displacement(simulation: &Simulator<f64>, force: f64) -> Result<f64, String> {
    let (shape, q) = (simulation.shape(), simulation.positions());
    let on_axis = shape.mesh.vertices().iter().enumerate().filter(|(_, x)| x.x == 0.0 && x.z == 0.0);
    let far = |x: &Vector3<f64>| (x.y - DISTANT * RADIUS).abs();
    let node = on_axis.min_by(|(_, a), (_, b)| far(a).total_cmp(&far(b)));
    let (node, x) = node.ok_or("the ball has no axis")?;
    let boussinesq = force * (1.0 + POISSON) * (3.0 - 2.0 * POISSON) / (2.0 * PI * YOUNG * x.y);
    Ok(q[3 * node + 1] - x.y - boussinesq)
}

/// A quarter of the block about the y axis, whose lower side y = R − √(R² − x² − z²) is fine near the origin.
fn block(h: f64) -> Result<TetrahedralMesh, String> {
    let places = graded(h, 1.3 * RADIUS, GROWTH);
    let cells = places.len() - 1;
    let mut mesh = box_mesh([1.0; 3], cells, Pattern::Kuhn).map_err(|error| error.to_string())?;
    let place = |x: f64| places[((x * cells as f64).round() as usize).min(cells)];
    for vertex in &mut mesh.vertices {
        let [x, t, z] = [vertex.x, vertex.y, vertex.z].map(place);
        let bottom = BALL - (BALL * BALL - x * x - z * z).sqrt();
        *vertex = Vector3::new(x, bottom + t * (1.0 - bottom), z);
    }
    Ok(mesh)
}

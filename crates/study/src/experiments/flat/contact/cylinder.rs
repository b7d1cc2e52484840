//! Hertz's contact of a cylinder with a rigid plane: Johnson, Contact Mechanics (1985), section 4.2.

use fem_mesh::SurfaceMesh;
use fem_model::BodyMesh;
use fem_model::simulation::{Diagnostics, Simulation};
use nalgebra::Vector3;

use crate::scenes::{double, steps};

/// Half-width of the contact that the mesh is made for, m; the cylinder has a radius of 1 m.
pub const WIDTH: f64 = 0.06;

/// Distances from 0 to 1 in steps of `h` up to `fine`, which then grow by `growth`.
pub(super) fn graded(h: f64, fine: f64, growth: f64) -> Vec<f64> {
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

/// Half-width of the contact by the second moment of the pressure, and by Hertz's formula from the force, with elements of `h`; m.
pub fn widths(h: f64) -> Result<[f64; 2], String> {
    let text = "pipeline = \"engine\"\n[mesh]\nrectangle = { size = [1, 1], cells_per_unit = 1 }\n[material]\nmodel = \"linear\"\nyoung = 1e7\n\
         poisson = 0.3\ndensity = 1000\n[time]\nintegrator = \"static\"\n[newton]\ntolerance = 1e-12\n[static]\nload_steps = 4\n\
         [[prescribed]]\non = { axis = \"x\", side = \"min\", within = 1e-9 }\ndisplacement = [0, 0, 0]\ncomponents = [\"x\"]\n\
         [[prescribed]]\non = { axis = \"y\", side = \"max\", within = 1e-9 }\ndisplacement = [0, -0.0063, 0]\ncomponents = [\"y\"]\n\
         [contact]\nactivation_distance = 1e-5\n[[planes]]\npoint = [0, -1e-6, 0]\nnormal = [0, 1, 0]\n";
    let mesh = BodyMesh::flat(quarter(h), 1.0);
    let mut simulation = double(text, Some(mesh))?;
    steps(&mut simulation, 4)?;
    let force = 2.0 * simulation.contacts()[0].force[1];
    let modulus = 1e7 / (1.0 - 0.09);
    let expected = (4.0 * force / (std::f64::consts::PI * modulus)).sqrt();
    // Undeformed places, as in the theory of small strain: the contact contracts by 2 %.
    let (shape, forces) = (simulation.shape(), simulation.contact_forces().ok_or("the cylinder has no contact")?);
    let nodes = shape.mesh.vertices().iter().zip(forces.as_slice().chunks(3));
    let moment: f64 = nodes.map(|(x, force)| x.x * x.x * force[1]).sum();
    // ∫ x² p dx = F a²/4 for p = p₀ √(1 − x²/a²).
    Ok([2.0 * (moment / (0.5 * force)).sqrt(), expected])
}

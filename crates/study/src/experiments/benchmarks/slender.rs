//! Slender beams of tetrahedra: R. H. MacNeal and R. L. Harder, A Proposed Standard Set of Problems to Test Finite Element Accuracy (1985).
//!
//! One end is fixed, and a unit force is spread over the other. The displacement is the work of the force, which is twice the elastic energy.

use std::collections::BTreeMap;
use std::f64::consts::FRAC_PI_2;
use std::path::Path;

use fem_model::{Body, Elastic, Law, Material, Refusal, Selector};
use nalgebra::{Rotation3, Vector3};

use super::case::{Level, Mapped, Quantity, equilibrium, part, supported};
use crate::study::{Part, Result};

const SOLID: &str = "27-node hexahedra";

fn quantity(name: &'static str, reference: f64, source: &'static str) -> Quantity {
    Quantity { name, reference, tolerance: 1e-2, source }
}

/// 6 × 0.2 × 0.1, E = 1e7, ν = 0.3.
pub fn straight(_: &Path, quick: bool) -> Result<Part> {
    let of = [
        quantity("along (m)", 3.0e-5, "beam theory; 2.996e-5 with 27-node hexahedra"),
        quantity("in the plane (m)", 0.1081, "beam theory; 0.1077 with 27-node hexahedra"),
        quantity("out of the plane (m)", 0.4321, "beam theory; 0.4304 with 27-node hexahedra"),
        quantity("about its axis (rad)", 0.03406, "27-node hexahedra; Saint-Venant 0.0341"),
    ];
    let text = "A beam of 6 × 0.2 × 0.1 m, E = 10 MPa, ν = 0.3, with a unit force along, in and out of its plane, and with a unit torque T, the traction T r/I_p on its end. The value \
                0.03208 of the paper for the torque (from memory) is 6 % off Saint-Venant's and not used.";
    part(("mh-straight", text), &of, (&[1, 2, 3], 2), quick, |cells| {
        let mapped = |cells| Mapped::cube(cells, |x| x.component_mul(&Vector3::new(6.0, 0.2, 0.1)));
        let mut level = bent(
            || mapped([24 * cells, 2 * cells, cells]),
            (1e7, 0.3),
            0.02,
            &[Vector3::x(), Vector3::y(), Vector3::z()],
        )?;
        // The warping of the section needs more cells across.
        let across = mapped([8 * cells, 4 * cells, 2 * cells])?;
        let (rotation, seconds) = solve(across, (1e7, 0.3), |body, _| torque(body, 6.0, [0.2, 0.1]))?;
        level.values.push(rotation);
        level.seconds += seconds;
        Ok(level)
    })
}

/// A quarter of a circle with radii of 4.12 and 4.32, 0.1 thick, E = 1e7, ν = 0.25.
pub fn curved(_: &Path, quick: bool) -> Result<Part> {
    let of = [quantity("radial (m)", 0.0885, SOLID), quantity("out of the plane (m)", 0.4978, SOLID)];
    let text = "A quarter of a circle, radii of 4.12 and 4.32 m, 0.1 m thick, E = 10 MPa, ν = 0.25. Beam theory, 0.0873 and 0.5022, is 1 % off for so thick a beam.";
    part(("mh-curved", text), &of, (&[1, 2, 3], 2), quick, |cells| {
        let mapped = || {
            Mapped::cube([24 * cells, 2 * cells, cells], |x| {
                let (radius, (sin, cos)) = (4.12 + 0.2 * x.y, (FRAC_PI_2 * x.x).sin_cos());
                Vector3::new(radius * sin, radius * cos, 0.1 * x.z)
            })
        };
        bent(mapped, (1e7, 0.25), 0.02, &[Vector3::x(), Vector3::z()])
    })
}

/// 12 long, 1.1 × 0.32, turned by 90° from end to end, E = 29e6, ν = 0.22.
pub fn twisted(_: &Path, quick: bool) -> Result<Part> {
    let of = [
        quantity("along the tip's long side (m)", 0.005421, "27-node hexahedra; 0.005425, Zupan and Saje (2004)"),
        quantity("along its short side (m)", 0.001753, "27-node hexahedra; 0.001753, Zupan and Saje (2004)"),
    ];
    let text = "A beam of 12 × 1.1 × 0.32 m that is turned by 90° from end to end, E = 29 MPa, ν = 0.22.";
    part(("mh-twisted", text), &of, (&[1, 2, 3], 2), quick, |cells| {
        let mapped = || {
            Mapped::cube([12 * cells, 2 * cells, cells], |x| {
                let section = Vector3::new(12.0 * x.x, 1.1 * (x.y - 0.5), 0.32 * (x.z - 0.5));
                Rotation3::from_axis_angle(&Vector3::x_axis(), FRAC_PI_2 * x.x) * section
            })
        };
        bent(mapped, (29e6, 0.22), 1.1 * 0.32, &[Vector3::z(), Vector3::y()])
    })
}

/// Displacements of the end, whose area is given (m²), along unit forces on it.
fn bent(mapped: impl Fn() -> Result<Mapped>, moduli: (f64, f64), area: f64, forces: &[Vector3<f64>]) -> Result<Level> {
    let mut level = Level { nodes: 0, values: Vec::new(), seconds: 0.0 };
    for force in forces {
        let mapped = mapped()?;
        level.nodes = mapped.places.len();
        let (displacement, seconds) =
            solve(mapped, moduli, |body, end| body.traction(&Selector::Nodes(end), (force / area).into()))?;
        level.seconds += seconds;
        level.values.push(displacement);
    }
    Ok(level)
}

/// Work of a unit load on the nodes of the end, and the time of the solution.
fn solve(
    Mapped { mesh, places }: Mapped,
    (young, poisson): (f64, f64),
    load: impl Fn(Body, Vec<usize>) -> Result<Body, Refusal>,
) -> Result<(f64, f64)> {
    let end = (0..places.len()).filter(|&node| places[node].x == 1.0).collect();
    let material = Material::new(Law::Linear(Elastic::new(young, poisson)), 1.0);
    let body = supported(mesh, material, &places, |place| [place.x == 0.0; 3])?;
    let body = load(body, end)?;
    let (simulation, seconds) = equilibrium(body, 1)?;
    Ok((-2.0 * simulation.energies().potential, seconds))
}

/// Loads the end x = `length` of a rectangular section with the traction e × r/I_p, a unit torque.
fn torque(mut body: Body, length: f64, [width, height]: [f64; 2]) -> Result<Body, Refusal> {
    let polar = width * height * (width * width + height * height) / 12.0;
    let mut forces = BTreeMap::<usize, Vector3<f64>>::new();
    let x = body.shape.mesh.vertices();
    for face in body.shape.faces().iter().filter(|face| face.iter().all(|&node| x[node].x == length)) {
        let traction = |k: usize| {
            let x = x[face[k]];
            Vector3::new(0.0, 0.5 * height - x.z, x.y - 0.5 * width) / polar
        };
        let area = body.shape.mesh.area(face);
        // ∫ N t of a linear traction on a quadratic triangle.
        for k in 0..3 {
            let [t, next, last] = [k, (k + 1) % 3, (k + 2) % 3].map(traction);
            *forces.entry(face[k]).or_default() += area / 60.0 * (2.0 * t - next - last);
            *forces.entry(face[3 + k]).or_default() += area / 15.0 * (2.0 * (t + next) + last);
        }
    }
    for (node, force) in forces {
        body = body.force(&Selector::Nodes(vec![node]), force.into())?;
    }
    Ok(body)
}

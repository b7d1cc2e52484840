//! Slender beams of tetrahedra: R. H. MacNeal and R. L. Harder, A Proposed Standard Set of Problems to Test Finite Element Accuracy (1985).
//!
//! One end is fixed, and a unit force is spread over the other. The displacement is the work of the force, which is twice the elastic energy.

use std::f64::consts::FRAC_PI_2;
use std::path::Path;

use fem_model::{Body, Elastic, Law, Material, Selector};
use nalgebra::{Rotation3, Vector3};

use super::case::{Level, Mapped, Quantity, constrain, equilibrium, part};
use crate::study::Part;

const SOLID: &str = "27-node hexahedra";

fn quantity(name: &'static str, reference: f64, source: &'static str) -> Quantity {
    Quantity { name, reference, tolerance: 1e-2, source }
}

/// 6 × 0.2 × 0.1, E = 1e7, ν = 0.3.
pub fn straight(_: &Path, quick: bool) -> Result<Part, String> {
    let of = [
        quantity("along (m)", 3.0e-5, "beam theory; 2.996e-5 with 27-node hexahedra"),
        quantity("in the plane (m)", 0.1081, "beam theory; 0.1077 with 27-node hexahedra"),
        quantity("out of the plane (m)", 0.4321, "beam theory; 0.4304 with 27-node hexahedra"),
    ];
    let text = "A beam of 6 × 0.2 × 0.1 m, E = 10 MPa, ν = 0.3, with a unit force along, in and out of its plane.";
    part(("mh-straight", text), &of, (&[1, 2, 3], 2), quick, |cells| {
        let mapped = || Mapped::cube([24 * cells, 2 * cells, cells], |x| x.component_mul(&Vector3::new(6.0, 0.2, 0.1)));
        bent(mapped, (1e7, 0.3), 0.02, &[Vector3::x(), Vector3::y(), Vector3::z()])
    })
}

/// A quarter of a circle with radii of 4.12 and 4.32, 0.1 thick, E = 1e7, ν = 0.25.
pub fn curved(_: &Path, quick: bool) -> Result<Part, String> {
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
pub fn twisted(_: &Path, quick: bool) -> Result<Part, String> {
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
fn bent(
    mapped: impl Fn() -> Result<Mapped, String>,
    (young, poisson): (f64, f64),
    area: f64,
    forces: &[Vector3<f64>],
) -> Result<Level, String> {
    let mut level = Level { nodes: 0, values: Vec::new(), seconds: 0.0 };
    for force in forces {
        let Mapped { mesh, places } = mapped()?;
        level.nodes = places.len();
        let end = (0..places.len()).filter(|&node| places[node].x == 1.0).collect();
        let material = Material::new(Law::Linear(Elastic::new(young, poisson)), 1.0);
        let body = Body::new(mesh, material).map_err(|refusal| refusal.to_string())?;
        let body = constrain(body, &places, |place| [place.x == 0.0; 3])?;
        let body =
            body.traction(&Selector::Nodes(end), (force / area).into()).map_err(|refusal| refusal.to_string())?;
        let (simulation, seconds) = equilibrium(body, 1)?;
        level.seconds += seconds;
        level.values.push(-2.0 * simulation.energies().potential);
    }
    Ok(level)
}

//! Families of fibres in elements.

use nalgebra::Vector3;

use crate::numbers::{check_direction, check_finite, check_not_negative, check_positive, check_vector, problem};
use crate::{BodyMesh, Refusal};

/// Parallel fibres in elements, beside the law of their material: Gasser, Ogden, Holzapfel, Hyperelastic Modelling of Arterial Layers with
/// Distributed Collagen Fibre Orientations (2006).
#[derive(Clone, Debug, PartialEq)]
pub struct FibreFamily {
    /// The scene's table, such as `fibres[0]`.
    pub name: String,
    /// Their energy.
    pub law: FibreLaw,
    /// Elements of the mesh, ascending and without repeats, each with the unit direction of the fibres in the undeformed body.
    pub directions: Vec<(usize, Vector3<f64>)>,
}

/// The energy density of fibres, k1/(2 k2) (exp(k2 E²) − 1) where E = κ (I1 − 3) + (1 − 3κ) (I4 − 1) > 0, else zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FibreLaw {
    /// k1, Pa.
    pub modulus: f64,
    /// k2; with 0 the energy is k1/2 E².
    pub exponent: f64,
    /// κ: 0 for parallel fibres, 1/3 for fibres of all directions alike.
    pub dispersion: f64,
}

/// Directions of fibres in the undeformed body.
#[derive(Clone, Debug, PartialEq)]
pub enum FibreDirections {
    /// The same everywhere, of any length above zero.
    Same([f64; 3]),
    /// Helices about a line.
    Around {
        /// Direction of the line, of any length above zero.
        axis: [f64; 3],
        /// A point of the line, m.
        center: [f64; 3],
        /// From the circumferential direction, counter-clockwise seen against the axis, towards the axis, degrees.
        angle: f64,
    },
    /// One for each element of the mesh, of any length above zero.
    PerElement(Vec<Vector3<f64>>),
}

impl FibreLaw {
    /// Parallel fibres with the energy k1/2 (I4 − 1)², of a modulus k1, Pa.
    pub fn new(modulus: f64) -> Self {
        Self { modulus, exponent: 0.0, dispersion: 0.0 }
    }

    /// Refuses numbers out of range. `table` names the fibres, such as `fibres[0]`.
    pub fn check(&self, table: &str) -> Result<(), Refusal> {
        check_positive(&format!("{table}.modulus"), self.modulus, " of Pa")?;
        check_not_negative(&format!("{table}.exponent"), self.exponent, "(a number without unit)")?;
        match self.dispersion {
            dispersion if (0.0..=1.0 / 3.0).contains(&dispersion) => Ok(()),
            dispersion => problem(
                &format!("{table}.dispersion"),
                format!("is {dispersion}; give a number from 0, for parallel fibres, to 1/3, for all directions alike"),
            ),
        }
    }
}

impl FibreDirections {
    /// Refuses vectors without a direction, and numbers that are not finite.
    pub fn check(&self, table: &str) -> Result<(), Refusal> {
        match self {
            Self::Same(direction) => check_line(&format!("{table}.direction"), direction),
            Self::Around { axis, center, angle } => {
                check_line(&format!("{table}.around.axis"), axis)?;
                check_vector(&format!("{table}.around.center"), center)?;
                check_finite(&format!("{table}.around.angle"), &[*angle])
            }
            Self::PerElement(_) => Ok(()),
        }
    }

    /// The unit directions in some elements of a mesh. Refuses an element without a direction, and directions out of the plane of a flat body.
    pub fn of(&self, table: &str, elements: &[usize], mesh: &BodyMesh) -> Result<Vec<(usize, Vector3<f64>)>, Refusal> {
        self.check(table)?;
        if let Self::PerElement(directions) = self
            && directions.len() != mesh.elements()
        {
            let text = format!(
                "has {} directions; the mesh has {} elements, give a direction for each",
                directions.len(),
                mesh.elements()
            );
            return problem(&format!("{table}.per_element"), text);
        }
        elements.iter().map(|&element| Ok((element, self.of_element(table, element, mesh)?))).collect()
    }

    fn of_element(&self, table: &str, element: usize, mesh: &BodyMesh) -> Result<Vector3<f64>, Refusal> {
        let (key, direction, reason) = match self {
            Self::Same(direction) => ("direction", Vector3::from(*direction), "is no direction"),
            Self::PerElement(directions) => ("per_element", directions[element], "is no direction"),
            Self::Around { axis, center, angle } => {
                let axis = Vector3::from(*axis).normalize();
                let (sine, cosine) = angle.to_radians().sin_cos();
                let around = axis.cross(&(centroid(mesh, element) - Vector3::from(*center)));
                let direction =
                    around.try_normalize(NEAR * size(mesh, element)).map(|around| cosine * around + sine * axis);
                ("around", direction.unwrap_or_default(), "has no circumferential direction on its axis")
            }
        };
        // Squares of large numbers overflow.
        let unit = (direction / direction.amax()).normalize();
        if !unit.iter().all(|entry| entry.is_finite()) {
            let text = format!("{reason} in element {element}; give each element with fibres one that is not zero");
            return problem(&format!("{table}.{key}"), text);
        }
        if mesh.dimension() == 2 && unit.z.abs() > NEAR {
            let text = format!(
                "points out of the plane of a flat body in element {element}: {:?}; give a direction with z = 0",
                <[f64; 3]>::from(unit)
            );
            return problem(&format!("{table}.{key}"), text);
        }
        Ok(unit)
    }
}

/// Rounding errors relative to lengths of an element.
const NEAR: f64 = 1e-9;

fn check_line(field: &str, direction: &[f64; 3]) -> Result<(), Refusal> {
    check_direction(field, direction)?;
    if *direction == [0.0; 3] { problem(field, "is zero; give the direction of the line") } else { Ok(()) }
}

fn centroid(mesh: &BodyMesh, element: usize) -> Vector3<f64> {
    let corners = mesh.corners_of(element);
    corners.iter().map(|&node| mesh.vertices()[node]).sum::<Vector3<f64>>() / corners.len() as f64
}

/// Distance of two corners of an element, m.
fn size(mesh: &BodyMesh, element: usize) -> f64 {
    let corners = mesh.corners_of(element);
    (mesh.vertices()[corners[1]] - mesh.vertices()[corners[0]]).norm()
}

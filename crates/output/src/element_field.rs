//! Fields of one number per element, for the colours of pictures. They are computed on demand.

use std::fmt;
use std::str::FromStr;

use fem_mesh::{tetrahedron_radius_to_edge, triangle_radius_to_edge};
use nalgebra::Vector3;

use super::{StressError, von_mises};
use fem_model::simulation::Simulation;

/// A field of one number per element.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ElementField {
    /// Von Mises stress of the Cauchy stress, Pa.
    Stress,
    /// Minus the mean of the principal stresses, Pa.
    Pressure,
    /// Estimated error of the stress, as in [`StressError`].
    StressError,
    /// Length of the displacement, the mean over the nodes, m.
    Displacement,
    /// Plastic strain, as in [`PlasticFlow`](fem_model::simulation::PlasticFlow).
    PlasticStrain,
    /// Circumradius over shortest edge of the deformed element: 1/√3 for an equilateral triangle, √6/4 for a regular tetrahedron,
    /// more for all others.
    Quality,
}

impl ElementField {
    /// All fields.
    pub const ALL: [Self; 6] =
        [Self::Stress, Self::Pressure, Self::StressError, Self::Displacement, Self::PlasticStrain, Self::Quality];

    /// Names for the command line and on the screen, and SI unit, which is empty for a field without one.
    fn facts(self) -> [&'static str; 3] {
        match self {
            Self::Stress => ["stress", "von Mises stress", "Pa"],
            Self::Pressure => ["pressure", "pressure", "Pa"],
            Self::StressError => ["stress_error", "estimated error of stress", ""],
            Self::Displacement => ["displacement", "displacement", "m"],
            Self::PlasticStrain => ["plastic_strain", "plastic strain", ""],
            Self::Quality => ["quality", "circumradius / edge", ""],
        }
    }

    /// Name for the command line.
    pub fn name(self) -> &'static str {
        self.facts()[0]
    }

    /// Name on the screen.
    pub fn label(self) -> &'static str {
        self.facts()[1]
    }

    /// SI unit; empty for a field without one.
    pub fn unit(self) -> &'static str {
        self.facts()[2]
    }

    /// The fields that a body has.
    pub fn of(simulation: &dyn Simulation) -> Vec<Self> {
        let exists = |field: &Self| match field {
            Self::Stress | Self::Pressure => simulation.has_stress(),
            Self::StressError => simulation.has_stress() && !simulation.moduli_of_elements().is_empty(),
            Self::Displacement | Self::Quality => true,
            Self::PlasticStrain => simulation.plastic_flow().is_some(),
        };
        Self::ALL.into_iter().filter(exists).collect()
    }

    /// The values of all elements now; `None` if the body has no such field.
    pub fn values(self, simulation: &dyn Simulation) -> Option<Vec<f64>> {
        let values: Vec<f64> = match self {
            Self::Stress => simulation.stresses().iter().map(von_mises).collect(),
            Self::Pressure => simulation.stresses().iter().map(|stress| -stress.trace() / 3.0).collect(),
            Self::StressError => StressError::of(simulation)?.of_elements,
            Self::Displacement => displacements(simulation),
            Self::PlasticStrain => simulation.plastic_flow()?.strains,
            Self::Quality => radius_to_edge(simulation),
        };
        (values.len() == simulation.shape().mesh.elements()).then_some(values)
    }
}

impl fmt::Display for ElementField {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl FromStr for ElementField {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let found = Self::ALL.into_iter().find(|field| field.name() == text);
        found.ok_or_else(|| format!("give one of {}", Self::ALL.map(Self::name).join(", ")))
    }
}

fn displacements(simulation: &dyn Simulation) -> Vec<f64> {
    let (q, mesh) = (simulation.positions(), &simulation.shape().mesh);
    let length = |&node: &usize| (q.fixed_rows::<3>(3 * node) - mesh.vertices()[node]).norm();
    let mean = |nodes: &[usize]| nodes.iter().map(length).sum::<f64>() / nodes.len() as f64;
    (0..mesh.elements()).map(|element| mean(mesh.nodes_of(element))).collect()
}

fn radius_to_edge(simulation: &dyn Simulation) -> Vec<f64> {
    let q = simulation.positions();
    let x = |node: usize| -> Vector3<f64> { q.fixed_rows::<3>(3 * node).into_owned() };
    let of_corners = |corners: &[usize]| match *corners {
        [a, b, c] => triangle_radius_to_edge([a, b, c].map(x)),
        [a, b, c, d] => tetrahedron_radius_to_edge([a, b, c, d].map(x)),
        _ => f64::NAN,
    };
    let mesh = &simulation.shape().mesh;
    (0..mesh.elements()).map(|element| of_corners(mesh.corners_of(element))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_field_is_parsed_from_its_name() {
        for field in ElementField::ALL {
            assert_eq!(field.name().parse(), Ok(field));
        }
        assert!("color".parse::<ElementField>().unwrap_err().contains("plastic_strain"));
    }
}

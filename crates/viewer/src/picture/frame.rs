//! The parts of a state that a picture shows.

use fem_model::simulation::{Plane, Simulation};
use fem_output::ElementField;
use kiss3d::glamx::Vec3;

use super::geometry::{points, single};

/// Part of the body's weight whose contact force has an arrow of unit length.
const FULL_ARROW: f64 = 1.0 / 3.0;

/// The parts of a frame that cost time, and are computed only on demand.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Wanted {
    /// The field that colours the elements.
    pub field: Option<ElementField>,
    /// Draw contact forces.
    pub contact_forces: bool,
}

/// A state of a simulation as a picture shows it.
#[derive(Clone, Debug, Default)]
pub struct Frame {
    /// Positions of the nodes, m.
    pub positions: Vec<Vec3>,
    /// Positions of the display surface's vertices, m.
    pub display: Vec<Vec3>,
    /// Obstacles; empty without.
    pub planes: Vec<Plane>,
    /// Arrows of the contact forces on nodes: the node, and the force over a third of the body's weight, or over twice the largest force
    /// without gravity. Empty unless wanted.
    pub arrows: Vec<(usize, Vec3)>,
    /// The field that is wanted, and its values in the elements, if the body has it.
    pub field: Option<(ElementField, Vec<f64>)>,
}

impl Frame {
    /// The current state of a simulation.
    pub fn of(simulation: &dyn Simulation, wanted: Wanted) -> Self {
        let field = wanted.field.and_then(|field| Some((field, field.values(simulation)?)));
        Frame {
            positions: points(&simulation.positions()),
            display: simulation.display_positions().iter().map(single).collect(),
            planes: simulation.planes(),
            arrows: if wanted.contact_forces { arrows(simulation) } else { Vec::new() },
            field,
        }
    }
}

fn arrows(simulation: &dyn Simulation) -> Vec<(usize, Vec3)> {
    let Some(forces) = simulation.contact_forces() else { return Vec::new() };
    let forces = || forces.as_slice().chunks_exact(3).map(|f| nalgebra::Vector3::new(f[0], f[1], f[2]));
    let largest = forces().map(|force| force.norm()).fold(0.0, f64::max);
    let unit = simulation.weight().filter(|weight| *weight > 0.0).map_or(2.0 * largest, |weight| FULL_ARROW * weight);
    let visible = forces().enumerate().filter(|(_, force)| force.norm() > 1e-3 * unit);
    visible.map(|(node, force)| (node, single(&(force / unit)))).collect()
}

//! Dead loads: nodal forces that keep their size and direction. Weight, body force, tractions.

use fem_mesh::{area_vector, volumes};
use fem_scene::Body;
use nalgebra::Vector3;

use super::{Energy, Moment, Potential};
use crate::model::numbering::Numbering;
use crate::number::Real;
use crate::vector::dot3;

/// Key in the statistics.
pub const NAME: &str = "dead_load";

/// Nodal forces, N, in the engine's order.
pub struct DeadLoad<T> {
    force: Vec<[T; 3]>,
}

impl<T: Real> DeadLoad<T> {
    /// These forces on the nodes, N.
    pub fn new(force: Vec<[T; 3]>) -> Self {
        Self { force }
    }
}

/// Weight, body force and dead tractions of a body; `None` where it has none of them.
pub fn build<T: Real>(body: &Body, numbering: &Numbering) -> Option<Box<dyn Potential<T>>> {
    if body.gravity.is_none() && body.body_force.is_none() && body.tractions.is_empty() {
        return None;
    }
    let mesh = &body.shape.mesh;
    let mut force = vec![Vector3::zeros(); mesh.vertices.len()];
    let density = |element: usize| body.material.density * body.density_factors.get(element).copied().unwrap_or(1.0);
    for (number, (element, volume)) in mesh.elements.iter().zip(volumes(mesh)).enumerate() {
        // Each node of a linear tetrahedron carries a quarter of its load.
        let weight = density(number) * body.gravity.unwrap_or_default();
        let share = 0.25 * volume * (weight + body.body_force.unwrap_or_default());
        element.iter().for_each(|&node| force[node] += share);
    }
    for traction in &body.tractions {
        for face in &traction.faces {
            // Each node of a linear triangle carries a third of its load.
            let area = area_vector(face.map(|node| mesh.vertices[node])).norm();
            let share = area / 3.0 * traction.force_per_area;
            face.iter().for_each(|&node| force[node] += share);
        }
    }
    let in_order = numbering.mesh_node.iter().map(|&node| force[node as usize]);
    Some(Box::new(DeadLoad::new(in_order.map(|f| [T::of(f.x), T::of(f.y), T::of(f.z)]).collect())))
}

impl<T: Real> Potential<T> for DeadLoad<T> {
    fn name(&self) -> &'static str {
        NAME
    }

    fn description(&self) -> String {
        "[gravity], [body_force] or [[traction]] with force_per_area".to_owned()
    }

    fn bytes(&self) -> usize {
        size_of_val(&self.force[..])
    }

    fn energy(&self, u: &[[T; 3]], moment: Moment) -> Energy {
        let factor = moment.load_factor.unwrap_or(1.0);
        self.force.iter().zip(u).map(|(f, u)| Energy::of(-factor * dot3(f, u))).sum()
    }

    fn add_gradient(&self, _: &[[T; 3]], moment: Moment, gradient: &mut [[T; 3]]) {
        let factor: T = moment.load();
        for (sum, force) in gradient.iter_mut().zip(&self.force) {
            for i in 0..3 {
                sum[i] -= factor * force[i];
            }
        }
    }

    fn resultant(&self, moment: Moment) -> Option<[f64; 3]> {
        let factor = moment.load_factor.unwrap_or(1.0);
        let along = |i: usize| self.force.iter().map(|force| force[i].as_f64()).sum::<f64>();
        Some(std::array::from_fn(|i| factor * along(i)))
    }

    fn out_of_range(&self) -> Option<(&'static str, &'static str)> {
        let is_finite = self.force.as_flattened().iter().all(|force| force.as_f64().is_finite());
        (!is_finite).then_some(("gravity", "a force on a node"))
    }
}

//! Plastic flow of the elements.

use super::Solids;
use crate::model::any_elements::{AnyElements, with_elements};
use crate::number::Real;
use crate::plasticity::{Internal, Plasticity};

impl<T: Real> Solids<T> {
    /// Plastic flow of the elements, where the scene has some.
    pub fn plasticity(&self) -> Option<&Plasticity<T>> {
        self.plasticity.as_ref()
    }

    /// The same, to be reset or restored.
    pub fn plasticity_mut(&mut self) -> Option<&mut Plasticity<T>> {
        self.plasticity.as_mut()
    }

    /// Lets the elements flow in an accepted step of `dt` seconds, which ends with the displacements `u`.
    pub fn flow(&mut self, u: &[[T; 3]], dt: f64) {
        let Self { groups, plasticity: Some(plasticity), .. } = self else { return };
        for group in groups.iter() {
            let moduli = group.laws.law.moduli();
            with_elements!(&group.elements, elements => elements.for_each_gradient(u, |point, volume, G| {
                plasticity.flow(group.number(point), moduli, volume, G, dt);
            }));
        }
    }

    /// Measure of the plastic strain of each element of the mesh, the mean of its quadrature points; `None` where the body does not flow.
    pub fn plastic_strains(&self) -> Option<Vec<f64>> {
        let points = self.plasticity.as_ref()?.variables().chunks_exact(self.points_per_element);
        let mean = |points: &[Internal<T>]| {
            points.iter().map(|of| of.strain.as_f64()).sum::<f64>() / self.points_per_element as f64
        };
        Some(points.map(mean).collect())
    }
}

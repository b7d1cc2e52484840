//! The matrix of projective dynamics: the Hessian of a quadratic energy of the deformation gradient.

use super::Solids;
use crate::materials::QuadraticForm;
use crate::model::any_elements::{AnyElements, with_elements};
use crate::number::{Real, constant};
use crate::sparse::Block;

impl<T: Real> Solids<T> {
    /// Adds the Hessian of Σ V k/2 G:G, k = 2μ + λ with Lamé's constants at small strain, N/m.
    pub fn add_metric(&self, values: &mut [Block<T, 3>]) {
        let zero = vec![[T::default(); 3]; self.nodes];
        for group in &self.groups {
            let [mu, bulk] = group.laws.law.moduli();
            let law: QuadraticForm<T::Lanes> = QuadraticForm(constant(4.0 / 3.0 * mu + bulk));
            with_elements!(&group.elements, elements => elements.add_stiffness(&law, T::one(), &zero, values));
        }
    }
}

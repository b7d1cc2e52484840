//! The matrix of projective dynamics: the Hessian of a quadratic energy of the deformation gradient.

use super::Solids;
use crate::materials::QuadraticForm;
use crate::model::any_elements::{AnyElements, with_elements};
use crate::model::solid::LawsByReference;
use crate::number::{Real, constant};
use crate::sparse::Block;

impl<T: Real> Solids<T> {
    /// Adds the Hessian of Σ V k/2 G:G, k = 2μ + λ with Lamé's constants at small strain, N/m.
    pub fn add_metric(&self, values: &mut [Block<T, 3>]) {
        let zero = vec![[T::default(); 3]; self.nodes];
        for group in &self.groups {
            let [mu, bulk] = group.laws.law.moduli();
            let modulus = 4.0 / 3.0 * mu + bulk;
            if T::has_fast() {
                let law = QuadraticForm::<T::Fast>(constant(modulus));
                let laws = LawsByReference::one(&law);
                with_elements!(&group.elements, elements => elements.add_stiffness(laws, T::one(), &zero, values));
            } else {
                let law = QuadraticForm::<T::Single>(constant(modulus));
                let laws = LawsByReference::one(&law);
                with_elements!(&group.elements, elements => elements.add_stiffness(laws, T::one(), &zero, values));
            }
        }
    }
}

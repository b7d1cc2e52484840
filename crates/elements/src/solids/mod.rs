//! The elastic elements of a body, seen from outside: one call per pass over all of them.

mod any_elements;
mod groups;
mod material;

use fem_model::DampingForm;
use nalgebra::Matrix3;

use crate::materials::{AnyLaw, Law};
use crate::number::{Float, Lanes};
use crate::plasticity::Plasticity;
use crate::sparse::{Block, Pattern};

pub(crate) use groups::Groups;
pub use material::LawInLanes;

/// All elastic elements of a body, with their materials. Displacements `u` are those of all nodes, m.
pub trait Solids<T: Float>: Send + Sync {
    /// Number of quadrature points: one in every linear element, three in a quadratic triangle, four in a quadratic tetrahedron.
    fn count(&self) -> usize;

    /// Number of materials.
    fn materials(&self) -> usize;

    /// The law of a material, for one element.
    fn law(&self, material: usize) -> &AnyLaw<T::Single>;

    /// The same for [work](LawWork) in the widest lanes of this processor.
    fn law_in_lanes(&self, material: usize) -> LawInLanes<'_, T>;

    /// Numbers in the mesh of the elements of a material. The body has linear elements.
    fn numbers(&self, material: usize) -> Vec<usize>;

    /// Factor of the moduli of an element of the mesh.
    fn factor(&self, element: usize) -> f64;

    /// Memory, bytes.
    fn bytes(&self) -> usize;

    /// Prepares the assembly of matrices with a pattern.
    fn set_pattern(&mut self, pattern: &Pattern);

    /// Elastic energy, J.
    fn energy(&self, u: &[[T; 3]]) -> f64;

    /// Adds the gradient of the energy, N.
    fn add_gradient(&self, u: &[[T; 3]], gradient: &mut [[T; 3]]);

    /// Energy and gradient in one pass.
    fn add_energy_and_gradient(&self, u: &[[T; 3]], gradient: &mut [[T; 3]]) -> f64;

    /// Adds `factor` times the exact Hessian of the energy, N/m.
    fn add_stiffness(&self, factor: T, u: &[[T; 3]], values: &mut [Block<T, 3>]);

    /// Adds `factor` times the Hessian of the energy, projected element by element to positive semi-definite, N/m.
    fn add_projected_stiffness(&self, factor: T, u: &[[T; 3]], values: &mut [Block<T, 3>]);

    /// Adds `factor` K(u) d without a matrix, N.
    fn add_stiffness_times(&self, factor: T, u: &[[T; 3]], d: &[[T; 3]], product: &mut [[T; 3]]);

    /// Adds `factor` times the damping matrix for β = 1 s of this form at `u`, N/m. Where the laws' own derivative takes its place, it is
    /// projected to a positive semi-definite one if `is_projected`.
    fn add_damping_matrix(
        &self,
        form: DampingForm,
        is_projected: bool,
        factor: T,
        u: &[[T; 3]],
        values: &mut [Block<T, 3>],
    );

    /// Adds `factor` times the product of that matrix with the velocities v without a matrix, N.
    fn add_damping_times(&self, form: DampingForm, factor: T, u: &[[T; 3]], v: &[[T; 3]], product: &mut [[T; 3]]);

    /// Adds the Hessian of Σ V k/2 G:G, k = 2μ + λ with Lamé's constants at small strain, N/m.
    fn add_metric(&self, values: &mut [Block<T, 3>]);

    /// Magnitude of the terms that cancel in the elastic energy of a rotated body, J.
    fn cancelled(&self, u: &[[T; 3]]) -> f64;

    /// Minimum of det F over the quadrature points, and its element in the mesh.
    fn min_det_F(&self, u: &[[T; 3]]) -> (T, usize);

    /// Minimum of det F over the elements whose law does not allow inversion, and its element in the mesh; infinite if there are none.
    fn min_det_F_of_barriers(&self, u: &[[T; 3]]) -> (T, usize);

    /// Number of quadrature points with det F ≤ 0.
    fn inverted(&self, u: &[[T; 3]]) -> usize;

    /// Number of quadrature points of an element.
    fn points_per_element(&self) -> usize;

    /// Shear modulus and bulk modulus of a material at small strain, Pa.
    fn moduli_of(&self, material: usize) -> [f64; 2];

    /// Returns true if no stress acts across a flat body.
    fn is_in_plane_stress(&self) -> bool;

    /// Cauchy stress at each quadrature point, Pa: those of the mesh's first element, then those of the next.
    fn cauchy_stresses_at_points(&self, u: &[[T; 3]]) -> Vec<Matrix3<f64>>;

    /// Plastic flow of the elements, where the scene has some.
    fn plasticity(&self) -> Option<&Plasticity<T>>;

    /// The same, to be reset or restored.
    fn plasticity_mut(&mut self) -> Option<&mut Plasticity<T>>;

    /// Lets the elements flow in an accepted step of `dt` seconds, which ends with the displacements `u`.
    fn flow(&mut self, u: &[[T; 3]], dt: f64);

    /// Measure of the plastic strain of each element of the mesh, the mean of its quadrature points; `None` where the body does not flow.
    fn plastic_strains(&self) -> Option<Vec<f64>>;
}

impl<T: Float> dyn Solids<T> + '_ {
    /// The law of each material.
    pub fn laws(&self) -> impl Iterator<Item = &AnyLaw<T::Single>> {
        (0..self.materials()).map(|material| self.law(material))
    }

    /// Returns true if the stress of every element is a linear function of the displacement gradient.
    pub fn is_linear(&self) -> bool {
        self.laws().all(|law| law.is_linear())
    }

    /// Returns true if every law allows J = det F ≤ 0.
    pub fn allow_inversion(&self) -> bool {
        self.laws().all(|law| law.allows_inversion())
    }

    /// The number of the material of each element of the mesh.
    pub fn material_of_elements(&self) -> Vec<usize> {
        let mut material_of = vec![0; self.count() / self.points_per_element()];
        for material in 1..self.materials() {
            let points = self.numbers(material);
            points.into_iter().for_each(|point| material_of[point / self.points_per_element()] = material);
        }
        material_of
    }

    /// Shear modulus and bulk modulus of each element of the mesh at small strain, Pa.
    pub fn moduli_of_elements(&self) -> Vec<[f64; 2]> {
        let in_space = |[shear, bulk]: [f64; 2]| match self.is_in_plane_stress() {
            // The law has 2 μ λ/(λ + 2 μ) in place of Lamé's λ.
            true => {
                let lambda = bulk - 2.0 / 3.0 * shear;
                [shear, 2.0 * shear * lambda / (2.0 * shear - lambda) + 2.0 / 3.0 * shear]
            }
            false => [shear, bulk],
        };
        let moduli: Vec<_> = self.moduli().map(in_space).collect();
        let materials = self.material_of_elements().into_iter().enumerate();
        materials.map(|(element, material)| moduli[material].map(|modulus| self.factor(element) * modulus)).collect()
    }

    /// Shear modulus and bulk modulus of each material at small strain, Pa; in plane stress those of its plane.
    pub fn moduli(&self) -> impl Iterator<Item = [f64; 2]> {
        (0..self.materials()).map(|material| self.moduli_of(material))
    }
}

/// Work with the law of a material, written for any lanes.
pub trait LawWork<T: Float> {
    /// The result.
    type Output;

    /// Does the work.
    fn run<L: Lanes<Element = T>>(self, law: &dyn Law<L>, allows_inversion: bool) -> Self::Output;
}

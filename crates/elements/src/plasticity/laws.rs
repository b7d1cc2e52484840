//! The laws of batches of plastic elements.

use fem_model::Plasticity as Model;

use super::{Additive, J2, Plasticity, j2};
use crate::elements::BatchLaws;
use crate::materials::{AnyLaw, KelvinVoigt, Law, Vectorized};
use crate::number::{Float, Lanes, Number, constant};
use crate::tensor::{Tensor, Tensor4, from_fn, plus_identity, product, transpose};

/// A law with the internal variables of a batch.
#[derive(Clone, Copy)]
#[allow(missing_docs)] // the names are those of the models
pub enum PlasticLaw<T> {
    Additive(Additive<T>),
    J2(J2<T>),
    ViscousJ2(ViscousJ2<T>),
}

/// Kelvin–Voigt damping of the elastic part Fᵉ = F Fᵖ⁻¹ of a deformation.
#[derive(Clone, Copy)]
pub struct ViscousJ2<T> {
    damping: KelvinVoigt<T>,
    /// Fᵖ⁻¹ − 1
    plastic: Tensor<T>,
}

/// The laws of the elements of one material.
#[derive(Clone, Copy)]
pub struct PlasticLaws<'a, T: Float, L> {
    plasticity: &'a Plasticity<T>,
    moduli: [L; 2],
    /// Number in the mesh of each element; empty where elements are numbered as there.
    numbers: &'a [usize],
    purpose: Purpose,
}

/// The quantity that a plastic law is asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Purpose {
    /// The stress of a step, which may flow, and its derivative.
    Stress,
    /// The derivative for damping: that of a step without flow. A state on the yield surface would flow or not by its last digit.
    ElasticDerivative,
    /// Kelvin–Voigt damping with the elastic moduli.
    Viscosity,
}

impl<'a, T: Float, L: Lanes<Element = T>> PlasticLaws<'a, T, L> {
    /// The laws of elements with these numbers in the mesh; without numbers of all elements of the mesh.
    pub fn new(plasticity: &'a Plasticity<T>, law: &AnyLaw<L>, numbers: &'a [usize]) -> Self {
        Self { plasticity, moduli: law.moduli().map(constant), numbers, purpose: Purpose::Stress }
    }

    /// The same for another purpose.
    pub fn with_purpose(self, purpose: Purpose) -> Self {
        Self { purpose, ..self }
    }
}

impl<T: Float, L: Lanes<Element = T>> BatchLaws<L> for PlasticLaws<'_, T, L> {
    type Law = PlasticLaw<L>;
    const IS_INLINED: bool = false;

    fn of_batch(&self, elements: &[u32], batch: usize) -> PlasticLaw<L> {
        let first = batch * L::LANES;
        // The last batch is filled up with elements without history.
        let variables = |lane: usize| {
            let element = *elements.get(first + lane)? as usize;
            let number = self.numbers.get(element).copied().unwrap_or(element);
            Some(&self.plasticity.variables()[number])
        };
        let gather = |entry: &dyn Fn(&super::Internal<T>) -> T| {
            let mut lanes = L::zero();
            for (lane, number) in lanes.as_mut_slice().iter_mut().enumerate() {
                *number = variables(lane).map_or(T::default(), entry);
            }
            lanes
        };
        let plastic = from_fn(|i, j| gather(&|of| of.plastic[i][j]));
        let [mu, bulk] = self.moduli;
        let lambda = bulk - constant::<L>(2.0 / 3.0) * mu;
        match self.plasticity.model() {
            Model::J2 { .. } if self.purpose == Purpose::Viscosity => {
                PlasticLaw::ViscousJ2(ViscousJ2 { damping: KelvinVoigt { mu, lambda }, plastic })
            }
            Model::Additive { .. } => {
                PlasticLaw::Additive(Additive { mu, lambda, plastic, is_in_plane: self.plasticity.is_in_plane() })
            }
            Model::J2 { yield_stress, hardening } => PlasticLaw::J2(J2 {
                mu,
                bulk,
                yield_stress: constant(if self.purpose == Purpose::Stress { yield_stress } else { f64::INFINITY }),
                hardening: constant(hardening),
                plastic,
                strain: gather(&|of| of.strain),
            }),
        }
    }
}

/// Evaluates an expression for the law of any model.
macro_rules! with_model {
    ($law:expr, $name:ident => $value:expr) => {
        match $law {
            PlasticLaw::Additive($name) => $value,
            PlasticLaw::J2($name) => $value,
            PlasticLaw::ViscousJ2($name) => $value,
        }
    };
}

impl<T: Number> Law<T> for PlasticLaw<T> {
    fn energy(&self, G: &Tensor<T>) -> T {
        with_model!(self, law => Vectorized(*law).energy(G))
    }

    fn stress(&self, G: &Tensor<T>) -> Tensor<T> {
        with_model!(self, law => Vectorized(*law).stress(G))
    }

    fn energy_and_stress(&self, G: &Tensor<T>) -> (T, Tensor<T>) {
        with_model!(self, law => Vectorized(*law).energy_and_stress(G))
    }

    fn derivative(&self, G: &Tensor<T>) -> Tensor4<T> {
        with_model!(self, law => Vectorized(*law).derivative(G))
    }

    fn derivative_times(&self, G: &Tensor<T>, rate: &Tensor<T>) -> Tensor<T> {
        with_model!(self, law => Vectorized(*law).derivative_times(G, rate))
    }

    fn projected_derivative(&self, G: &Tensor<T>) -> Tensor4<T> {
        with_model!(self, law => Vectorized(*law).projected_derivative(G))
    }
}

impl<T: Number> Law<T> for ViscousJ2<T> {
    #[inline(always)]
    fn energy(&self, G: &Tensor<T>) -> T {
        self.damping.energy(G)
    }

    #[inline(always)]
    fn stress(&self, G: &Tensor<T>) -> Tensor<T> {
        self.damping.stress(G)
    }

    #[inline(always)]
    fn derivative(&self, G: &Tensor<T>) -> Tensor4<T> {
        j2::pulled_back(&self.plastic, &self.damping.derivative(&j2::trial(&self.plastic, G)))
    }

    /// With A = Fᵖ⁻¹, (H : Ḟ A) Aᵀ.
    #[inline(always)]
    fn derivative_times(&self, G: &Tensor<T>, rate: &Tensor<T>) -> Tensor<T> {
        let A = plus_identity(&self.plastic);
        let stress = self.damping.derivative_times(&j2::trial(&self.plastic, G), &product(rate, &A));
        product(&stress, &transpose(&A))
    }

    #[inline(always)]
    fn projected_derivative(&self, G: &Tensor<T>) -> Tensor4<T> {
        self.derivative(G)
    }
}

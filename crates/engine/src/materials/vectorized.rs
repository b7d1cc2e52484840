//! Laws for calls by reference: each call runs with the instructions that its lanes are made for.

use pulp::{Simd, WithSimd};

use super::{Law, Linearized};
use crate::number::Number;
use crate::tensor::{Tensor, Tensor4};

/// A law whose functions may be called from anywhere.
#[derive(Clone, Copy)]
pub struct Vectorized<L>(pub L);

/// Defines the functions of [`Vectorized`], each by a type of work that calls the same function of the law.
macro_rules! vectorized_law {
    ($($Call:ident $function:ident -> $Answer:ty),* $(,)?) => {
        $(
            struct $Call<'a, T, L>(&'a L, &'a Tensor<T>);

            impl<T: Number, L: Law<T>> WithSimd for $Call<'_, T, L> {
                type Output = $Answer;

                #[inline(always)]
                fn with_simd<S: Simd>(self, _simd: S) -> $Answer {
                    self.0.$function(self.1)
                }
            }
        )*

        impl<T: Number, L: Law<T>> Law<T> for Vectorized<L> {
            $(
                fn $function(&self, G: &Tensor<T>) -> $Answer {
                    T::vectorize($Call(&self.0, G))
                }
            )*
        }
    };
}

vectorized_law!(
    Energy energy -> T,
    Stress stress -> Tensor<T>,
    EnergyAndStress energy_and_stress -> (T, Tensor<T>),
    Derivative derivative -> Tensor4<T>,
    Linearization linearized -> Linearized<T>,
    ProjectedDerivative projected_derivative -> Tensor4<T>,
);

//! Laws for calls by reference: each call runs with the instructions that its lanes are made for.

use pulp::{Simd, WithSimd};

use super::{Law, Terms};
use crate::number::Number;
use crate::tensor::{Tensor, Tensor4};

/// A law whose functions may be called from anywhere.
#[derive(Clone, Copy)]
pub struct Vectorized<L>(pub L);

/// Defines the functions of [`Vectorized`], each by a type of work that calls the same function of the law.
macro_rules! vectorized_law {
    ($($Call:ident $function:ident -> $Answer:ty, $vectorize:ident);* $(;)?) => {
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

        struct DerivativeTimes<'a, T, L>(&'a L, &'a Tensor<T>, &'a Tensor<T>);

        impl<T: Number, L: Law<T>> WithSimd for DerivativeTimes<'_, T, L> {
            type Output = Tensor<T>;

            #[inline(always)]
            fn with_simd<S: Simd>(self, _simd: S) -> Tensor<T> {
                self.0.derivative_times(self.1, self.2)
            }
        }

        impl<T: Number, L: Law<T>> Law<T> for Vectorized<L> {
            $(
                fn $function(&self, G: &Tensor<T>) -> $Answer {
                    T::$vectorize($Call(&self.0, G))
                }
            )*

            fn derivative_times(&self, G: &Tensor<T>, rate: &Tensor<T>) -> Tensor<T> {
                T::vectorize(DerivativeTimes(&self.0, G, rate))
            }
        }
    };
}

vectorized_law!(
    Energy energy -> T, vectorize;
    Stress stress -> Tensor<T>, vectorize_widest;
    EnergyAndStress energy_and_stress -> (T, Tensor<T>), vectorize;
    Derivative derivative -> Tensor4<T>, vectorize;
    TermsOf terms -> Terms<T>, vectorize_widest;
    ProjectedDerivative projected_derivative -> Tensor4<T>, vectorize;
);

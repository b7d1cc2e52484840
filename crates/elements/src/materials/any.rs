//! The enum of all laws and its dispatch, generated from the list of laws.

/// Defines [`AnyLaw`](super::AnyLaw) and its methods from a list of `file::Law`.
macro_rules! laws {
    (() inlined { $($first:tt)* } by_reference { $($second:tt)* }) => {
        $crate::materials::any::laws! { $($first)* $($second)* }
    };
    ($($file:ident::$Law:ident,)*) => {
        $(pub use $file::$Law;)*

        /// One of the laws, with its parameters.
        #[derive(Clone, Copy, Debug, PartialEq)]
        #[allow(missing_docs)] // the names are those of the laws
        pub enum AnyLaw<T> {
            $($Law($Law<T>),)*
        }

        impl AnyLaw<f64> {
            /// The names of all laws.
            pub const NAMES: &'static [&'static str] = &[$($Law::<f64>::NAME),*];
        }

        impl<T: Number> Law<T> for AnyLaw<T> {
            fn energy(&self, G: &Tensor<T>) -> T {
                match self {
                    $(Self::$Law(law) => Vectorized(*law).energy(G),)*
                }
            }

            fn stress(&self, G: &Tensor<T>) -> Tensor<T> {
                match self {
                    $(Self::$Law(law) => Vectorized(*law).stress(G),)*
                }
            }

            fn energy_and_stress(&self, G: &Tensor<T>) -> (T, Tensor<T>) {
                match self {
                    $(Self::$Law(law) => Vectorized(*law).energy_and_stress(G),)*
                }
            }

            fn derivative(&self, G: &Tensor<T>) -> Tensor4<T> {
                match self {
                    $(Self::$Law(law) => Vectorized(*law).derivative(G),)*
                }
            }

            fn terms(&self, G: &Tensor<T>) -> Terms<T> {
                match self {
                    $(Self::$Law(law) => Vectorized(*law).terms(G),)*
                }
            }

            fn derivative_times(&self, G: &Tensor<T>, rate: &Tensor<T>) -> Tensor<T> {
                match self {
                    $(Self::$Law(law) => Vectorized(*law).derivative_times(G, rate),)*
                }
            }

            fn projected_derivative(&self, G: &Tensor<T>) -> Tensor4<T> {
                match self {
                    $(Self::$Law(law) => Vectorized(*law).projected_derivative(G),)*
                }
            }
        }

        impl<T: Number> AnyLaw<T> {
            /// The law of a material; `None` if its body consists of springs.
            pub fn new(material: &fem_model::Material) -> Option<Self> {
                $(if let Some(law) = $Law::of(material) {
                    return Some(Self::$Law(law));
                })*
                None
            }

            /// The law by reference.
            pub(crate) fn as_law(&self) -> &dyn Law<T> {
                self
            }

            /// The name in scene files.
            pub fn name(&self) -> &'static str {
                match self {
                    $(Self::$Law(_) => $Law::<T>::NAME,)*
                }
            }

            /// Returns true if the stress is a linear function of the displacement gradient.
            pub fn is_linear(&self) -> bool {
                match self {
                    $(Self::$Law(_) => $Law::<T>::IS_LINEAR,)*
                }
            }

            /// Returns true if the energy is finite for J = det F ≤ 0 too. If not, a step must keep J > 0 in every element.
            pub fn allows_inversion(&self) -> bool {
                match self {
                    $(Self::$Law(_) => $Law::<T>::ALLOWS_INVERSION,)*
                }
            }

            /// Shear modulus and bulk modulus of small strain, Pa.
            pub fn moduli(&self) -> [f64; 2] {
                let of_all_lanes = match self {
                    $(Self::$Law(law) => law.moduli(),)*
                };
                of_all_lanes.map(|modulus| $crate::number::Float::as_f64(modulus.lane(0)))
            }

            /// The law at the quadrature points where the volume is averaged: Lamé's λ is zero, or stays if it is negative. `None` if the law
            /// has no energy of the volume alone.
            pub fn without_lambda(&self) -> Option<Self> {
                let [shear, bulk] = self.moduli();
                let kept = $crate::number::constant(f64::min(bulk, 2.0 / 3.0 * shear));
                match self {
                    $(Self::$Law(law) => law.with_bulk_modulus(kept).map(Self::$Law),)*
                }
            }

            /// The sum of its moduli, Pa: the size of its stress where strain is 1.
            pub fn size(&self) -> f64 {
                self.moduli().iter().sum()
            }
        }
    };
}
pub(super) use laws;

/// Chooses the law once, outside the loop over elements: `with_inlined_law!(any_law, law => expression, else other)` evaluates the
/// expression, compiled once for each law that is worth it, with `law` bound to the law itself; for all others the other expression. Needs
/// [`match_inlined_law`] in scope.
macro_rules! with_inlined_law {
    ($any:expr, $law:ident => $work:expr, else $other:block) => {
        $crate::materials::law_list! { match_inlined_law ($any, $law, $work, $other) }
    };
}
pub(crate) use with_inlined_law;

/// The match of [`with_inlined_law`].
macro_rules! match_inlined_law {
    (($any:expr, $law:ident, $work:expr, $other:expr) inlined { $($file:ident::$Law:ident,)* } by_reference { $($rest:tt)* }) => {
        match $any {
            $($crate::materials::AnyLaw::$Law($law) => $work,)*
            _ => $other,
        }
    };
}
pub(crate) use match_inlined_law;

//! The law that a scene asks for, with its moduli.

use super::{Corotated, Law, Linear, NeoHookean, StVenantKirchhoff, StableNeoHookean};
use crate::number::Real;
use crate::tensor::{Tensor, Tensor4};
use fem_scene::Model;

/// Chooses the law once, outside the loop over elements: `with_law!(material, law: T::Lanes => expression)` evaluates the
/// expression with `law` bound to the concrete law, its moduli of that number type, the same in every lane.
macro_rules! with_law {
    ($material:expr, $law:ident: $T:ty => $work:expr) => {{
        #[allow(unused_imports)] // a float's own splat needs no trait in scope
        use simba::simd::SimdValue as _;
        use $crate::materials::{Corotated, Linear, Material, NeoHookean, StVenantKirchhoff, StableNeoHookean};
        match $material {
            Material::Linear(Linear { mu, lambda }) => {
                let $law = Linear { mu: <$T>::splat(mu), lambda: <$T>::splat(lambda) };
                $work
            }
            Material::Corotated(Corotated { mu, lambda }) => {
                let $law = Corotated { mu: <$T>::splat(mu), lambda: <$T>::splat(lambda) };
                $work
            }
            Material::StVenantKirchhoff(StVenantKirchhoff { mu, lambda }) => {
                let $law = StVenantKirchhoff { mu: <$T>::splat(mu), lambda: <$T>::splat(lambda) };
                $work
            }
            Material::NeoHookean(NeoHookean { C, D }) => {
                let $law = NeoHookean { C: <$T>::splat(C), D: <$T>::splat(D) };
                $work
            }
            Material::StableNeoHookean(StableNeoHookean { mu, lambda }) => {
                let $law = StableNeoHookean { mu: <$T>::splat(mu), lambda: <$T>::splat(lambda) };
                $work
            }
        }
    }};
}
pub(crate) use with_law;

/// One of the laws.
#[derive(Clone, Copy, Debug, PartialEq)]
#[allow(missing_docs)] // the names are those of the laws
pub enum Material<T> {
    Linear(Linear<T>),
    Corotated(Corotated<T>),
    StVenantKirchhoff(StVenantKirchhoff<T>),
    NeoHookean(NeoHookean<T>),
    StableNeoHookean(StableNeoHookean<T>),
}

impl<T: Real> Material<T> {
    /// The law of a scene's table; `None` where the table lacks the moduli of its model, which no checked scene does.
    pub fn new(table: &fem_scene::Material) -> Option<Self> {
        if table.model == Model::NeoHookean {
            let (C, D) = table.neo_hookean()?;
            return Some(Self::NeoHookean(NeoHookean { C: Real::of(C), D: Real::of(D) }));
        }
        let (E, nu) = (table.young?, table.poisson?);
        let mu: T = Real::of(E / (2.0 * (1.0 + nu)));
        let lambda: T = Real::of(E * nu / ((1.0 + nu) * (1.0 - 2.0 * nu)));
        Some(match table.model {
            Model::Linear => Self::Linear(Linear { mu, lambda }),
            Model::Corotated => Self::Corotated(Corotated { mu, lambda }),
            Model::StVenantKirchhoff => Self::StVenantKirchhoff(StVenantKirchhoff { mu, lambda }),
            Model::StableNeoHookean => Self::StableNeoHookean(StableNeoHookean { mu, lambda }),
            Model::NeoHookean => return None,
        })
    }

    /// C and D, or μ and λ, Pa.
    pub fn moduli(&self) -> [T; 2] {
        match *self {
            Self::NeoHookean(NeoHookean { C, D }) => [C, D],
            Self::Linear(Linear { mu, lambda })
            | Self::Corotated(Corotated { mu, lambda })
            | Self::StVenantKirchhoff(StVenantKirchhoff { mu, lambda })
            | Self::StableNeoHookean(StableNeoHookean { mu, lambda }) => [mu, lambda],
        }
    }
}

impl<T: Real> Material<T> {
    /// The sum of its moduli, Pa: the size of its stress where strain is 1.
    pub fn size(&self) -> f64 {
        let sum = |a: T, b: T| a.as_f64().abs() + b.as_f64().abs();
        match *self {
            Self::Linear(Linear { mu, lambda })
            | Self::Corotated(Corotated { mu, lambda })
            | Self::StVenantKirchhoff(StVenantKirchhoff { mu, lambda })
            | Self::StableNeoHookean(StableNeoHookean { mu, lambda }) => sum(mu, lambda),
            Self::NeoHookean(NeoHookean { C, D }) => 2.0 * sum(C, D),
        }
    }
}

impl Material<f64> {
    /// P(G) of one element, Pa.
    pub fn stress(&self, G: &Tensor<f64>) -> Tensor<f64> {
        with_law!(*self, law: f64 => law.stress(G))
    }

    /// ∂P/∂F of one element, Pa.
    pub fn derivative(&self, G: &Tensor<f64>) -> Tensor4<f64> {
        with_law!(*self, law: f64 => law.derivative(G))
    }
}

/// Whether the energy is finite for J ≤ 0 too; where it is not, a step must keep every element J > 0.
pub fn allows_inversion(model: Model) -> bool {
    model != Model::NeoHookean
}

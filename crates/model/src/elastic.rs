//! Moduli of small strain.

use serde::Deserialize;

/// Moduli of small strain.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Elastic {
    /// Young's modulus, Pa.
    pub young: f64,
    /// Poisson's ratio.
    pub poisson: f64,
}

/// State of a flat body across its plane.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "snake_case")]
pub enum PlaneState {
    /// Plane strain: the thickness stays as it is, and a stress acts across the plane.
    #[default]
    Strain,
    /// Plane stress: no stress acts across the plane, and the thickness changes, as in a thin sheet. The laws `linear` and `corotated` have
    /// it, without plastic flow.
    Stress,
}

/// Lamé's λ over μ of a material with Poisson's ratio ½: the volume changes by that part of the strain that pressures of the size of μ cause.
const INCOMPRESSIBLE: f64 = 1e8;

impl Elastic {
    /// Moduli from Young's modulus, Pa, and Poisson's ratio.
    pub fn new(young: f64, poisson: f64) -> Self {
        Self { young, poisson }
    }

    /// Moduli from Lamé's constants, Pa: E = μ (3λ + 2μ)/(λ + μ) and ν = λ/(2(λ + μ)).
    pub fn of_lame(lambda: f64, mu: f64) -> Self {
        Self::new(mu * (3.0 * lambda + 2.0 * mu) / (lambda + mu), 0.5 * lambda / (lambda + mu))
    }

    /// Lamé's constants μ = E/(2(1+ν)) and λ = Eν/((1+ν)(1−2ν)), Pa. In plane stress, λ is that of the law after the strain across the
    /// plane has been eliminated, 2λμ/(λ+2μ) = Eν/(1−ν²): Timoshenko and Goodier, Theory of Elasticity (1970), §15 f. With ν = ½, λ is 10⁸ μ.
    pub fn lame(self, plane: PlaneState) -> [f64; 2] {
        let Self { young: E, poisson: nu } = self;
        let lambda = match plane {
            PlaneState::Strain if nu == 0.5 => INCOMPRESSIBLE * E / 3.0,
            PlaneState::Strain => E * nu / ((1.0 + nu) * (1.0 - 2.0 * nu)),
            PlaneState::Stress => E * nu / ((1.0 + nu) * (1.0 - nu)),
        };
        [E / (2.0 * (1.0 + nu)), lambda]
    }
}

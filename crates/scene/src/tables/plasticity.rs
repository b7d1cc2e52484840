//! `[plasticity]`: the plastic flow of all materials of a body.

use serde::Deserialize;

/// `[plasticity]`: plastic flow of every element. Every material has the law of the model: `corotated` for `additive`, `hencky` for `j2`.
/// Engine only.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct PlasticityTable {
    /// Model of plastic flow.
    pub model: PlasticModel,
    /// `additive`, which requires it: elastic strain beyond which the material flows; positive.
    pub yield_strain: Option<f64>,
    /// `additive`, which requires it: rate of the flow, 1/s; positive.
    pub creep: Option<f64>,
    /// `additive`: bound of the plastic strain; positive. Default: unbounded.
    pub maximum: Option<f64>,
    /// `j2`, which requires it: yield stress in tension, Pa; positive.
    pub yield_stress: Option<f64>,
    /// `j2`: growth of the yield stress with the equivalent plastic strain, Pa; at least 0. Default: 0.
    pub hardening: Option<f64>,
}

/// Models of plastic flow.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "snake_case")]
pub enum PlasticModel {
    /// Strain is the sum of an elastic and a plastic one; the flow has a rate, and `static` is refused.
    Additive,
    /// Von Mises plasticity: the deformation gradient is the product of an elastic and a plastic one; the flow has no rate.
    J2,
}

impl PlasticModel {
    /// The name in scene files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Additive => "additive",
            Self::J2 => "j2",
        }
    }

    /// The only law whose elasticity the model has.
    pub fn law(self) -> &'static str {
        match self {
            Self::Additive => "corotated",
            Self::J2 => "hencky",
        }
    }
}

//! `[plasticity]`: the plastic flow of all materials of a body.

use serde::Deserialize;

/// `[plasticity]`
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct PlasticityTable {
    /// The model.
    pub model: PlasticModel,
    /// Additive: elastic strain beyond which the material flows.
    pub yield_strain: Option<f64>,
    /// Additive: rate of the flow, 1/s.
    pub creep: Option<f64>,
    /// Additive: bound of the plastic strain; unbounded by default.
    pub maximum: Option<f64>,
    /// J2: yield stress in tension, Pa.
    pub yield_stress: Option<f64>,
    /// J2: growth of the yield stress with the equivalent plastic strain, Pa; 0 by default.
    pub hardening: Option<f64>,
}

/// Models of plastic flow.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "snake_case")]
pub enum PlasticModel {
    /// Strain is the sum of an elastic and a plastic one; the flow has a rate.
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

//! The tables of a batch: `[batch]` and `[batch.vary]`.

use serde::Deserialize;

/// `[batch]`: many environments of one scene, which step together.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct BatchTable {
    /// Number of environments.
    pub count: usize,
    /// `[batch.vary]`
    #[serde(default)]
    pub vary: VaryTable,
}

/// `[batch.vary]`: the quantities that differ from environment to environment.
#[derive(Clone, Debug, Default, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct VaryTable {
    /// `material.young`, Pa.
    pub young: Option<RangeTable>,
    /// `material.poisson`.
    pub poisson: Option<RangeTable>,
    /// `material.density`, kg/m³.
    pub density: Option<RangeTable>,
    /// Factor on `gravity.acceleration`.
    pub gravity: Option<RangeTable>,
}

/// A range of values, from that of the first environment to that of the last.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct RangeTable {
    /// Value of the first environment.
    pub from: f64,
    /// Value of the last.
    pub to: f64,
    /// How the values between are spaced; [`Spacing::Even`] by default.
    #[serde(default)]
    pub spacing: Spacing,
}

/// Spacing of the values of a range.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "snake_case")]
pub enum Spacing {
    /// Equal differences.
    #[default]
    Even,
    /// Equal ratios.
    Geometric,
}

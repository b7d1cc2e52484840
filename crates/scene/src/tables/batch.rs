//! The tables of a batch: `[batch]` and `[batch.vary]`.

use serde::Deserialize;

/// `[batch]`: many environments of one scene, which step together. Engine only, and not with `static`.
///
/// Environment i of n has the value at i/(n − 1) of each range in `[batch.vary]`.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct BatchTable {
    /// Number of environments, 1 to 65 536.
    pub count: usize,
    /// The quantities that differ from environment to environment.
    #[serde(default)]
    pub vary: VaryTable,
}

/// `[batch.vary]`: the quantities that differ from environment to environment.
#[derive(Clone, Debug, Default, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct VaryTable {
    /// Range of `material.young`, Pa.
    pub young: Option<RangeTable>,
    /// Range of `material.poisson`.
    pub poisson: Option<RangeTable>,
    /// Range of `material.density`, kg/m³; not with `[[materials]]`.
    pub density: Option<RangeTable>,
    /// Range of a factor on `gravity.acceleration`.
    pub gravity: Option<RangeTable>,
}

/// A range of values, from that of the first environment to that of the last.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct RangeTable {
    /// Value of the first environment, and of a single one.
    pub from: f64,
    /// Value of the last environment.
    pub to: f64,
    /// Spacing of the values between.
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
    /// Equal ratios of positive values.
    Geometric,
}

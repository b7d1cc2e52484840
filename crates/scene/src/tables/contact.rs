//! The tables of contact: `[[planes]]` and `[contact]`.

use serde::Deserialize;

use super::CurveTable;
use super::vectors::{three_numbers, three_numbers_if_any};

/// `[[planes]]`: an obstacle, the half-space behind a plane. The body stays on the side to which the normal points. Engine only, and not
/// with `linearly_implicit_euler` and `projective_dynamics`.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct PlaneTable {
    /// A point of the plane before its motion, m.
    #[serde(deserialize_with = "three_numbers")]
    pub point: [f64; 3],
    /// Direction from the plane to the body, of any length.
    #[serde(deserialize_with = "three_numbers")]
    pub normal: [f64; 3],
    /// Coefficient of Coulomb friction, at least 0; 0 with `static`.
    #[serde(default)]
    pub friction: f64,
    /// Velocity of the plane, m/s; not with `static`. Default: at rest.
    #[serde(default, deserialize_with = "three_numbers_if_any")]
    pub velocity: Option<[f64; 3]>,
    /// Time at which a plane with a velocity stops, s; positive. Default: never.
    pub until: Option<f64>,
    /// Displacement of the plane at a factor 1 of `curve`, m; together with `curve`, in place of `velocity`. Default: at rest.
    #[serde(default, deserialize_with = "three_numbers_if_any")]
    pub displacement: Option<[f64; 3]>,
    /// Factor of the displacement as a function of time, without jumps. Default: at rest.
    pub curve: Option<CurveTable>,
}

/// `[contact]`: the numbers of contact in implicit methods and `static`; it needs `[[planes]]`. Engine only.
#[derive(Clone, Debug, Default, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct ContactTable {
    /// Distance from an obstacle below which it repels the body, m; positive. Default: 1e-3 of the body's length.
    pub activation_distance: Option<f64>,
    /// Speed of sliding from which friction has its full size, m/s; positive. It needs a plane with friction. Default: the
    /// smallest of 1e-3 lengths of the body per second, 1e-3 √(g × length), and a tenth of the speed along a plane with friction of each
    /// prescribed motion, of the initial velocity and of the plane.
    pub transition_speed: Option<f64>,
}

//! `[[fibres]]`: families of fibres in elements.

use std::path::PathBuf;

use fem_model::{FibreDirections, FibreLaw, Selector};
use serde::Deserialize;

use super::selector::of_keys;
use super::vectors::{three_numbers, three_numbers_if_any};
use super::{BoxTable, On, SphereTable};

/// `[[fibres]]`: a family of fibres in elements, beside the law of their material. Their energy density is k1/(2 k2) (exp(k2 E²) − 1) where
/// E = κ (I1 − 3) + (1 − 3κ) (I4 − 1) is positive, with I1 = tr(FᵀF) and I4 = |F a|² of the direction a, and zero where they are compressed. Engine only, and not
/// with `[plasticity]`, `mass_spring` or plane stress.
///
/// At most one selector; without it all elements have the fibres. One of `direction`, `around` and `per_element`.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct FibresTable {
    /// All elements, or those whose centroid lies near one side of the mesh. Default: `"all"`, without another selector.
    pub on: Option<On>,
    /// The elements whose centroid lies in a box.
    #[serde(rename = "box")]
    pub cuboid: Option<BoxTable>,
    /// The elements whose centroid lies in a sphere.
    pub sphere: Option<SphereTable>,
    /// The elements of a named set of the mesh.
    pub set: Option<String>,
    /// k1, Pa; positive. Parallel fibres that are stretched a little add 4 k1 to the stiffness along them.
    pub modulus: f64,
    /// k2, at least 0: how soon the fibres stiffen. With 0 the energy density is k1/2 E².
    #[serde(default)]
    pub exponent: f64,
    /// κ: 0 for parallel fibres, to 1/3 for fibres of all directions alike.
    #[serde(default)]
    pub dispersion: f64,
    /// The direction a in the undeformed body, of any length above zero. In the plane of a flat body, as all directions of fibres are.
    #[serde(default, deserialize_with = "three_numbers_if_any")]
    pub direction: Option<[f64; 3]>,
    /// Helices about a line, as in arteries.
    pub around: Option<AroundTable>,
    /// A file with a line `x,y,z` of directions for each element of the mesh; beside the scene or in `data`.
    pub per_element: Option<PathBuf>,
}

/// `around`: fibres along helices about a line.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct AroundTable {
    /// Direction of the line, of any length above zero; along z for a flat body.
    #[serde(deserialize_with = "three_numbers")]
    pub axis: [f64; 3],
    /// A point of the line, m. Default: the origin.
    #[serde(default, deserialize_with = "three_numbers_if_any")]
    pub center: Option<[f64; 3]>,
    /// Angle from the circumferential direction, counter-clockwise seen against the axis, towards the axis, degrees; 0 for a flat body.
    pub angle: f64,
}

impl FibresTable {
    /// The selectors that the table gives; at most one in a checked scene, and all elements without one.
    pub fn selectors(&self) -> Vec<Selector> {
        of_keys(&self.on, &self.cuboid, &self.sphere, &self.set, &None)
    }

    /// The energy of the fibres.
    pub fn law(&self) -> FibreLaw {
        FibreLaw { modulus: self.modulus, exponent: self.exponent, dispersion: self.dispersion }
    }

    /// The directions that the table gives itself.
    pub fn directions(&self) -> Option<FibreDirections> {
        let around = |AroundTable { axis, center, angle }: &AroundTable| FibreDirections::Around {
            axis: *axis,
            center: center.unwrap_or_default(),
            angle: *angle,
        };
        self.direction.map(FibreDirections::Same).or_else(|| self.around.as_ref().map(around))
    }
}

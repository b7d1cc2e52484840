//! Viscoelasticity by a Prony series.

use serde::Deserialize;

use crate::numbers::{check_positive, problem};
use crate::{BodyMesh, Refusal};

/// `[viscosity]`: stresses beside those of the law that relax with the time, a Prony series over any law. A strain that is applied suddenly and then constant has
/// the stress of the law times 1 + Σ g e^(−t/τ), with the ratio g and the time τ of each term: the law is the response after a long time. Engine only, and not
/// with `[plasticity]`.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct Viscosity {
    /// The terms, at least one.
    pub terms: Vec<PronyTerm>,
}

/// A term of the series: a spring and a damper in a row, beside the law.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct PronyTerm {
    /// g, its moduli over those of the law; positive. Ratios to the moduli of a sudden strain, as in some programs, are g/(1 + Σ g).
    pub modulus_ratio: f64,
    /// τ, its relaxation time, s; positive.
    pub time: f64,
}

impl Viscosity {
    /// A series of these terms.
    pub fn new(terms: Vec<PronyTerm>) -> Self {
        Self { terms }
    }

    pub(crate) fn check(&self) -> Result<(), Refusal> {
        if self.terms.is_empty() {
            return problem(
                "viscosity.terms",
                "is empty; give terms such as { modulus_ratio = 0.5, time = 0.1 }, or remove [viscosity]",
            );
        }
        self.terms.iter().enumerate().try_for_each(|(number, term)| {
            check_positive(&format!("viscosity.terms[{number}].modulus_ratio"), term.modulus_ratio, "")?;
            check_positive(&format!("viscosity.terms[{number}].time"), term.time, " of s")
        })
    }

    pub(crate) fn check_on(&self, _: &BodyMesh) -> Result<(), Refusal> {
        Ok(())
    }
}

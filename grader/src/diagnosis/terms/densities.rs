//! The energy density, as a part with C and a part with D.

use nalgebra::Matrix3;

use super::{Part, wrong};
use crate::diagnosis::fit::Formula;
use crate::reference::trial::{Input, Trial};

/// A deformation, and what the formulas are made of.
pub struct State {
    pub F: Matrix3<f64>,
    /// det F
    pub J: f64,
    /// tr(FᵀF)
    pub I: f64,
    pub C: f64,
    pub D: f64,
}

/// A number that depends on the deformation.
pub type Scalar = fn(&State) -> f64;

impl State {
    /// The state of a trial; `None` if it is inverted or has other input.
    pub fn of(trial: &Trial) -> Option<Self> {
        let &Input::Density { F, C, D } = &trial.input else { return None };
        let J = F.determinant();
        (J > 0.0).then(|| Self { F, J, I: F.norm_squared(), C, D })
    }

    /// J^(−2/3)
    pub fn g(&self) -> f64 {
        self.J.powf(-2.0 / 3.0)
    }

    /// Cofactors of F, the derivative of J.
    pub fn cofactors(&self) -> Matrix3<f64> {
        let (a, b, c) = (self.F.column(0), self.F.column(1), self.F.column(2));
        Matrix3::from_columns(&[b.cross(&c), c.cross(&a), a.cross(&b)])
    }

    fn green(&self) -> Matrix3<f64> {
        (self.F.transpose() * self.F - Matrix3::identity()) * 0.5
    }

    fn small_strain(&self) -> Matrix3<f64> {
        (self.F + self.F.transpose()) * 0.5 - Matrix3::identity()
    }
}

const SHAPE: &str =
    "The part with C is another one: it must stay zero when the body is blown up uniformly, and grow with a shear.";
const VOLUME: &str = "The part with D is another one: what does it cost to halve the volume, and to double it?";
/// About the power of J.
pub const POWER: &str =
    "Blow the body up uniformly: only the second term may notice. Which power of J takes the size out of the trace?";
const AT_REST: &str = "At rest there must be no energy. What does the first term give for the identity?";
const SQUARES: &str =
    "The first term needs the sum of the squares of all entries. A rotation must store no energy: does yours?";
const NO_POWER: &str = "The power of J has no effect: does it stand in the formula, and with an exponent that is divided as a floating-point number?";
const NOT_SQUARED: &str = "Compression stores energy too, so the second term may not change its sign with J − 1.";

/// Parts with C.
const SHAPES: &[Part<Scalar>] = &[
    ("", "", |s| s.g() * s.I - 3.0),
    ("wrong exponent", POWER, |s| s.J.powf(-1.0 / 3.0) * s.I - 3.0),
    ("wrong exponent", POWER, |s| s.J.powf(-4.0 / 3.0) * s.I - 3.0),
    ("wrong exponent", POWER, |s| s.J.powf(-3.0 / 2.0) * s.I - 3.0),
    ("wrong exponent", POWER, |s| s.J.powf(-5.0 / 3.0) * s.I - 3.0),
    ("wrong exponent", POWER, |s| s.I / s.J - 3.0),
    ("wrong exponent", POWER, |s| s.I / (s.J * s.J) - 3.0),
    ("wrong exponent", POWER, |s| s.J * s.I - 3.0),
    ("wrong exponent", POWER, |s| s.J.cbrt() * s.I - 3.0),
    ("sign of the exponent", POWER, |s| s.I / s.g() - 3.0),
    ("power of J without effect", NO_POWER, |s| s.I - 3.0),
    ("squared as a whole", SHAPE, |s| (s.g() * s.I - 3.0).powi(2)),
    ("root as a whole", SHAPE, |s| (s.g() * s.I - 3.0).max(0.0).sqrt()),
    ("3 inside the product", POWER, |s| s.g() * (s.I - 3.0)),
    ("missing constant", AT_REST, |s| s.g() * s.I),
    ("wrong constant", AT_REST, |s| s.g() * s.I - 1.0),
    ("wrong constant", AT_REST, |s| s.g() * s.I - 2.0),
    ("constant with the wrong sign", AT_REST, |s| s.g() * s.I + 3.0),
    ("3 without C", AT_REST, |s| s.g() * s.I - 3.0 / s.C),
    ("another material", SHAPE, |s| s.I - 3.0 - 2.0 * s.J.ln()),
    ("another material", SHAPE, |s| s.green().norm_squared()),
    ("another material", SHAPE, |s| s.small_strain().norm_squared()),
    ("another invariant", SHAPE, |s| s.g() * s.g() * s.cofactors().norm_squared() - 3.0),
    ("trace of F", SQUARES, |s| s.g() * s.F.trace() - 3.0),
    ("trace of F squared", SQUARES, |s| s.g() * s.F.trace().powi(2) - 3.0),
    ("trace of F F", SQUARES, |s| s.g() * (s.F * s.F).trace() - 3.0),
    ("root of the trace", SQUARES, |s| s.g() * s.I.sqrt() - 3.0),
    ("square of the trace", SQUARES, |s| s.g() * s.I * s.I - 3.0),
    ("sum of the entries", SQUARES, |s| s.g() * s.F.sum() - 3.0),
    ("only the diagonal of F", SQUARES, |s| s.g() * s.F.diagonal().norm_squared() - 3.0),
    ("norm of FᵀF", SQUARES, |s| s.g() * (s.F.transpose() * s.F).norm() - 3.0),
    ("trace for the determinant", "The power is one of det F.", |s| s.F.trace().powf(-2.0 / 3.0) * s.I - 3.0),
];

/// Parts with D.
const VOLUMES: &[Part<Scalar>] = &[
    ("", "", |s| (s.J - 1.0).powi(2)),
    ("not squared", NOT_SQUARED, |s| s.J - 1.0),
    ("absolute value for the square", VOLUME, |s| (s.J - 1.0).abs()),
    ("another volume term", VOLUME, |s| s.J.ln().powi(2)),
    ("another volume term", VOLUME, |s| s.J.ln()),
    ("another volume term", VOLUME, |s| s.J * s.J - 1.0),
    ("another volume term", VOLUME, |s| (s.J * s.J - 1.0).powi(2)),
    ("another volume term", VOLUME, |s| 0.5 * (s.J * s.J - 1.0) - s.J.ln()),
    ("another volume term", VOLUME, |s| (s.J - 1.0).powi(3)),
    ("another volume term", VOLUME, |s| (s.J - 1.0).powi(4)),
    ("another volume term", VOLUME, |s| s.J * s.J),
    ("another volume term", VOLUME, |s| s.J),
    ("another volume term", VOLUME, |s| (s.J + 1.0).powi(2)),
    ("another volume term", VOLUME, |s| (s.J - 3.0).powi(2)),
    ("another volume term", VOLUME, |s| (s.J - 1.0).powi(2) / s.J),
    ("another volume term", VOLUME, |s| s.J * (s.J - 1.0).powi(2)),
    ("another volume term", VOLUME, |s| s.green().trace().powi(2)),
    ("another volume term", VOLUME, |s| s.small_strain().trace().powi(2)),
    ("trace for the determinant", VOLUME, |s| (s.F.trace() - 1.0).powi(2)),
    ("trace for the determinant", VOLUME, |s| (s.F.trace() - 3.0).powi(2)),
    ("power of J on both terms", POWER, |s| s.g() * (s.J - 1.0).powi(2)),
];

/// Every part with C beside every part with D.
pub fn formulas<'a>() -> Vec<Formula<'a>> {
    let pairs = SHAPES.iter().flat_map(|shape| VOLUMES.iter().map(move |volume| (shape, volume)));
    let formula = |(&(one, told, shape), &(other, told_of_other, volume)): (&Part<Scalar>, &Part<Scalar>)| {
        let both = "Both parts are those of another material: read the formula on the page, term by term.";
        let own = match (one, other) {
            ("", _) | (_, "") => wrong(&[(one, told), (other, told_of_other)]),
            _ => Some(("another material", both)),
        };
        Formula {
            name: own,
            terms: &[("the term with C", 1.0), ("the term with D", 1.0)],
            values: Box::new(move |trial| {
                let s = State::of(trial)?;
                Some(vec![vec![s.C * shape(&s)], vec![s.D * volume(&s)]])
            }),
        }
    };
    let squared = Formula {
        name: Some((
            "determinant of FᵀF",
            "The determinant of FᵀF is not that of F: which of them does the page call J?",
        )),
        terms: &[("the term with C", 1.0), ("the term with D", 1.0)],
        values: Box::new(|trial: &Trial| {
            let s = State::of(trial)?;
            let J = s.J * s.J;
            Some(vec![vec![s.C * (J.powf(-2.0 / 3.0) * s.I - 3.0)], vec![s.D * (J - 1.0).powi(2)]])
        }),
    };
    std::iter::once(squared).chain(pairs.map(formula)).collect()
}

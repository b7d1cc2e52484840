//! The stress, as a multiple of F and two multiples of its cofactors.

use nalgebra::Matrix3;

use super::densities::{POWER, Scalar, State};
use super::{Part, wrong};
use crate::diagnosis::fit::Formula;

type Matrix = fn(&State) -> Matrix3<f64>;

const ALONG_F: &str = "The first part of the stress is along another matrix: what is the derivative of tr(FᵀF)?";
const COFACTORS: &str = "The second part of the stress is along another matrix: what is the derivative of det F?";
const PRODUCT: &str =
    "The part with C is a product of two functions of F: differentiate each of them, and check the powers of J.";
const SQUARE: &str = "The part with D is a square: write down its outer and its inner derivative.";
const LAW: &str =
    "This is the stress of another neo-Hookean law, one with a logarithm of J: differentiate the energy on the page.";
const VOLUME: &str = "The part with D belongs to another energy: differentiate the one on the page.";

/// Matrices of the first part.
const FIRST: &[Part<Matrix>] = &[
    ("", "", |s| s.F),
    ("transposed F", ALONG_F, |s| s.F.transpose()),
    ("identity for F", ALONG_F, |_| Matrix3::identity()),
    ("FᵀF for F", ALONG_F, |s| s.F.transpose() * s.F),
    ("inverse for F", ALONG_F, |s| s.F.try_inverse().unwrap_or_default().transpose()),
];

/// Matrices of the second part.
const SECOND: &[Part<Matrix>] = &[
    ("", "", State::cofactors),
    ("cofactors transposed", COFACTORS, |s| s.cofactors().transpose()),
    ("F for the cofactors", COFACTORS, |s| s.F),
    ("identity for the cofactors", COFACTORS, |_| Matrix3::identity()),
    ("absolute cofactors", COFACTORS, |s| s.cofactors().abs()),
    ("minors without their signs", COFACTORS, |s| {
        let cofactors = s.cofactors();
        Matrix3::from_fn(|i, j| if (i + j) % 2 == 0 { cofactors[(i, j)] } else { -cofactors[(i, j)] })
    }),
];

/// Factors of the first part.
const ON_FIRST: &[Part<Scalar>] = &[
    ("", "", State::g),
    ("wrong exponent", POWER, |_| 1.0),
    ("wrong exponent", POWER, |s| s.J.powf(-1.0 / 3.0)),
    ("wrong exponent", POWER, |s| 1.0 / s.g()),
    ("wrong exponent", POWER, |s| s.J.powf(-5.0 / 3.0)),
];

/// Factors of the second part with C.
const ON_SECOND: &[Part<Scalar>] = &[
    ("", "", |s| s.I * s.g() / s.J),
    ("factor J too many", PRODUCT, |s| s.I * s.g()),
    ("factor J missing", PRODUCT, |s| s.I * s.g() / (s.J * s.J)),
    ("wrong exponent", PRODUCT, |s| s.I * s.J.powf(-4.0 / 3.0)),
    ("wrong exponent", PRODUCT, |s| s.I * s.J.powf(-1.0 / 3.0)),
    ("wrong exponent", PRODUCT, |s| s.I * s.J.powf(-7.0 / 3.0)),
    ("wrong exponent", PRODUCT, |s| s.I / s.J),
    ("wrong exponent", PRODUCT, |s| s.I),
    ("wrong exponent", PRODUCT, |s| s.I * s.J.powf(5.0 / 3.0)),
    ("wrong exponent", PRODUCT, |s| s.I * s.J.powf(2.0 / 3.0)),
    ("trace less 3", PRODUCT, |s| (s.I - 3.0) * s.g() / s.J),
    ("trace less 3", PRODUCT, |s| (s.I - 3.0) * s.g()),
    ("missing trace", PRODUCT, |s| s.g() / s.J),
    ("missing trace", PRODUCT, State::g),
    ("trace of F", PRODUCT, |s| s.F.trace() * s.g() / s.J),
    ("root of the trace", PRODUCT, |s| s.I.sqrt() * s.g() / s.J),
    ("another material", PRODUCT, |s| 1.0 / s.J),
];

/// Factors of the second part with D.
const ON_SECOND_D: &[Part<Scalar>] = &[
    ("", "", |s| s.J - 1.0),
    ("factor J too many", SQUARE, |s| (s.J - 1.0) * s.J),
    ("factor J missing", SQUARE, |s| (s.J - 1.0) / s.J),
    ("not differentiated", SQUARE, |s| (s.J - 1.0).powi(2)),
    ("inner derivative alone", SQUARE, |_| 1.0),
    ("missing −1", SQUARE, |s| s.J),
    ("another volume term", VOLUME, |s| s.J.ln() / s.J),
    ("another volume term", VOLUME, |s| s.J.ln()),
    ("another volume term", VOLUME, |s| s.J - 1.0 / s.J),
    ("another volume term", VOLUME, |s| 1.0 / s.J),
    ("another volume term", VOLUME, |s| s.J + 1.0),
    ("another volume term", VOLUME, |s| s.J * s.J - 1.0),
];

/// Stresses with one wrong part, or with two wrong factors of the cofactors.
pub fn formulas<'a>() -> Vec<Formula<'a>> {
    let mut choices = vec![[0; 5]];
    choices.extend((1..FIRST.len()).map(|k| [k, 0, 0, 0, 0]));
    choices.extend((1..SECOND.len()).map(|k| [0, k, 0, 0, 0]));
    choices.extend((1..ON_FIRST.len()).map(|k| [0, 0, k, 0, 0]));
    let factors = (0..ON_SECOND.len()).flat_map(|k| (0..ON_SECOND_D.len()).map(move |l| [0, 0, 0, k, l]));
    choices.extend(factors.skip(1));
    // The same wrong power of J on both parts with C.
    choices.extend((1..ON_FIRST.len()).flat_map(|k| (1..ON_SECOND.len()).map(move |l| [0, 0, k, l, 0])));
    ON_SECOND_D.iter().map(of_logarithmic_law).chain(choices.into_iter().map(formula)).collect()
}

/// Stresses of the energy C (tr(FᵀF) − 3 − 2 ln J) with any part with D.
fn of_logarithmic_law<'a>(&(_, _, volume): &Part<Scalar>) -> Formula<'a> {
    Formula {
        name: Some(("another material", LAW)),
        terms: &[("the term along F", 2.0), ("the term with the logarithm of J", -2.0), ("the term with D", 2.0)],
        values: Box::new(move |trial| {
            let s = State::of(trial)?;
            let terms = [s.F * s.C, s.cofactors() * (s.C / s.J), s.cofactors() * (s.D * volume(&s))];
            Some(terms.map(|term| term.transpose().as_slice().to_vec()).to_vec())
        }),
    }
}

fn formula<'a>([a, b, c, d, e]: [usize; 5]) -> Formula<'a> {
    let ((one, two), (on_one, on_two, on_two_D)) = ((FIRST[a], SECOND[b]), (ON_FIRST[c], ON_SECOND[d], ON_SECOND_D[e]));
    let names = [(one.0, one.1), (two.0, two.1), (on_one.0, on_one.1), (on_two.0, on_two.1), (on_two_D.0, on_two_D.1)];
    Formula {
        name: wrong(&names),
        terms: &[("the term along F", 2.0), ("the derivative of the power of J", -2.0 / 3.0), ("the term with D", 2.0)],
        values: Box::new(move |trial| {
            let s = State::of(trial)?;
            let (first, second) = ((one.2)(&s), (two.2)(&s));
            let terms =
                [first * (s.C * (on_one.2)(&s)), second * (s.C * (on_two.2)(&s)), second * (s.D * (on_two_D.2)(&s))];
            Some(terms.map(|term| term.transpose().as_slice().to_vec()).to_vec())
        }),
    }
}

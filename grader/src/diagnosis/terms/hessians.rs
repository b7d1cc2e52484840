//! The second derivative of the energy density.

use nalgebra::{Matrix3, SMatrix, SVector};

use super::densities::State;
use crate::diagnosis::fit::{Formula, OTHER};
use crate::reference::trial::Trial;

type Matrix9 = SMatrix<f64, 9, 9>;

/// The terms, the last of which is not in the formula.
const TERMS: &[(&str, f64)] = &[
    ("the term along the identity", 2.0),
    ("the product of F and the cofactors", -4.0 / 3.0),
    ("the product of the cofactors and F", -4.0 / 3.0),
    ("the square of the cofactors with C", 10.0 / 9.0),
    ("the square of the cofactors with D", 2.0),
    ("the derivative of the cofactors with C", -2.0 / 3.0),
    ("the derivative of the cofactors with D", 2.0),
    (OTHER, 0.0),
];

/// Terms that are taken for one of the formula's.
const OTHERS: [fn(&State) -> Matrix9; 15] = [
    |s| square(s) * (s.D * s.J),
    |s| square(s) * (s.D * (s.J - 1.0)),
    |s| change_of_cofactors(s) * (s.D * s.J),
    |s| change_of_cofactors(s) * s.D,
    |s| change_of_cofactors(s) * (s.D * (s.J - 1.0).powi(2)),
    |s| change_of_cofactors(s) * (s.D * (s.J - 1.0) / s.J),
    |s| square(s) * (s.C * s.I * s.g() / s.J),
    |s| square(s) * (s.C * s.I * s.g()),
    |s| square(s) * (s.C * s.g() / (s.J * s.J)),
    |s| change_of_cofactors(s) * (s.C * s.I * s.g()),
    |s| change_of_cofactors(s) * (s.C * s.I * s.g() / (s.J * s.J)),
    |s| flat(&s.F) * flat(&s.F).transpose() * (s.C * s.g() / s.J),
    |s| mixed(s) * (s.C * s.g()),
    |s| mixed(s) * (s.C * s.g() / (s.J * s.J)),
    |s| Matrix9::identity() * s.C,
];

fn mixed(s: &State) -> Matrix9 {
    let (F, cofactors) = (flat(&s.F), flat(&s.cofactors()));
    F * cofactors.transpose() + cofactors * F.transpose()
}

/// The right terms, and the right terms with one more.
pub fn formulas<'a>() -> Vec<Formula<'a>> {
    let right = Formula {
        name: None,
        terms: &TERMS[..7],
        values: Box::new(|trial| Some(terms(&State::of(trial)?).map(|term| by_rows(&term)).to_vec())),
    };
    let with = |other: fn(&State) -> Matrix9| Formula {
        name: None,
        terms: TERMS,
        values: Box::new(move |trial: &Trial| {
            let s = State::of(trial)?;
            Some(terms(&s).iter().chain([&other(&s)]).map(by_rows).collect())
        }),
    };
    let wrongly = |(name, parts): Wrong| Formula {
        name: Some((name, if name.contains("columns") { FLATTENED } else { BLOCKS })),
        terms: &TERMS[..7],
        values: Box::new(move |trial: &Trial| {
            let s = State::of(trial)?;
            Some(terms_of(&s, parts(&s)).map(|term| by_rows(&term)).to_vec())
        }),
    };
    let signs = SIGNS.map(|(row, column)| Formula {
        name: Some(("one sign of the cross product with the wrong sign", CROSS)),
        terms: &TERMS[..7],
        values: Box::new(move |trial: &Trial| {
            let s = State::of(trial)?;
            Some(terms_of(&s, with_sign(&s, row, column)).map(|term| by_rows(&term)).to_vec())
        }),
    });
    let of_law = |volume| Formula {
        name: Some(("another material", LAW)),
        terms: LAW_TERMS,
        values: Box::new(move |trial: &Trial| Some(of_logarithmic_law(&State::of(trial)?, volume).to_vec())),
    };
    let laws = [Volume::Square, Volume::Logarithm].map(of_law);
    laws.into_iter().chain([right]).chain(OTHERS.map(with)).chain(PARTS.map(wrongly)).chain(signs).collect()
}

const LAW: &str =
    "This belongs to another neo-Hookean law, one with a logarithm of J: differentiate the energy on the page.";

/// The terms of the second derivative of C (tr(FᵀF) − 3 − 2 ln J) and a part with D.
const LAW_TERMS: &[(&str, f64)] = &[
    ("the term along the identity", 2.0),
    ("the square of the cofactors with C", 2.0),
    ("the derivative of the cofactors with C", -2.0),
    ("the square of the cofactors with D", 2.0),
    ("the derivative of the cofactors with D", 2.0),
];

/// A part with D: D (J − 1)² or D (ln J)².
#[derive(Clone, Copy)]
enum Volume {
    Square,
    Logarithm,
}

fn of_logarithmic_law(s: &State, volume: Volume) -> [Vec<f64>; 5] {
    let (J, square, derivative) = (s.J, square(s), change_of_cofactors(s));
    let [on_square, on_derivative] = match volume {
        Volume::Square => [1.0, J - 1.0],
        Volume::Logarithm => [(1.0 - J.ln()) / (J * J), J.ln() / J],
    };
    let terms = [
        Matrix9::identity() * s.C,
        square * (s.C / (J * J)),
        derivative * (s.C / J),
        square * (s.D * on_square),
        derivative * (s.D * on_derivative),
    ];
    terms.map(|term| by_rows(&term))
}

/// F and its cofactors, flattened, and the derivative of the cofactors.
type Parts = (SVector<f64, 9>, SVector<f64, 9>, Matrix9);

/// The name of a mistake, and the parts with it.
type Wrong = (&'static str, fn(&State) -> Parts);

const FLATTENED: &str = "F and its cofactors are flattened in different orders: how does the page flatten a matrix?";
const BLOCKS: &str =
    "A block of the derivative of the cofactors is not as on the page: look at the symmetry of the whole matrix.";

/// Parts in which a mistake is made.
const PARTS: [Wrong; 14] = [
    ("cofactors flattened by columns", |s| (flat(&s.F), flat(&s.cofactors().transpose()), change_of_cofactors(s))),
    ("F flattened by columns", |s| (flat(&s.F.transpose()), flat(&s.cofactors()), change_of_cofactors(s))),
    ("one block with the wrong sign", |s| with_block(s, 0, 1, -1.0)),
    ("one block with the wrong sign", |s| with_block(s, 0, 2, -1.0)),
    ("one block with the wrong sign", |s| with_block(s, 1, 0, -1.0)),
    ("one block with the wrong sign", |s| with_block(s, 1, 2, -1.0)),
    ("one block with the wrong sign", |s| with_block(s, 2, 0, -1.0)),
    ("one block with the wrong sign", |s| with_block(s, 2, 1, -1.0)),
    ("one block left out", |s| with_block(s, 0, 1, 0.0)),
    ("one block left out", |s| with_block(s, 0, 2, 0.0)),
    ("one block left out", |s| with_block(s, 1, 0, 0.0)),
    ("one block left out", |s| with_block(s, 1, 2, 0.0)),
    ("one block left out", |s| with_block(s, 2, 0, 0.0)),
    ("one block left out", |s| with_block(s, 2, 1, 0.0)),
];

const CROSS: &str = "The matrix that takes the cross product has one wrong sign: it must be minus its own transpose.";

/// The entries of the matrix that takes the cross product with a vector.
const SIGNS: [(usize, usize); 6] = [(0, 1), (0, 2), (1, 0), (1, 2), (2, 0), (2, 1)];

/// The parts with this entry of every block of the derivative of the cofactors negated.
fn with_sign(s: &State, row: usize, column: usize) -> Parts {
    let derivative = change_of_cofactors(s);
    let derivative =
        Matrix9::from_fn(|i, j| if (i % 3, j % 3) == (row, column) { -derivative[(i, j)] } else { derivative[(i, j)] });
    (flat(&s.F), flat(&s.cofactors()), derivative)
}

fn with_block(s: &State, row: usize, column: usize, factor: f64) -> Parts {
    let mut derivative = change_of_cofactors(s);
    derivative.fixed_view_mut::<3, 3>(3 * row, 3 * column).scale_mut(factor);
    (flat(&s.F), flat(&s.cofactors()), derivative)
}

fn terms(s: &State) -> [Matrix9; 7] {
    terms_of(s, (flat(&s.F), flat(&s.cofactors()), change_of_cofactors(s)))
}

fn terms_of(s: &State, (F, cofactors, derivative): Parts) -> [Matrix9; 7] {
    [
        Matrix9::identity() * (s.C * s.g()),
        F * cofactors.transpose() * (s.C * s.g() / s.J),
        cofactors * F.transpose() * (s.C * s.g() / s.J),
        cofactors * cofactors.transpose() * (s.C * s.I * s.g() / (s.J * s.J)),
        cofactors * cofactors.transpose() * s.D,
        derivative * (s.C * s.I * s.g() / s.J),
        derivative * (s.D * (s.J - 1.0)),
    ]
}

fn by_rows(matrix: &Matrix9) -> Vec<f64> {
    matrix.transpose().as_slice().to_vec()
}

fn flat(matrix: &Matrix3<f64>) -> SVector<f64, 9> {
    SVector::from_fn(|k, _| matrix[(k / 3, k % 3)])
}

fn square(s: &State) -> Matrix9 {
    let cofactors = flat(&s.cofactors());
    cofactors * cofactors.transpose()
}

/// ∂²J/∂F²: ε_ikm ε_jln F_mn in row (i, j) and column (k, l).
fn change_of_cofactors(s: &State) -> Matrix9 {
    Matrix9::from_fn(|row, column| {
        let (i, j, k, l) = (row / 3, row % 3, column / 3, column % 3);
        if i == k || j == l {
            return 0.0;
        }
        let sign = if ((i + 1) % 3 == k) == ((j + 1) % 3 == l) { 1.0 } else { -1.0 };
        sign * s.F[(3 - i - k, 3 - j - l)]
    })
}

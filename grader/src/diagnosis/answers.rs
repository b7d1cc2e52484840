//! Mistakes that change the whole answer: its sign, its size, the order of its entries.

use super::{Candidate, Case};
use crate::reference::trial::{Input, Observed, Trial};

/// Simplest first. The factor of a constant one is read off the answers.
pub fn candidates<'a>(cases: &[&Case]) -> Vec<Candidate<'a>> {
    let Some(first) = cases.first() else { return Vec::new() };
    let whole = whole(first.expected.numbers.len());
    let zero = format!("{whole} is zero. Is the result of the computation returned?");
    let negated = format!("{whole} has the opposite sign. {}", about_the_sign(first.trial.function));
    let mut all = vec![
        Candidate::new("zero", zero, |trial, answer| scaled(trial, answer, 0.0)),
        Candidate::new("negated", negated, |trial, answer| scaled(trial, answer, -1.0)),
    ];
    all.extend(constant(cases));
    let mut all: Vec<_> = all.into_iter().map(Candidate::of_entries).collect();
    all.extend(by_quantities());
    all.extend(reordered());
    all
}

/// The words for an answer of so many numbers.
pub(super) fn whole(numbers: usize) -> &'static str {
    if numbers == 1 { "The answer" } else { "Every entry" }
}

/// The likely causes if all signs are wrong.
fn about_the_sign(function: &str) -> &'static str {
    match function {
        "dV_linear_tetrahedron_dq" | "dV_spring_particle_particle_dq" | "assemble_forces" => {
            "Is the function asked for the energy's gradient or for the force?"
        }
        "d2V_linear_tetrahedron_dq2" | "assemble_stiffness" => {
            "Is the function asked for the derivative of the gradient or for that of the force?"
        }
        _ => "Compare its sign with that of the formula.",
    }
}

fn scaled(trial: &Trial, answer: &Observed, factor: f64) -> Option<Observed> {
    // Vertex numbers and selection matrices have no scale.
    let countable = matches!(trial.input, Input::Pick(_));
    // 0 · ∞ is NaN, but this mistake is a function that returns 0.
    let times = |x: &f64| if factor == 0.0 { 0.0 } else { x * factor };
    (!countable).then(|| Observed { numbers: answer.numbers.iter().map(times).collect(), ..answer.clone() })
}

/// One unknown factor for all answers.
fn constant<'a>(cases: &[&Case]) -> Option<Candidate<'a>> {
    let ratio = |case: &Case| {
        let entries = case.expected.numbers.iter().zip(&case.observed.numbers);
        let largest = entries.max_by(|a, b| a.0.abs().total_cmp(&b.0.abs()))?;
        (largest.0.abs() > 1e-3 * case.trial.scale(0)).then_some(largest.1 / largest.0)
    };
    let factor = cases.iter().find_map(|case| ratio(case)).filter(|factor| factor.is_finite() && *factor != 0.0)?;
    let name = written(factor);
    let whole = whole(cases.first()?.expected.numbers.len());
    let sentence = format!(
        "{whole} is {name} times as large as it should be. Which constant of the formula is missing, or there twice?"
    );
    Some(Candidate::new(format!("scaled by {name}"), sentence, move |trial, answer| scaled(trial, answer, factor)))
}

/// A factor as a person would write it: 0.5, 20, 1/6.
pub(super) fn written(factor: f64) -> String {
    let near = |denominator: &u32| {
        let numerator = factor * f64::from(*denominator);
        numerator.round() != 0.0 && (numerator - numerator.round()).abs() < 1e-6 * numerator.abs()
    };
    match (1..=120).find(near) {
        Some(denominator @ (1 | 2 | 4 | 5 | 10 | 20)) => {
            let denominator = f64::from(denominator);
            format!("{}", (factor * denominator).round() / denominator)
        }
        Some(denominator) => format!("{}/{denominator}", (factor * f64::from(denominator)).round()),
        None => format!("{factor:.6}"),
    }
}

/// A quantity of the input, where there is one.
type Quantity = fn(&Input) -> Option<f64>;

fn volume(input: &Input) -> Option<f64> {
    match input {
        Input::Kinetic { volume, .. } | Input::Quadrature { volume, .. } | Input::ElementMass { volume, .. } => {
            Some(*volume)
        }
        Input::Elastic(elastic) => Some(elastic.volume),
        _ => None,
    }
}

fn density(input: &Input) -> Option<f64> {
    match input {
        Input::Kinetic { density, .. } | Input::ElementMass { density, .. } | Input::MeshMass { density, .. } => {
            Some(*density)
        }
        _ => None,
    }
}

fn stiffness(input: &Input) -> Option<f64> {
    if let Input::Spring { stiffness, .. } = input { Some(*stiffness) } else { None }
}

fn by_quantities<'a>() -> Vec<Candidate<'a>> {
    let quantities: [(&str, Quantity); 3] = [("volume", volume), ("density", density), ("stiffness", stiffness)];
    let both = |(name, quantity): (&'static str, Quantity)| {
        let missing = format!(
            "The answer does not grow with the {name}. What are the units of the answer, and what does the {name} add to them?"
        );
        let twice = format!("The {name} is there once too often. What are the units of the answer?");
        [
            Candidate::new(format!("missing {name}"), missing, move |trial, answer| {
                scaled(trial, answer, 1.0 / quantity(&trial.input)?)
            }),
            Candidate::new(format!("scaled by {name}"), twice, move |trial, answer| {
                scaled(trial, answer, quantity(&trial.input)?)
            }),
        ]
    };
    quantities.into_iter().flat_map(both).collect()
}

fn reordered<'a>() -> Vec<Candidate<'a>> {
    vec![
        Candidate::new(
            "transposed",
            "Rows and columns are exchanged. Which index counts what, according to the page of the function?",
            |_, answer| {
                let [rows, columns] = answer.shape;
                (columns > 1).then(|| Observed::matrix(columns, rows, |i, j| answer.entry(j, i)))
            },
        ),
        Candidate::new("rows in reverse", "The rows are right, and in reverse order.", |_, answer| {
            let [rows, columns] = answer.shape;
            (rows > 1).then(|| Observed::matrix(rows, columns, |i, j| answer.entry(rows - 1 - i, j)))
        }),
        Candidate::new(
            "columns for rows",
            "The entries are right, but a matrix is flattened column by column. In which order does this course flatten it?",
            |_, answer| permuted(answer, 9, |k| 3 * (k % 3) + k / 3),
        ),
        Candidate::new(
            "grouped by coordinate",
            "The entries are right, but all x come first, then all y, then all z. In which order does q hold them?",
            |_, answer| {
                let n = answer.shape[0];
                let countable = n % 3 == 0 && n > 3;
                let vertices = (n / 3).max(1);
                countable.then(|| permuted(answer, n, |k| 3 * (k % vertices) + k / vertices)).flatten()
            },
        ),
    ]
}

/// The entries of a vector or of a square matrix of this size, taken from other places.
fn permuted(answer: &Observed, size: usize, from: impl Fn(usize) -> usize) -> Option<Observed> {
    match answer.shape {
        [rows, 1] if rows == size => Some(Observed::vector((0..rows).map(|k| answer.numbers[from(k)]).collect())),
        [rows, columns] if rows == size && columns == size => {
            Some(Observed::matrix(size, size, |i, j| answer.entry(from(i), from(j))))
        }
        _ => None,
    }
}

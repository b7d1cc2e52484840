//! Mistakes in some of the entries: left out, with the wrong sign or factor, or in each other's places.

use super::answers::written;
use super::{Candidate, Case};
use crate::reference::trial::{Input, Observed};

/// The place of an entry.
#[derive(Clone, Copy)]
pub struct Place {
    pub row: usize,
    pub column: usize,
    pub shape: [usize; 2],
}

/// A set of entries: its name, and which belong to it.
pub type Set = (&'static str, fn(&Place) -> bool);

/// Sets in matrices whose rows and columns are coordinates of vertices.
const BLOCKS: &[Set] = &[
    ("the diagonal", |p| p.row == p.column),
    ("the diagonal blocks", |p| p.row / 3 == p.column / 3),
    ("the upper triangle", |p| p.row <= p.column),
    ("the lower triangle", |p| p.row >= p.column),
    ("the part above the diagonal", |p| p.row < p.column),
    ("the part below the diagonal", |p| p.row > p.column),
    ("the upper blocks", |p| p.row / 3 <= p.column / 3),
    ("the lower blocks", |p| p.row / 3 >= p.column / 3),
    ("the blocks above the diagonal", |p| p.row / 3 < p.column / 3),
    ("the blocks below the diagonal", |p| p.row / 3 > p.column / 3),
    ("the entries between equal coordinates", |p| p.row % 3 == p.column % 3),
    ("the first vertex", |p| p.row < 3 || p.column < 3),
    ("the block of the first vertex", |p| p.row < 3 && p.column < 3),
    ("the last vertex", |p| p.row + 3 >= p.shape[0] || p.column + 3 >= p.shape[1]),
    ("the block of the last vertex", |p| p.row + 3 >= p.shape[0] && p.column + 3 >= p.shape[1]),
    ("the rows of the first vertex", |p| p.row < 3),
    ("the rows of the last vertex", |p| p.row + 3 >= p.shape[0]),
    ("the columns of the first vertex", |p| p.column < 3),
    ("the entries along x", |p| p.row % 3 == 0 && p.column % 3 == 0),
    ("the rows along x", |p| p.row % 3 == 0),
    ("the rows along y", |p| p.row % 3 == 1),
    ("the rows along z", |p| p.row % 3 == 2),
    ("the entries with z", |p| p.row % 3 == 2 || p.column % 3 == 2),
    ("the first row", |p| p.row == 0),
    ("the last row", |p| p.row + 1 == p.shape[0]),
    ("the first column", |p| p.column == 0),
    ("the last column", |p| p.column + 1 == p.shape[1]),
    ("the first quarter", |p| p.row < p.shape[0] / 4 && p.column < p.shape[1] / 4),
    ("the diagonal and its neighbours", |p| p.row.abs_diff(p.column) <= 1),
    ("the coupling of neighbours in the list", |p| (p.row / 3).abs_diff(p.column / 3) <= 1),
];

/// Sets in vectors of three coordinates for each vertex.
const COORDINATES: &[Set] = &[
    ("the first vertex", |p| p.row < 3),
    ("the second vertex", |p| p.row / 3 == 1),
    ("the last vertex", |p| p.row + 3 >= p.shape[0]),
    ("the x of each vertex", |p| p.row % 3 == 0),
    ("the y of each vertex", |p| p.row % 3 == 1),
    ("the z of each vertex", |p| p.row % 3 == 2),
    ("the first entry", |p| p.row == 0),
    ("the last entry", |p| p.row + 1 == p.shape[0]),
    ("the first half", |p| p.row < p.shape[0] / 2),
];

/// Sets in the force of a spring.
const ENDS: &[Set] = &[
    ("the first end", |p| p.row < 3),
    ("the second end", |p| p.row >= 3),
    ("the x of each end", |p| p.row % 3 == 0),
    ("the y of each end", |p| p.row % 3 == 1),
    ("the z of each end", |p| p.row % 3 == 2),
    ("the first entry", |p| p.row == 0),
    ("the last entry", |p| p.row == 5),
];

/// Sets in the derivative of the stress, whose rows and columns are the entries of a 3×3 matrix.
const MODULI: &[Set] = &[
    ("the diagonal", |p| p.row == p.column),
    ("the diagonal blocks", |p| p.row / 3 == p.column / 3),
    ("the upper triangle", |p| p.row <= p.column),
    ("the lower triangle", |p| p.row >= p.column),
    ("the part above the diagonal", |p| p.row < p.column),
    ("the part below the diagonal", |p| p.row > p.column),
    ("the upper blocks", |p| p.row / 3 <= p.column / 3),
    ("the lower blocks", |p| p.row / 3 >= p.column / 3),
    ("the blocks above the diagonal", |p| p.row / 3 < p.column / 3),
    ("the blocks below the diagonal", |p| p.row / 3 > p.column / 3),
    ("the diagonals of the blocks", |p| p.row % 3 == p.column % 3),
    ("the first row", |p| p.row == 0),
    ("the last row", |p| p.row + 1 == p.shape[0]),
    ("the first column", |p| p.column == 0),
    ("the last column", |p| p.column + 1 == p.shape[1]),
    ("the first three rows", |p| p.row < 3),
    ("the last three rows", |p| p.row >= 6),
    ("the first three columns", |p| p.column < 3),
    ("the last three columns", |p| p.column >= 6),
];

/// Sets in the stress, row by row.
const STRESS: &[Set] = &[
    ("the diagonal", |p| p.row % 4 == 0),
    ("the upper triangle", |p| p.row / 3 <= p.row % 3),
    ("the lower triangle", |p| p.row / 3 >= p.row % 3),
    ("the part above the diagonal", |p| p.row / 3 < p.row % 3),
    ("the part below the diagonal", |p| p.row / 3 > p.row % 3),
    ("the first row", |p| p.row < 3),
    ("the last row", |p| p.row >= 6),
    ("the first column", |p| p.row % 3 == 0),
    ("the last column", |p| p.row % 3 == 2),
    ("the first entry", |p| p.row == 0),
];

/// Sets in the shape functions, their gradients and the positions and velocities of a step.
const VERTICES: &[Set] = &[
    ("the first vertex", |p| p.row == 0),
    ("the second vertex", |p| p.row == 1),
    ("the third vertex", |p| p.row == 2),
    ("the last vertex", |p| p.row == 3),
    ("the component along x", |p| p.shape[1] > 1 && p.column == 0),
    ("the component along y", |p| p.shape[1] > 1 && p.column == 1),
    ("the component along z", |p| p.shape[1] > 1 && p.column == 2),
];

const STEP: &[Set] = &[("the positions", |p| p.row < p.shape[0] / 2), ("the velocities", |p| p.row >= p.shape[0] / 2)];

const MINIMUM: &[Set] = &[("the value returned", |p| p.row == 0), ("the point", |p| p.row > 0)];

/// The sets that a function's answers have.
pub fn sets(input: &Input, shape: [usize; 2]) -> &'static [Set] {
    match (input, shape) {
        (Input::Shape { .. }, _) => VERTICES,
        (Input::Step(_), _) => STEP,
        (Input::Minimum { .. }, _) => MINIMUM,
        (Input::Pick(_) | Input::Skinning { .. } | Input::Fixed { .. } | Input::Quadrature { .. }, _) | (_, [1, 1]) => {
            &[]
        }
        (Input::Density { .. }, [_, 1]) => STRESS,
        (Input::Density { .. }, _) => MODULI,
        (Input::Spring { .. }, _) => ENDS,
        (_, [_, 1]) => COORDINATES,
        _ => BLOCKS,
    }
}

/// All places of an answer, row by row.
pub fn places(shape: [usize; 2]) -> impl Iterator<Item = Place> {
    (0..shape[0] * shape[1]).map(move |k| Place { row: k / shape[1], column: k % shape[1], shape })
}

/// The mistakes that change the entries of one set.
pub fn candidates<'a>(cases: &[&Case]) -> Vec<Candidate<'a>> {
    let Some(first) = cases.first() else { return Vec::new() };
    if matches!(first.trial.input, Input::Step(_) | Input::Minimum { .. }) {
        return Vec::new();
    }
    let sets = sets(&first.trial.input, first.expected.shape);
    sets.iter().filter_map(|set| in_set(set, cases)).map(Candidate::of_entries).collect()
}

/// One factor in the set and one outside of it, where the answers have such.
fn in_set<'a>(&(name, contains): &Set, cases: &[&Case]) -> Option<Candidate<'a>> {
    let (inside, outside) = (factor(cases, contains)?, factor(cases, |p| !contains(p))?);
    let near = |a: f64, b: f64| (a - b).abs() < 1e-6;
    let (title, sentence) = if near(outside, 1.0) {
        (told(name, inside)?, format!("All other entries are right. Look at how you compute {name}."))
    } else if near(outside, 0.0) && near(inside, 1.0) {
        (
            format!("only {}", name.trim_start_matches("the ")),
            format!("Everything outside of {name} is zero; what stands there is right."),
        )
    } else if near(inside, 1.0) {
        (told(&format!("all but {name}"), outside)?, format!("Right in {name}, and wrong in all other entries."))
    } else {
        return None;
    };
    Some(Candidate::new(title, sentence, move |_, answer| {
        let times = |p: Place| if contains(&p) { inside } else { outside };
        let numbers = places(answer.shape).zip(&answer.numbers).map(|(p, x)| {
            let factor = times(p);
            if factor == 0.0 { 0.0 } else { x * factor }
        });
        Some(Observed { numbers: numbers.collect(), ..answer.clone() })
    }))
}

fn told(name: &str, factor: f64) -> Option<String> {
    let near = |wanted: f64| (factor - wanted).abs() < 1e-6;
    if near(1.0) {
        None
    } else if near(0.0) {
        Some(format!("missing {}", name.trim_start_matches("the ")))
    } else if near(-1.0) {
        Some(format!("{name} with the wrong sign"))
    } else {
        Some(format!("{name} scaled by {}", written(factor)))
    }
}

/// The factor of the entries that a set has, read off the largest one; `None` if it has none.
fn factor(cases: &[&Case], contains: impl Fn(&Place) -> bool) -> Option<f64> {
    let of_case = |case: &&Case| {
        if case.observed.shape != case.expected.shape {
            return None;
        }
        let inside = places(case.expected.shape).enumerate().filter(|(_, p)| contains(p)).map(|(k, _)| k);
        let largest =
            inside.max_by(|&a, &b| case.expected.numbers[a].abs().total_cmp(&case.expected.numbers[b].abs()))?;
        let (actual, expected) = (case.observed.numbers[largest], case.expected.numbers[largest]);
        (expected.abs() > 1e-3 * case.trial.scale(largest) && actual.is_finite()).then(|| actual / expected)
    };
    cases.iter().find_map(of_case).map(|factor| if factor.abs() < 1e-9 { 0.0 } else { factor })
}

/// Entries that stand in each other's places, some with the opposite sign.
pub fn exchanged<'a>(cases: &[&Case]) -> Option<Candidate<'a>> {
    let first = cases.first()?;
    let shape = first.expected.shape;
    // If all entries are multiples of one number, an exchange cannot be recognised.
    if matches!(first.trial.input, Input::ElementMass { .. } | Input::Step(_) | Input::Minimum { .. }) {
        return None;
    }
    let fits = |case: &Case| case.expected.shape == shape && case.observed.shape == shape;
    // A permutation can be recognised only from many numbers, and only if all trials have the same shape.
    if shape == [1, 1] || !cases.iter().all(|case| fits(case)) {
        return None;
    }
    let n = shape[0] * shape[1];
    let near = |case: &Case, k: usize, from: usize, sign: f64| {
        (case.observed.numbers[k] - sign * case.expected.numbers[from]).abs() <= 1e-6 * case.trial.scale(k)
    };
    let source = |k: usize| {
        let order = std::iter::once(k).chain(0..n).flat_map(|from| [(from, 1.0), (from, -1.0)]);
        order.into_iter().find(|&(from, sign)| cases.iter().all(|case| near(case, k, from, sign)))
    };
    let sources: Vec<(usize, f64)> = (0..n).map(source).collect::<Option<_>>()?;
    let mut used: Vec<usize> = sources.iter().map(|(from, _)| *from).collect();
    used.sort_unstable();
    used.dedup();
    let moved = sources.iter().enumerate().any(|(k, (from, _))| k != *from);
    let negative = sources.iter().any(|(_, sign)| *sign < 0.0);
    let (name, sentence) = match (moved, used.len() == n, negative) {
        (true, true, false) => order_of(&sources, shape),
        (true, _, true) => (
            "entries exchanged, with the wrong sign",
            "Entries of the right answer stand in other places, some with the opposite sign.",
        ),
        (true, false, false) => {
            ("entries repeated", "Some entries of the right answer occur twice, others not at all: check the indices.")
        }
        (false, ..) => ("some signs reversed", "Some entries have the opposite sign, and no other is wrong."),
    };
    Some(Candidate::new(name, sentence, move |_, answer| {
        let numbers = sources.iter().map(|&(from, sign)| sign * answer.numbers[from]).collect();
        (answer.shape == shape).then(|| Observed { numbers, ..answer.clone() })
    }))
}

const COORDINATE_ORDER: &str = "The entries are right, but x, y and z have changed places.";
const VERTEX_ORDER: &str =
    "The values are right, but belong to other vertices of the element. Which entry belongs to element[0]?";
const INDICES: &str = "The entries are right, but stand in each other's places: check the indices.";

/// The kind of a permutation.
fn order_of(sources: &[(usize, f64)], [rows, columns]: [usize; 2]) -> (&'static str, &'static str) {
    let by_rows: Vec<usize> = (0..rows).map(|i| sources[i * columns].0 / columns).collect();
    let rows_alone = (0..rows * columns).all(|k| sources[k].0 == by_rows[k / columns] * columns + k % columns);
    let blocks = |k: usize| {
        let (i, j) = (k / columns, k % columns);
        (i / 3 * 3 + j % 3) * columns + j / 3 * 3 + i % 3
    };
    if columns > 3 && (0..rows * columns).all(|k| sources[k].0 == blocks(k)) {
        return ("blocks transposed", "Each 3×3 block is transposed. Which index of a block belongs to which vertex?");
    }
    if columns <= 3 && rows == 4 && rows_alone {
        return ("wrong vertex order", VERTEX_ORDER);
    }
    let keeps = |of: fn(usize) -> usize| by_rows.iter().enumerate().all(|(i, &from)| of(i) == of(from));
    match columns {
        1 if rows % 3 == 0 && rows > 3 && keeps(|i| i / 3) => ("wrong order of coordinates", COORDINATE_ORDER),
        1 if rows % 3 == 0 && rows > 3 && keeps(|i| i % 3) => ("wrong vertex order", VERTEX_ORDER),
        _ => ("entries exchanged", INDICES),
    }
}

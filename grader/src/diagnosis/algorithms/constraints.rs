//! The selection of free coordinates.

use crate::diagnosis::switches::Switch;
use crate::reference::trial::{Input, Observed, Trial};

/// The decisions.
#[derive(Clone, Copy)]
pub struct Settings {
    /// The constrained vertices that are looked at.
    indices: fn(&[usize]) -> Vec<usize>,
    keeps: fn(usize, &[usize], usize) -> bool,
    /// The coordinates in the order of the rows.
    order: fn(usize) -> Vec<usize>,
    shape: Shape,
    value: f64,
}

#[derive(Clone, Copy)]
enum Shape {
    Compact,
    Transposed,
    /// A row of zeros for each coordinate that is left out.
    Square,
    /// Rows of zeros at the end.
    Padded,
    /// As many rows as `q_size` less three for each index, repeated or not.
    Counted,
}

/// The matrix of the course.
pub const RIGHT: Settings = Settings {
    indices: <[usize]>::to_vec,
    keeps: |coordinate, indices, _| !indices.contains(&(coordinate / 3)),
    order: |size| (0..size).collect(),
    shape: Shape::Compact,
    value: 1.0,
};

const WHICH: &str = "The wrong coordinates are kept: which three coordinates does a vertex have?";
const SOME: &str = "Not all of the vertices that are named are constrained.";
const REMOVAL: &str =
    "Removing a vertex from a list moves those behind it: which coordinates does the next index mean then?";
const SHAPE: &str =
    "The shape is wrong: how many rows does the matrix have, and what does it do to a vector of positions?";

/// The mistakes.
pub const SWITCHES: &[Switch<Settings>] = &[
    ("fixed instead of free", "The matrix keeps what is fixed. Which coordinates does the solver have to find?", |s| {
        s.keeps = |c, indices, _| indices.contains(&(c / 3));
    }),
    ("coordinates for vertices", WHICH, |s| s.keeps = |c, indices, _| !indices.contains(&c)),
    ("only x is fixed", WHICH, |s| s.keeps = |c, indices, _| c % 3 != 0 || !indices.contains(&(c / 3))),
    ("only y is fixed", WHICH, |s| s.keeps = |c, indices, _| c % 3 != 1 || !indices.contains(&(c / 3))),
    ("only z is fixed", WHICH, |s| s.keeps = |c, indices, _| c % 3 != 2 || !indices.contains(&(c / 3))),
    ("z is not fixed", WHICH, |s| s.keeps = |c, indices, _| c % 3 == 2 || !indices.contains(&(c / 3))),
    ("x is not fixed", WHICH, |s| s.keeps = |c, indices, _| c % 3 == 0 || !indices.contains(&(c / 3))),
    ("grouped by coordinate", WHICH, |s| s.keeps = |c, indices, n| !indices.contains(&(c % (n / 3).max(1)))),
    ("three coordinates from the index", WHICH, |s| {
        s.keeps = |c, indices, _| !indices.iter().any(|i| (*i..i + 3).contains(&c))
    }),
    (
        "off by one",
        "The neighbours of the vertices that are named are constrained: do indices count from 0 or from 1?",
        |s| {
            s.keeps = |c, indices, _| !indices.contains(&(c / 3 + 1));
        },
    ),
    (
        "off by one",
        "The neighbours of the vertices that are named are constrained: do indices count from 0 or from 1?",
        |s| {
            s.keeps = |c, indices, _| c < 3 || !indices.contains(&(c / 3 - 1));
        },
    ),
    ("coordinates off by one", WHICH, |s| s.keeps = |c, indices, _| c == 0 || !indices.contains(&((c - 1) / 3))),
    ("coordinates off by one", WHICH, |s| s.keeps = |c, indices, _| !indices.contains(&((c + 1) / 3))),
    ("one row for each vertex", WHICH, |s| s.keeps = |c, indices, n| c < n / 3 && !indices.contains(&c)),
    ("everything is kept", "Constrained coordinates are kept like the others.", |s| s.keeps = |_, _, _| true),
    ("the vertex between them is fixed", WHICH, |s| {
        s.keeps = |c, indices, _| !(indices.iter().min() <= Some(&(c / 3)) && Some(&(c / 3)) <= indices.iter().max());
    }),
    ("only the first index", SOME, |s| s.indices = |indices| indices[..indices.len().min(1)].to_vec()),
    ("only the last index", SOME, |s| s.indices = |indices| indices[indices.len().saturating_sub(1)..].to_vec()),
    ("last index left out", SOME, |s| s.indices = |indices| indices[..indices.len().saturating_sub(1)].to_vec()),
    ("first index left out", SOME, |s| s.indices = |indices| indices[indices.len().min(1)..].to_vec()),
    ("as many first vertices", "As many vertices are constrained as are named, but not those.", |s| {
        s.indices = |indices| (0..indices.len()).collect()
    }),
    ("vertex 0 never fixed", SOME, |s| s.indices = |indices| indices.iter().copied().filter(|i| *i != 0).collect()),
    ("taken for sorted", "Right where the indices ascend. May they come in any order?", |s| {
        s.indices = |indices| {
            let mut seen = Vec::new();
            // A single pass over the vertices misses an index that is smaller than the previous one.
            indices.iter().for_each(|i| {
                if seen.iter().all(|last| i >= last) {
                    seen.push(*i)
                }
            });
            seen
        };
    }),
    ("indices not adapted after a removal", REMOVAL, |s| {
        s.indices = |indices| {
            let mut left: Vec<usize> = (0..1000).collect();
            indices.iter().map(|&i| left.remove(i.min(left.len() - 1))).collect()
        };
    }),
    (
        "rows grouped by coordinate",
        "The rows are those of all x first, then of all y, then of all z. In which order does q hold them?",
        |s| {
            s.order = |size| (0..size).map(|k| 3 * (k % (size / 3)) + k / (size / 3)).collect();
        },
    ),
    ("rows in reverse", "The rows are in another order than the coordinates that they keep.", |s| {
        s.order = |size| (0..size).rev().collect()
    }),
    ("transposed", SHAPE, |s| s.shape = Shape::Transposed),
    ("rows of zeros kept", "Fixed coordinates have rows of zeros. How many rows does the matrix have?", |s| {
        s.shape = Shape::Square
    }),
    ("rows of zeros at the end", SHAPE, |s| s.shape = Shape::Padded),
    ("repeated indices counted twice", "An index that is named twice constrains one vertex all the same.", |s| {
        s.shape = Shape::Counted
    }),
    ("negated", "Every entry has the opposite sign.", |s| s.value = -1.0),
];

/// The matrix with these settings.
pub fn run(s: &Settings, trial: &Trial) -> Option<Observed> {
    let &Input::Fixed { q_size, ref indices } = &trial.input else { return None };
    let (looked_at, order) = ((s.indices)(indices), (s.order)(q_size));
    let keeps = |c: &usize| (s.keeps)(*c, &looked_at, q_size);
    let kept: Vec<usize> = order.into_iter().filter(keeps).collect();
    let one = |is: bool| if is { s.value } else { 0.0 };
    Some(match s.shape {
        Shape::Compact => Observed::matrix(kept.len(), q_size, |i, j| one(kept[i] == j)),
        Shape::Transposed => Observed::matrix(q_size, kept.len(), |i, j| one(kept[j] == i)),
        Shape::Square => Observed::matrix(q_size, q_size, |i, j| one(i == j && keeps(&i))),
        Shape::Padded => Observed::matrix(q_size, q_size, |i, j| one(kept.get(i) == Some(&j))),
        Shape::Counted => {
            let rows = q_size.checked_sub(3 * looked_at.len())?;
            Observed::matrix(rows, q_size, |i, j| one(kept.get(i) == Some(&j)))
        }
    })
}

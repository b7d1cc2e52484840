//! Kinetic energy and mass of an element.

use nalgebra::Vector3;

use super::{Part, wrong};
use crate::diagnosis::fit::Formula;
use crate::reference::trial::{Input, Trial};

const UNITS: &str = "Density and volume enter with another power: what are the units of the answer?";
const GROUPED: &str =
    "The matrix is built of 4×4 blocks, one for each coordinate: in which order does q hold the coordinates?";

const APART: &str = "Entries between different coordinates are filled: does a motion along x have momentum along y?";

/// A factor, from density and volume.
type Weight = fn(f64, f64) -> f64;

const WEIGHTS: &[Part<Weight>] = &[
    ("", "", |density, volume| density * volume),
    ("missing density", UNITS, |_, volume| volume),
    ("missing volume", UNITS, |density, _| density),
    ("density squared", UNITS, |density, volume| density * density * volume),
    ("volume squared", UNITS, |density, volume| density * volume * volume),
    ("divided by the volume", UNITS, |density, volume| density / volume),
];

/// Velocities of the vertices, density and volume.
fn moving(trial: &Trial) -> Option<([Vector3<f64>; 4], f64, f64)> {
    let Input::Kinetic { qdot, element, density, volume } = &trial.input else { return None };
    Some((element.map(|vertex| qdot.fixed_rows::<3>(3 * vertex).into_owned()), *density, *volume))
}

/// Sums of products over all pairs: of the same vertex, and of two different ones.
fn sums(v: &[Vector3<f64>; 4], product: impl Fn(&Vector3<f64>, &Vector3<f64>) -> f64) -> [f64; 2] {
    let same = v.iter().map(|v| product(v, v)).sum();
    let pairs = [(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)];
    [same, pairs.into_iter().map(|(a, b)| product(&v[a], &v[b])).sum()]
}

/// Kinetic energies: by pairs of vertices, and by coordinates.
pub fn kinetic_energies<'a>() -> Vec<Formula<'a>> {
    let by_pairs = |&(name, sentence, weight): &Part<Weight>| Formula {
        name: wrong(&[(name, sentence)]),
        terms: &[("the squares of the velocities", 0.05), ("the products of different velocities", 0.05)],
        values: Box::new(move |trial: &Trial| {
            let (v, density, volume) = moving(trial)?;
            Some(sums(&v, |a, b| a.dot(b)).map(|sum| vec![sum * weight(density, volume)]).to_vec())
        }),
    };
    let by_coordinates = Formula {
        name: None,
        terms: &[("the velocity along x", 0.05), ("the velocity along y", 0.05), ("the velocity along z", 0.05)],
        values: Box::new(|trial| {
            let (v, density, volume) = moving(trial)?;
            let along = |k: usize| vec![sums(&v, |a, b| a[k] * b[k]).iter().sum::<f64>() * density * volume];
            Some((0..3).map(along).collect())
        }),
    };
    WEIGHTS.iter().map(by_pairs).chain([by_coordinates]).collect()
}

/// Mass matrices: one coefficient for each kind of entry.
pub fn mass_matrices<'a>() -> Vec<Formula<'a>> {
    type Kind = fn(usize, usize) -> usize;
    const KINDS: [Part<Kind>; 3] = [
        ("", "", |i, j| 2 * usize::from(i / 3 != j / 3) + usize::from(i % 3 != j % 3)),
        ("coordinates not kept apart", APART, |i, j| 2 * usize::from(i / 3 != j / 3)),
        ("grouped by coordinate", GROUPED, |i, j| 2 * usize::from(i % 4 != j % 4) + usize::from(i / 4 != j / 4)),
    ];
    let orders_and_weights = KINDS.iter().flat_map(|kind| WEIGHTS.iter().map(move |weight| (kind, weight)));
    let formula = |(&(name, sentence, kind), &(units, told, weight)): (&Part<Kind>, &Part<Weight>)| Formula {
        name: wrong(&[(name, sentence), (units, told)]),
        terms: &[
            ("the diagonal", 0.1),
            ("the coupling of a vertex's coordinates", 0.0),
            ("the coupling of two vertices", 0.05),
            ("the coupling of different coordinates of two vertices", 0.0),
        ],
        values: Box::new(move |trial: &Trial| {
            let &Input::ElementMass { density, volume } = &trial.input else { return None };
            let entry = |n: usize, k: usize| if kind(n / 12, n % 12) == k { weight(density, volume) } else { 0.0 };
            Some((0..4).map(|k| (0..144).map(|n| entry(n, k)).collect()).collect())
        }),
    };
    orders_and_weights.map(formula).collect()
}

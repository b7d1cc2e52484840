//! Quadrature: the points at which the integrand is evaluated, and their weight.

use nalgebra::{DVector, Vector3};

use crate::diagnosis::switches::Switch;
use crate::reference::trial::{Input, Observed, Trial};

type Point = Vector3<f64>;

/// The rule.
#[derive(Clone, Copy)]
pub struct Settings {
    /// The corners, from the vertices of the mesh and the element.
    corners: fn(&[Point], &[usize; 4]) -> Vec<Point>,
    points: fn(&[Point]) -> Vec<Point>,
    /// The weight of the mean of the values, from the volume and the corners.
    weight: fn(f64, &[Point]) -> f64,
}

/// The rule of the course.
pub const RIGHT: Settings = Settings {
    corners: |V, element| element.iter().map(|&vertex| V[vertex]).collect(),
    points: |corners| vec![mean(corners)],
    weight: |volume, _| volume,
};

const POINT: &str = "The integrand is evaluated at another point: which one does the page name?";
const POINTS: &str = "The integrand is evaluated at several points. How many does a single-point rule have?";
const WEIGHT: &str = "The integrand is evaluated at the right point. What is its value multiplied by?";

/// The mistakes.
pub const SWITCHES: &[Switch<Settings>] = &[
    (
        "local for global indices",
        "The integrand was called in the middle of the first four vertices of the mesh; `element` says which are meant.",
        |s| {
            s.corners = |V, _| V[..4].to_vec();
        },
    ),
    (
        "mean of all vertices",
        "The integrand was called in the middle of the mesh; `element` says which four vertices are meant.",
        |s| {
            s.corners = |V, _| V.to_vec();
        },
    ),
    (
        "sum for mean",
        "The integrand was called at a point outside the element: a sum of four points is not yet their mean.",
        |s| {
            s.points = |corners| vec![corners.iter().sum()];
        },
    ),
    (
        "divided by 3",
        "The integrand was called at a point outside the element: of how many points is the mean taken?",
        |s| {
            s.points = |corners| vec![corners.iter().sum::<Point>() / 3.0];
        },
    ),
    (
        "divided by 2",
        "The integrand was called at a point outside the element: of how many points is the mean taken?",
        |s| {
            s.points = |corners| vec![corners.iter().sum::<Point>() / 2.0];
        },
    ),
    ("at the origin", POINT, |s| s.points = |_| vec![Point::zeros()]),
    ("at a vertex", POINT, |s| s.points = |corners| vec![corners[0]]),
    ("at a vertex", POINT, |s| s.points = |corners| vec![corners[1]]),
    ("at a vertex", POINT, |s| s.points = |corners| vec![corners[2]]),
    ("at a vertex", POINT, |s| s.points = |corners| vec![corners[3]]),
    ("at the middle of a face", POINT, |s| s.points = |corners| vec![mean(&corners[..3])]),
    ("at the middle of a face", POINT, |s| s.points = |corners| vec![mean(&corners[1..])]),
    ("at the middle of an edge", POINT, |s| s.points = |corners| vec![mean(&corners[..2])]),
    ("at the middle of an edge", POINT, |s| s.points = |corners| vec![mean(&[corners[0], corners[3]])]),
    ("at the mean of three vertices divided by 4", POINT, |s| {
        s.points = |corners| vec![corners[..3].iter().sum::<Point>() / 4.0]
    }),
    ("at the mean of three vertices divided by 4", POINT, |s| {
        s.points = |corners| vec![corners[1..].iter().sum::<Point>() / 4.0]
    }),
    ("at the middle of the bounding box", POINT, |s| {
        s.points = |corners| {
            let (low, high) = corners.iter().fold((corners[0], corners[0]), |(low, high), x| (low.inf(x), high.sup(x)));
            vec![(low + high) / 2.0]
        };
    }),
    ("at the vertices", POINTS, |s| s.points = <[Point]>::to_vec),
    ("at the vertices and the centroid", POINTS, |s| s.points = |corners| [corners, &[mean(corners)]].concat()),
    ("at the middles of the faces", POINTS, |s| {
        s.points = |c| [[0, 1, 2], [0, 1, 3], [0, 2, 3], [1, 2, 3]].map(|face| mean(&face.map(|i| c[i]))).to_vec();
    }),
    ("at the middles of the edges", POINTS, |s| {
        s.points = |c| [[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]].map(|edge| mean(&edge.map(|i| c[i]))).to_vec();
    }),
    ("four points", POINTS, |s| {
        let near = |c: &[Point]| (0..4).map(|i| mean(c) * 0.5527864045000421 + c[i] * 0.4472135954999579).collect();
        s.points = near;
    }),
    ("missing volume", "The mean value alone is no integral. Look at the unit of the answer.", |s| {
        s.weight = |_, _| 1.0
    }),
    ("volume squared", WEIGHT, |s| s.weight = |volume, _| volume * volume),
    ("divided by the volume", WEIGHT, |s| s.weight = |volume, _| 1.0 / volume),
    ("root of the volume", WEIGHT, |s| s.weight = |volume, _| volume.sqrt()),
    ("computes the volume anew", "The volume that is given must be used, not one computed from the vertices.", |s| {
        s.weight = |_, corners| signed_volume(corners);
    }),
    (
        "six times the volume, computed anew",
        "The volume that is given must be used, not one computed from the vertices.",
        |s| {
            s.weight = |_, corners| 6.0 * signed_volume(corners);
        },
    ),
    ("volume with a sign", WEIGHT, |s| s.weight = |volume, corners| volume * signed_volume(corners).signum()),
];

fn mean(points: &[Point]) -> Point {
    points.iter().sum::<Point>() / points.len() as f64
}

fn signed_volume(corners: &[Point]) -> f64 {
    (corners[1] - corners[0]).cross(&(corners[2] - corners[0])).dot(&(corners[3] - corners[0])) / 6.0
}

/// The integral with these settings.
pub fn run(s: &Settings, trial: &Trial) -> Option<Observed> {
    let Input::Quadrature { V, element, volume, integrand } = &trial.input else { return None };
    let corners = (s.corners)(V, element);
    let points = (s.points)(&corners);
    let sum: DVector<f64> = points.iter().map(|X| integrand.at(X)).reduce(|a, b| a + b)?;
    let integral = sum * ((s.weight)(*volume, &corners) / points.len() as f64);
    Some(Observed::vector(integral.as_slice().to_vec()))
}

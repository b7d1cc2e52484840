//! Skinning: an element for each display vertex, and the weights of its vertices.

use finite_elements_3d as solved;
use nalgebra::{Vector3, Vector4};

use crate::diagnosis::switches::Switch;
use crate::reference::trial::{Input, Observed, Trial};

type Phi = Vector4<f64>;

/// The distances of a display vertex from all elements, computed where they are asked for.
pub struct Far<'a> {
    elements: &'a [[Vector3<f64>; 4]],
    x: &'a Vector3<f64>,
}

/// The decisions for a display vertex.
#[derive(Clone, Copy)]
pub struct Settings {
    /// The element that a vertex follows, from the shape functions of all elements there and their distances.
    element: fn(&[Phi], &Far) -> Option<usize>,
    /// The same for a vertex that no element holds.
    outside: fn(&[Phi], &Far) -> Option<usize>,
    weights: fn(Phi) -> Phi,
    columns: fn([usize; 4]) -> [usize; 4],
    shares: Shares,
    /// An element holds a point if no weight is below minus this.
    slack: f64,
}

/// Vertices that get weights.
#[derive(Clone, Copy)]
enum Shares {
    /// The vertices of one element.
    One,
    /// The vertices of each element that contains the display vertex.
    All,
    /// The same, with weights divided by the number of these elements.
    Mean,
    /// The nearest vertex of the mesh.
    NearestVertex,
}

/// Right settings. Any of several elements that contain a vertex is right, but with wrong weights the choice changes the answer.
pub const RIGHT: [Settings; 4] = [
    BEST,
    Settings { element: |phis, _| phis.iter().position(|phi| phi.min() >= -1e-6), ..BEST },
    Settings { element: |phis, _| phis.iter().rposition(|phi| phi.min() >= -1e-6), ..BEST },
    Settings { element: |phis, _| largest(phis, |phi| phi.min()).map(|e| last_like(phis, e)), ..BEST },
];

const BEST: Settings = Settings {
    element: |phis, _| largest(phis, |phi| phi.min()),
    outside: |phis, _| largest(phis, |phi| phi.min()),
    weights: |phi| phi,
    columns: |element| element,
    shares: Shares::One,
    slack: 1e-6,
};

const CHOICE: &str = "The wrong element is followed: which one holds the display vertex?";
const OUTSIDE: &str = "Inside all is well. A display vertex outside of all elements follows the wrong one: read what the page says about it.";
const WEIGHTS: &str =
    "The right element is followed with wrong weights: what do the shape functions at the display vertex say?";
const ALL: &str = "On a shared face the row adds up to more than one: a display vertex follows a single element, the first that holds it.";
const COLUMNS: &str =
    "The weights are right, but they are given to the wrong vertices: what do the columns of the matrix count?";

/// The mistakes.
pub const SWITCHES: &[Switch<Settings>] = &[
    ("always the first element", CHOICE, |s| {
        s.element = |_, _| Some(0);
        s.outside = |_, _| Some(0);
    }),
    ("always the last element", CHOICE, |s| {
        s.element = |phis, _| phis.len().checked_sub(1);
        s.outside = |phis, _| phis.len().checked_sub(1);
    }),
    (
        "nearest instead of containing",
        "The element with the nearest centroid need not be the one that holds the point; a long thin one shows it.",
        |s| {
            s.element = |_, far| nearest(far, 0);
            s.outside = |_, far| nearest(far, 0);
        },
    ),
    ("nearest vertex decides", "The element with the nearest vertex need not be the one that holds the point.", |s| {
        s.element = |_, far| nearest(far, 1);
        s.outside = |_, far| nearest(far, 1);
    }),
    ("farthest element", CHOICE, |s| {
        s.element = |phis, _| largest(phis, |phi| -phi.min());
        s.outside = |phis, _| largest(phis, |phi| -phi.min());
    }),
    ("largest weight decides", CHOICE, |s| {
        s.element = |phis, _| largest(phis, |phi| phi.max());
        s.outside = |phis, _| largest(phis, |phi| phi.max());
    }),
    ("smallest largest weight decides", CHOICE, |s| {
        s.element = |phis, _| largest(phis, |phi| -phi.amax());
        s.outside = |phis, _| largest(phis, |phi| -phi.amax());
    }),
    ("upper bounds only", "Weights below zero are let in. When does an element hold a point?", |s| {
        s.element = |phis, _| phis.iter().position(|phi| phi.max() <= 1.0 + 1e-6).or(largest(phis, |phi| phi.min()));
    }),
    ("first weight not tested", "Not every weight is tested. When does an element hold a point?", |s| {
        s.element =
            |phis, _| phis.iter().position(|phi| phi.rows(1, 3).min() >= -1e-6).or(largest(phis, |phi| phi.min()));
    }),
    ("last weight not tested", "Not every weight is tested. When does an element hold a point?", |s| {
        s.element =
            |phis, _| phis.iter().position(|phi| phi.rows(0, 3).min() >= -1e-6).or(largest(phis, |phi| phi.min()));
    }),
    (
        "strict test",
        "A point on a face belongs to an element too: its row is empty, and the vertex jumps to the origin.",
        |s| {
            s.element = |phis, _| largest(phis, |phi| phi.min()).filter(|&e| phis[e].min() > 0.0);
            s.outside = |_, _| None;
        },
    ),
    (
        "empty row outside",
        "A display vertex may lie a little outside of all elements. It must still follow one of them.",
        |s| {
            s.outside = |_, _| None;
        },
    ),
    ("first element outside", OUTSIDE, |s| s.outside = |_, _| Some(0)),
    ("last element outside", OUTSIDE, |s| s.outside = |phis, _| phis.len().checked_sub(1)),
    (
        "nearest centroid outside",
        "Inside all is well. Outside, how far a point is from an element is not how far it is from its middle.",
        |s| {
            s.outside = |_, far| nearest(far, 0);
        },
    ),
    (
        "nearest vertex outside",
        "Inside all is well. Outside, how far a point is from an element is not how far it is from one of its vertices.",
        |s| {
            s.outside = |_, far| nearest(far, 1);
        },
    ),
    ("sum of negative weights outside", OUTSIDE, |s| {
        s.outside = |phis, _| largest(phis, |phi| phi.iter().filter(|w| **w < 0.0).sum())
    }),
    ("largest weights outside", OUTSIDE, |s| s.outside = |phis, _| largest(phis, |phi| -phi.amax())),
    ("squares of the weights outside", OUTSIDE, |s| s.outside = |phis, _| largest(phis, |phi| -phi.norm())),
    ("clamped", "Outside, some weights must be negative, else the surface does not come back where it was.", |s| {
        s.weights = |phi| phi.map(|w| w.max(0.0)) / phi.map(|w| w.max(0.0)).sum();
    }),
    ("clamped without a sum of one", WEIGHTS, |s| s.weights = |phi| phi.map(|w| w.max(0.0))),
    ("clamped between 0 and 1", WEIGHTS, |s| s.weights = |phi| phi.map(|w| w.clamp(0.0, 1.0))),
    ("absolute values of the weights", WEIGHTS, |s| s.weights = |phi| phi.abs()),
    ("equal weights", WEIGHTS, |s| s.weights = |_| Phi::repeat(0.25)),
    ("all weights one", WEIGHTS, |s| s.weights = |_| Phi::repeat(1.0)),
    ("only the largest weight", WEIGHTS, |s| {
        s.weights = |phi| Phi::from_fn(|i, _| if i == phi.imax() { phi[i] } else { 0.0 })
    }),
    ("only the vertex with the largest weight", WEIGHTS, |s| {
        s.weights = |phi| Phi::from_fn(|i, _| f64::from(i == phi.imax()))
    }),
    ("last vertex left out", WEIGHTS, |s| s.weights = |phi| Phi::new(phi[0], phi[1], phi[2], 0.0)),
    ("first vertex left out", WEIGHTS, |s| s.weights = |phi| Phi::new(0.0, phi[1], phi[2], phi[3])),
    ("only the first vertex", WEIGHTS, |s| s.weights = |phi| Phi::new(phi[0], 0.0, 0.0, 0.0)),
    ("squares of the weights", WEIGHTS, |s| s.weights = |phi| phi.component_mul(&phi)),
    (
        "local for global indices",
        "All weights stand in the first four columns: which vertices of the mesh do they belong to?",
        |s| {
            s.columns = |_| [0, 1, 2, 3];
        },
    ),
    ("sorted vertices", COLUMNS, |s| {
        s.columns = |mut element| {
            element.sort_unstable();
            element
        };
    }),
    ("wrong vertex order", COLUMNS, |s| s.columns = |[a, b, c, d]| [b, c, d, a]),
    ("wrong vertex order", COLUMNS, |s| s.columns = |[a, b, c, d]| [d, a, b, c]),
    ("wrong vertex order", COLUMNS, |s| s.columns = |[a, b, c, d]| [b, a, c, d]),
    ("wrong vertex order", COLUMNS, |s| s.columns = |[a, b, c, d]| [a, c, b, d]),
    ("wrong vertex order", COLUMNS, |s| s.columns = |[a, b, c, d]| [a, b, d, c]),
    ("wrong vertex order", COLUMNS, |s| s.columns = |[a, b, c, d]| [d, c, b, a]),
    ("all that hold it", ALL, |s| s.shares = Shares::All),
    // Round-off decides which elements hold a point on their faces.
    ("all that hold it", ALL, |s| (s.shares, s.slack) = (Shares::All, 0.0)),
    ("all that hold it", ALL, |s| (s.shares, s.slack) = (Shares::All, 1e-12)),
    ("all that hold it", ALL, |s| (s.shares, s.slack) = (Shares::All, 1e-9)),
    ("mean of all that hold it", "A display vertex follows a single element, not the mean of several.", |s| {
        s.shares = Shares::Mean
    }),
    (
        "nearest vertex",
        "Each display vertex follows one vertex of the mesh: a surface like that is full of steps.",
        |s| s.shares = Shares::NearestVertex,
    ),
];

fn largest(phis: &[Phi], of: impl Fn(&Phi) -> f64) -> Option<usize> {
    // The first of equal ones, unlike `max_by`.
    (0..phis.len()).reduce(|best, next| if of(&phis[next]) > of(&phis[best]) { next } else { best })
}

/// The last element whose smallest weight is that of this one.
fn last_like(phis: &[Phi], element: usize) -> usize {
    phis.iter().rposition(|phi| phi.min() == phis[element].min()).unwrap_or(element)
}

/// The element with the nearest centroid (0) or vertex (1).
fn nearest(far: &Far, to: usize) -> Option<usize> {
    let distances: Vec<_> = far.elements.iter().map(|X| distances(X, far.x)[to]).collect();
    (0..distances.len()).min_by(|&a, &b| distances[a].total_cmp(&distances[b]))
}

/// Distances of a point from an element's centroid and from its nearest vertex.
fn distances(X: &[Vector3<f64>; 4], x: &Vector3<f64>) -> [f64; 2] {
    let centroid = X.iter().sum::<Vector3<f64>>() / 4.0;
    [(centroid - x).norm(), X.iter().map(|vertex| (vertex - x).norm()).fold(f64::INFINITY, f64::min)]
}

/// The matrix with these settings.
pub fn run(s: &Settings, trial: &Trial) -> Option<Observed> {
    let Input::Skinning { V, T, V_skin } = &trial.input else { return None };
    let mut numbers = vec![0.0; V_skin.len() * V.len()];
    let elements: Vec<_> = T.iter().map(|t| t.map(|i| V[i])).collect();
    for (row, x) in V_skin.iter().enumerate() {
        let phis: Vec<_> = T.iter().map(|element| solved::phi_linear_tetrahedron(V, element, x)).collect();
        let mut put = |element: usize, share: f64| {
            let weights = (s.weights)(phis[element]) * share;
            let columns = (s.columns)(T[element]);
            (0..4).for_each(|i| numbers[row * V.len() + columns[i]] += weights[i]);
        };
        let holding: Vec<_> = (0..T.len()).filter(|&e| phis[e].min() >= -s.slack).collect();
        match s.shares {
            Shares::NearestVertex => {
                let distance = |vertex: &usize| (V[*vertex] - x).norm();
                let found = (0..V.len()).min_by(|a, b| distance(a).total_cmp(&distance(b)))?;
                numbers[row * V.len() + found] = 1.0;
            }
            Shares::All if !holding.is_empty() => holding.iter().for_each(|&e| put(e, 1.0)),
            Shares::Mean if !holding.is_empty() => holding.iter().for_each(|&e| put(e, 1.0 / holding.len() as f64)),
            _ => {
                let choose = if holding.is_empty() { s.outside } else { s.element };
                if let Some(element) = choose(&phis, &Far { elements: &elements, x }) {
                    put(element, 1.0);
                }
            }
        }
    }
    Some(Observed { shape: [V_skin.len(), V.len()], numbers, ..Observed::default() })
}

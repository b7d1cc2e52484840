//! Shape functions and their gradients: edges, the inverse of their matrix, and the vertex that is left.

use nalgebra::{Matrix3, Matrix4x3, Vector3, Vector4};

use crate::diagnosis::switches::Switch;
use crate::reference::trial::{Input, Observed, Trial};

type Point = Vector3<f64>;

/// The steps of the computation.
#[derive(Clone, Copy)]
pub struct Settings {
    vertices: fn([usize; 4]) -> [usize; 4],
    /// Columns of the matrix that is inverted, from the corners and the point.
    edges: fn(&[Point; 4], &Point) -> Matrix3<f64>,
    inverse: fn(&Matrix3<f64>) -> Option<Matrix3<f64>>,
    /// The vector that is expressed in edges, from the corners and the point.
    relative: fn(&[Point; 4], &Point) -> Point,
    /// The three shape functions, after their computation; only they are changed, or only what is summed up.
    signs: [f64; 3],
    summed: [f64; 3],
    /// The shape function of the vertex at which the edges begin, from the sum of the others and the first of them; and its
    /// gradient likewise.
    rest: fn(f64, f64) -> f64,
    gradient_of_rest: fn(&Point, &Point) -> Point,
    /// The gradient of the remaining shape function adds up rows of the inverse in place of columns.
    sums_rows: bool,
    place_of_rest: usize,
    /// The change of a finished shape function.
    finished: fn(f64) -> f64,
    factor: fn(&Matrix3<f64>) -> f64,
    unit_gradients: bool,
}

/// The computation of the course.
pub const RIGHT: Settings = Settings {
    vertices: |element| element,
    edges: |X, _| Matrix3::from_columns(&[X[1] - X[0], X[2] - X[0], X[3] - X[0]]),
    inverse: |edges| edges.try_inverse(),
    relative: |X, x| x - X[0],
    signs: [1.0; 3],
    summed: [1.0; 3],
    rest: |sum, _| 1.0 - sum,
    gradient_of_rest: |sum, _| -sum,
    sums_rows: false,
    place_of_rest: 0,
    finished: |phi| phi,
    factor: |_| 1.0,
    unit_gradients: false,
};

const EDGES: &str =
    "The edges are not those that the page takes: at which vertex does each begin, and where does it end?";
const RELATIVE: &str = "The point is measured from the wrong place: from which vertex do the edges begin?";
const REST: &str =
    "Three shape functions are right, the one of the vertex where the edges begin is not: what do all four add up to?";
const ONE: &str = "One of the shape functions has the wrong sign: in which order do its edges enter the product?";
const SIGN: &str = "Shape functions may be negative outside of the element, and its vertices may come in any order: no sign is to be removed.";
const SIZE: &str = "The gradients have the wrong size: what are they divided by?";

/// The mistakes.
pub const SWITCHES: &[Switch<Settings>] = &[
    ("sorted vertices", "The element's vertices are sorted. Which entry belongs to element[0]?", |s| {
        s.vertices = |mut element| {
            element.sort_unstable();
            element
        };
    }),
    ("wrong sign of one vertex", ONE, |s| s.signs[0] = -1.0),
    ("wrong sign of one vertex", ONE, |s| s.signs[1] = -1.0),
    ("wrong sign of one vertex", ONE, |s| s.signs[2] = -1.0),
    ("one vertex left out of the sum", REST, |s| s.summed[0] = 0.0),
    ("one vertex left out of the sum", REST, |s| s.summed[1] = 0.0),
    ("one vertex left out of the sum", REST, |s| s.summed[2] = 0.0),
    ("wrong sign in the sum", REST, |s| s.summed[0] = -1.0),
    ("wrong sign in the sum", REST, |s| s.summed[1] = -1.0),
    ("wrong sign in the sum", REST, |s| s.summed[2] = -1.0),
    ("first vertex left out", REST, |s| {
        s.rest = |_, _| 0.0;
        s.gradient_of_rest = |_, _| Point::zeros();
    }),
    ("first shape function is one", REST, |s| s.rest = |_, _| 1.0),
    ("first vertex with the wrong sign", REST, |s| {
        s.rest = |sum, _| sum - 1.0;
        s.gradient_of_rest = |sum, _| *sum;
    }),
    ("first vertex without the one", REST, |s| s.rest = |sum, _| -sum),
    ("first vertex is the sum of the others", REST, |s| s.rest = |sum, _| sum),
    ("first vertex from one other alone", REST, |s| {
        s.rest = |_, first| 1.0 - first;
        s.gradient_of_rest = |_, first| -first
    }),
    ("first vertex is the mean of the others", REST, |s| {
        s.rest = |sum, _| sum / 3.0;
        s.gradient_of_rest = |sum, _| sum / -3.0
    }),
    ("rows for columns in the sum", REST, |s| s.sums_rows = true),
    ("sum added to one", REST, |s| s.rest = |sum, _| 1.0 + sum),
    (
        "wrong vertex order",
        "The values are right, but belong to other vertices of the element. Which entry belongs to element[0]?",
        |s| {
            s.place_of_rest = 3;
        },
    ),
    ("edges of another vertex", EDGES, |s| {
        s.edges = |X, _| Matrix3::from_columns(&[X[1] - X[0], X[2] - X[0], X[3] - X[1]])
    }),
    ("edges one after the other", EDGES, |s| {
        s.edges = |X, _| Matrix3::from_columns(&[X[1] - X[0], X[2] - X[1], X[3] - X[2]])
    }),
    ("edges to the last vertex", EDGES, |s| {
        s.edges = |X, _| Matrix3::from_columns(&[X[0] - X[3], X[1] - X[3], X[2] - X[3]])
    }),
    ("edges from the point", EDGES, |s| s.edges = |X, x| Matrix3::from_columns(&[X[1] - x, X[2] - x, X[3] - x])),
    ("positions for edges", EDGES, |s| s.edges = |X, _| Matrix3::from_columns(&[X[1], X[2], X[3]])),
    ("positions of the first three vertices for edges", EDGES, |s| {
        s.edges = |X, _| Matrix3::from_columns(&[X[0], X[1], X[2]])
    }),
    ("edges with the wrong sign", EDGES, |s| {
        s.edges = |X, _| Matrix3::from_columns(&[X[0] - X[1], X[0] - X[2], X[0] - X[3]])
    }),
    ("transposed", "The matrix of edges is transposed. Are its edges columns or rows?", |s| {
        s.inverse = |edges| edges.transpose().try_inverse()
    }),
    ("not inverted", EDGES, |s| s.inverse = |edges| Some(*edges)),
    ("transposed for inverse", EDGES, |s| s.inverse = |edges| Some(edges.transpose())),
    ("not measured from a vertex", RELATIVE, |s| s.relative = |_, x| *x),
    ("measured from another vertex", RELATIVE, |s| s.relative = |X, x| x - X[1]),
    ("measured from another vertex", RELATIVE, |s| s.relative = |X, x| x - X[2]),
    ("measured from another vertex", RELATIVE, |s| s.relative = |X, x| x - X[3]),
    ("measured from the centroid", RELATIVE, |s| s.relative = |X, x| x - (X[0] + X[1] + X[2] + X[3]) / 4.0),
    ("measured backwards", RELATIVE, |s| s.relative = |X, x| X[0] - x),
    ("absolute values", SIGN, |s| s.finished = f64::abs),
    ("clamped", SIGN, |s| s.finished = |phi| phi.max(0.0)),
    ("clamped between 0 and 1", SIGN, |s| s.finished = |phi| phi.clamp(0.0, 1.0)),
    ("volume without its sign", SIGN, |s| s.factor = |edges| edges.determinant().signum()),
    ("not divided by the volume", SIZE, |s| s.factor = |edges| edges.determinant()),
    ("not divided by the volume", SIZE, |s| s.factor = |edges| edges.determinant() / 6.0),
    ("not divided by the volume", SIZE, |s| s.factor = |edges| edges.determinant().abs()),
    ("divided by the volume for six times the volume", SIZE, |s| s.factor = |_| 6.0),
    ("divided by six times too much", SIZE, |s| s.factor = |_| 1.0 / 6.0),
    ("divided by another volume", SIZE, |s| s.factor = |_| 3.0),
    ("divided by another volume", SIZE, |s| s.factor = |_| 2.0),
    ("divided by another volume", SIZE, |s| s.factor = |_| 0.5),
    ("unit length", SIZE, |s| s.unit_gradients = true),
];

/// The shape functions, or their gradients, with these settings.
pub fn run(s: &Settings, trial: &Trial) -> Option<Observed> {
    let Input::Shape { V, element, x } = &trial.input else { return None };
    let X = (s.vertices)(*element).map(|vertex| V[vertex]);
    let edges = (s.edges)(&X, x);
    let inverse = (s.inverse)(&edges).unwrap_or_default() * (s.factor)(&edges);
    if trial.function == "phi_linear_tetrahedron" {
        let p = (inverse * (s.relative)(&X, x)).component_mul(&Point::from(s.signs));
        let rest = (s.rest)(p.dot(&Point::from(s.summed)), p[0]);
        let phi = match s.place_of_rest {
            0 => Vector4::new(rest, p[0], p[1], p[2]),
            _ => Vector4::new(p[0], p[1], p[2], rest),
        };
        return Some(Observed::vector(phi.iter().map(|phi| (s.finished)(*phi)).collect()));
    }
    let rows = [0, 1, 2].map(|i| inverse.row(i).transpose() * s.signs[i]);
    let sum = rows[0] * s.summed[0] + rows[1] * s.summed[1] + rows[2] * s.summed[2];
    let sum = if s.sums_rows { Point::from(rows.map(|row| row.sum())) } else { sum };
    let rest = (s.gradient_of_rest)(&sum, &rows[0]);
    let all = if s.place_of_rest == 0 { [rest, rows[0], rows[1], rows[2]] } else { [rows[0], rows[1], rows[2], rest] };
    let all = all.map(|g| if s.unit_gradients { g.normalize() } else { g });
    let D = Matrix4x3::from_fn(|i, j| (s.finished)(all[i][j]));
    Some(Observed::matrix(4, 3, |i, j| D[(i, j)]))
}

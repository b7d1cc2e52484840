//! Points of elements, for integrals of high degree, and shape functions at them.

use fem_model::BodyMesh;
use nalgebra::Vector3;

/// Index of the quadrature rule: exact for polynomials of degree 7.
const RULE: u32 = 3;

/// A point of every element of a mesh.
#[derive(Clone, Debug, PartialEq)]
pub struct Point {
    /// Barycentric coordinates.
    pub barycentric: Vec<f64>,
    /// Part of the element's volume.
    pub weight: f64,
    /// Shape functions of the element's nodes.
    pub values: Vec<f64>,
}

impl Point {
    /// Undeformed position in an element with these nodes, whose corners come first, m.
    pub fn place(&self, mesh: &BodyMesh, nodes: &[usize]) -> Vector3<f64> {
        nodes.iter().zip(&self.barycentric).map(|(&node, &weight)| mesh.vertices()[node] * weight).sum()
    }
}

/// The points of a rule of degree 7 in the elements of a mesh.
pub fn points(mesh: &BodyMesh) -> Vec<Point> {
    let element = mesh.element();
    let point = |(L, weight): (Vec<f64>, f64)| Point { values: element.values(&L), barycentric: L, weight };
    rule(element.dimension, RULE).into_iter().map(point).collect()
}

/// A rule for integrals over a triangle or a tetrahedron that is exact for polynomials of degree 2s + 1: points in barycentric coordinates with
/// weights that add up to 1. A. Grundmann and H. M. Möller, "Invariant integration formulas for the n-simplex by combinatorial methods", SIAM
/// Journal on Numerical Analysis 15, 1978.
fn rule(dimension: usize, s: u32) -> Vec<(Vec<f64>, f64)> {
    let corners = dimension + 1;
    let dimension = dimension as u32;
    let mut points = Vec::new();
    let degree = f64::from(2 * s + 1);
    for i in 0..=s {
        let below = degree + f64::from(dimension) - 2.0 * f64::from(i);
        let sign = if i % 2 == 0 { 1.0 } else { -1.0 };
        // Times the factorial of the dimension, so that the weights add up to 1 instead of to the volume of the unit simplex.
        let weight = factorial(dimension) * sign * 0.25f64.powi(s as i32) * below.powf(degree)
            / (factorial(i) * factorial(2 * s + 1 + dimension - i));
        for counts in compositions(s - i, corners) {
            points.push((counts.into_iter().map(|count| f64::from(2 * count + 1) / below).collect(), weight));
        }
    }
    points
}

/// All ways to write a number as a sum of so many numbers, the first ones smallest first.
fn compositions(total: u32, parts: usize) -> Vec<Vec<u32>> {
    if parts == 1 {
        return vec![vec![total]];
    }
    let with_first = |first: u32| {
        let rest = compositions(total - first, parts - 1);
        rest.into_iter().map(move |rest| [vec![first], rest].concat())
    };
    (0..=total).flat_map(with_first).collect()
}

fn factorial(n: u32) -> f64 {
    (1..=n).map(f64::from).product()
}

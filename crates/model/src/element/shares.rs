//! The parts of an element's mass and load that its nodes carry: integrals of products of shape functions.
//!
//! They are sums of rational numbers, which come out exactly rounded: O. C. Zienkiewicz and R. L. Taylor, The Finite Element Method 1, section 8.8,
//! gives ∫ L₀^a L₁^b … over a simplex of unit volume in d dimensions, d! a! b! … / (a + b + … + d)!.

use super::{Element, ShapeFunction};

/// A common multiple of the denominators of all integrals here: of degree 4 in space, 7!.
const DENOMINATOR: f64 = 5040.0;

const ONE: ShapeFunction = ShapeFunction(&[(1.0, &[])]);

/// The part of a uniform load on an element that each of its nodes carries: the mean of its shape function. The load of a quadratic
/// triangle acts at the middles of its sides.
pub fn load_shares(element: &Element) -> Vec<f64> {
    let mean = |function| integral(element.dimension, [function, &ONE]) / DENOMINATOR;
    element.shape_functions.iter().map(mean).collect()
}

/// The part of a uniform load on a face of the surface (an edge of a flat body) that each of its nodes carries: Simpson's rule on a
/// quadratic edge.
pub fn face_shares(element: &Element) -> Vec<f64> {
    let face = element.faces[0];
    let corners = &face[..element.dimension];
    let is_on_face = |&&(_, of): &&(f64, &'static [usize])| of.iter().all(|i| corners.contains(i));
    let mean = |&node: &usize| {
        let terms = element.shape_functions[node].0.iter().filter(is_on_face);
        terms.map(|(factor, of)| factor * of_powers(element.dimension - 1, of)).sum::<f64>() / DENOMINATOR
    };
    face.iter().map(mean).collect()
}

/// The consistent mass matrix of an element of `N` nodes and unit mass: ∫ φ_i φ_j over its volume.
pub fn mass_shares<const N: usize>(element: &Element) -> [[f64; N]; N] {
    std::array::from_fn(|i| std::array::from_fn(|j| mass_share(element, i, j)))
}

/// An entry of that matrix.
pub fn mass_share(element: &Element, i: usize, j: usize) -> f64 {
    let functions = element.shape_functions;
    integral(element.dimension, [&functions[i], &functions[j]]) / DENOMINATOR
}

/// The part of an element's mass that each of its nodes carries where the mass is lumped. Row sums of the consistent mass would leave
/// the corners of a quadratic triangle without any, so the diagonal is scaled instead: Hinton, Rock and Zienkiewicz, A Note on
/// Mass Lumping and Related Processes in the Finite Element Method (1976).
pub fn lumped_mass_shares(element: &Element) -> Vec<f64> {
    let square = |function| integral(element.dimension, [function, function]);
    let diagonal: Vec<f64> = element.shape_functions.iter().map(square).collect();
    let trace: f64 = diagonal.iter().sum();
    diagonal.into_iter().map(|entry| entry / trace).collect()
}

/// ∫ φ ψ over an element of unit volume, times the denominator.
fn integral(dimension: usize, [a, b]: [&ShapeFunction; 2]) -> f64 {
    let terms = a.0.iter().flat_map(|a| b.0.iter().map(move |b| (a.0 * b.0, [a.1, b.1].concat())));
    terms.map(|(factor, of)| factor * of_powers(dimension, &of)).sum()
}

/// The integral of a product of barycentric coordinates, times the denominator.
fn of_powers(dimension: usize, of: &[usize]) -> f64 {
    let power = |by: usize| of.iter().filter(|&&i| i == by).count();
    let factorial = |n: usize| (1..=n).product::<usize>() as f64;
    let powers: f64 = (0..4).map(|by| factorial(power(by))).product();
    DENOMINATOR / factorial(of.len() + dimension) * factorial(dimension) * powers
}

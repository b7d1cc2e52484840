//! Mistakes in `quadrature_single_point`.

use grader_child::Integrand;
use nalgebra::{DVector, Vector3};

use super::Variant;

/// The mistakes that are known.
pub const VARIANTS: &[Variant] = &[
    variant!(
        quadrature_single_point,
        "local for global indices",
        "The integrand was called in the middle of the first four vertices of the mesh; `element` says which are meant.",
        in_the_first_four
    ),
    variant!(
        quadrature_single_point,
        "sum for mean",
        "The integrand was called at a point outside the element: a sum of four points is not yet their mean.",
        at_the_sum
    ),
    variant!(
        quadrature_single_point,
        "missing volume",
        "The mean value alone is no integral. Look at the unit of the answer.",
        without_volume
    ),
    variant!(
        quadrature_single_point,
        "scaled by 1/6",
        "The volume that is given is the element's own; no further factor belongs to it.",
        times_volume_over_6
    ),
    variant!(
        quadrature_single_point,
        "computes the volume anew",
        "The volume that is given must be used, not one computed from the vertices.",
        own_volume
    ),
    variant!(
        quadrature_single_point,
        "evaluated at the wrong point",
        "The integrand was called at a vertex. At which point does each shape function have its mean value?",
        at_a_vertex
    ),
];

fn sum(V: &[Vector3<f64>], element: &[usize; 4]) -> Vector3<f64> {
    element.iter().map(|&vertex| V[vertex]).sum()
}

fn in_the_first_four(V: &[Vector3<f64>], _: &[usize; 4], volume: f64, integrand: Integrand) -> DVector<f64> {
    integrand(&(sum(V, &[0, 1, 2, 3]) / 4.0)) * volume
}

fn at_the_sum(V: &[Vector3<f64>], element: &[usize; 4], volume: f64, integrand: Integrand) -> DVector<f64> {
    integrand(&sum(V, element)) * volume
}

fn without_volume(V: &[Vector3<f64>], element: &[usize; 4], _: f64, integrand: Integrand) -> DVector<f64> {
    integrand(&(sum(V, element) / 4.0))
}

fn times_volume_over_6(V: &[Vector3<f64>], element: &[usize; 4], volume: f64, integrand: Integrand) -> DVector<f64> {
    integrand(&(sum(V, element) / 4.0)) * (volume / 6.0)
}

fn own_volume(V: &[Vector3<f64>], element: &[usize; 4], _: f64, integrand: Integrand) -> DVector<f64> {
    let [a, b, c, d] = element.map(|vertex| V[vertex]);
    integrand(&(sum(V, element) / 4.0)) * ((b - a).cross(&(c - a)).dot(&(d - a)) / 6.0)
}

fn at_a_vertex(V: &[Vector3<f64>], element: &[usize; 4], volume: f64, integrand: Integrand) -> DVector<f64> {
    integrand(&V[element[0]]) * volume
}

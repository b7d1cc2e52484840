//! Mistakes in `quadrature_single_point`.

use std::ops::Mul;

use grader_child::Functions;
use nalgebra::Vector3;

use super::Variant;
use crate::reference::REFERENCE;

/// Makes a variant from a generic function, which stands for numbers and for vectors.
macro_rules! of_both {
    ($diagnosis:literal, $sentence:literal, $wrong:ident) => {
        Variant {
            function: "quadrature_single_point",
            diagnosis: Some($diagnosis),
            sentence: $sentence,
            functions: Functions { quadrature_of_number: $wrong, quadrature_of_vector: $wrong, ..REFERENCE },
        }
    };
}

/// The mistakes that are known.
pub const VARIANTS: &[Variant] = &[
    of_both!(
        "local for global indices",
        "The integrand was called in the middle of the first four vertices of the mesh; `element` says which are meant.",
        in_the_first_four
    ),
    of_both!(
        "sum for mean",
        "The integrand was called at a point outside the element: a sum of four points is not yet their mean.",
        at_the_sum
    ),
    of_both!("missing volume", "The mean value alone is no integral. Look at the unit of the answer.", without_volume),
    of_both!(
        "scaled by 1/6",
        "The volume that is given is the element's own; no further factor belongs to it.",
        times_volume_over_6
    ),
    of_both!(
        "computes the volume anew",
        "The volume that is given must be used, not one computed from the vertices.",
        own_volume
    ),
    of_both!(
        "evaluated at the wrong point",
        "The integrand was called at a vertex. At which point does each shape function have its mean value?",
        at_a_vertex
    ),
];

type Integrand<'a, R> = &'a dyn Fn(&Vector3<f64>) -> R;

fn sum(V: &[Vector3<f64>], element: &[usize; 4]) -> Vector3<f64> {
    element.iter().map(|&vertex| V[vertex]).sum()
}

fn in_the_first_four<R: Mul<f64, Output = R>>(
    V: &[Vector3<f64>],
    _: &[usize; 4],
    volume: f64,
    integrand: Integrand<R>,
) -> R {
    integrand(&(sum(V, &[0, 1, 2, 3]) / 4.0)) * volume
}

fn at_the_sum<R: Mul<f64, Output = R>>(
    V: &[Vector3<f64>],
    element: &[usize; 4],
    volume: f64,
    integrand: Integrand<R>,
) -> R {
    integrand(&sum(V, element)) * volume
}

fn without_volume<R: Mul<f64, Output = R>>(
    V: &[Vector3<f64>],
    element: &[usize; 4],
    _: f64,
    integrand: Integrand<R>,
) -> R {
    integrand(&(sum(V, element) / 4.0))
}

fn times_volume_over_6<R: Mul<f64, Output = R>>(
    V: &[Vector3<f64>],
    element: &[usize; 4],
    volume: f64,
    integrand: Integrand<R>,
) -> R {
    integrand(&(sum(V, element) / 4.0)) * (volume / 6.0)
}

fn own_volume<R: Mul<f64, Output = R>>(V: &[Vector3<f64>], element: &[usize; 4], _: f64, integrand: Integrand<R>) -> R {
    let [a, b, c, d] = element.map(|vertex| V[vertex]);
    integrand(&(sum(V, element) / 4.0)) * ((b - a).cross(&(c - a)).dot(&(d - a)) / 6.0)
}

fn at_a_vertex<R: Mul<f64, Output = R>>(
    V: &[Vector3<f64>],
    element: &[usize; 4],
    volume: f64,
    integrand: Integrand<R>,
) -> R {
    integrand(&V[element[0]]) * volume
}

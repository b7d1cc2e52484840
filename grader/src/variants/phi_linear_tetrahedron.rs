//! Mistakes in `phi_linear_tetrahedron`.

use finite_elements_3d as solved;
use nalgebra::{Matrix3, Vector3, Vector4};

use super::Variant;

/// The mistakes that are known.
pub const VARIANTS: &[Variant] = &[
    variant!(
        phi_linear_tetrahedron,
        "transposed",
        "Look at the matrix of the linear system: do its edges stand in rows or in columns? A sheared element tells.",
        |V, element, x| {
            let inverse = edges(V, element).transpose().try_inverse().unwrap_or_default();
            with_first(&(inverse * (x - V[element[0]])))
        }
    ),
    variant!(
        phi_linear_tetrahedron,
        "local for global indices",
        "The values fit the first four vertices of the mesh; `element` says which four are meant, and in which order.",
        |V, _, x| solved::phi_linear_tetrahedron(V, &[0, 1, 2, 3], x)
    ),
    variant!(
        phi_linear_tetrahedron,
        "clamped",
        "Shape functions are linear everywhere, also outside the element, where some must leave the range from 0 to 1.",
        |V, element, x| solved::phi_linear_tetrahedron(V, element, x).map(|phi| phi.clamp(0.0, 1.0))
    ),
    variant!(
        phi_linear_tetrahedron,
        "point taken for an offset",
        "`x` is a point in undeformed space. From where are the edges measured, and from where is `x`?",
        |V, element, x| with_first(&(edges(V, element).try_inverse().unwrap_or_default() * x))
    ),
    variant!(
        phi_linear_tetrahedron,
        "wrong vertex order",
        "The four values are right, but in another order: entry i belongs to vertex `element[i]`.",
        |V, element, x| {
            let phi = solved::phi_linear_tetrahedron(V, element, x);
            Vector4::new(phi[1], phi[2], phi[3], phi[0])
        }
    ),
    variant!(
        phi_linear_tetrahedron,
        "barycentric sign",
        "Three values are right. The last one follows from what the four add up to; look at its sign.",
        |V, element, x| {
            let mut phi = solved::phi_linear_tetrahedron(V, element, x);
            phi[0] = -phi[0];
            phi
        }
    ),
    variant!(
        phi_linear_tetrahedron,
        "unsigned volumes",
        "Ratios of volumes need their signs: what happens to a point that lies beyond one of the faces?",
        |V, element, x| solved::phi_linear_tetrahedron(V, element, x).abs()
    ),
    variant!(
        phi_linear_tetrahedron,
        "missing volume",
        "The values grow with the element. Shape functions have no unit: what is still to be divided by?",
        |V, element, x| {
            let phi = solved::phi_linear_tetrahedron(V, element, x) * edges(V, element).determinant();
            with_first(&phi.fixed_rows::<3>(1).into_owned())
        }
    ),
];

/// The edges from vertex 0, in columns.
fn edges(V: &[Vector3<f64>], element: &[usize; 4]) -> Matrix3<f64> {
    let [a, b, c, d] = element.map(|vertex| V[vertex]);
    Matrix3::from_columns(&[b - a, c - a, d - a])
}

/// All four values from the last three.
fn with_first(phi: &Vector3<f64>) -> Vector4<f64> {
    Vector4::new(1.0 - phi.sum(), phi[0], phi[1], phi[2])
}

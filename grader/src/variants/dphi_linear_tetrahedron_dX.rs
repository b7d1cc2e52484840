//! Mistakes in `dphi_linear_tetrahedron_dX`.

use finite_elements_3d as solved;
use nalgebra::{Matrix3, Matrix4x3, Vector3};

use super::Variant;

/// The mistakes that are known.
pub const VARIANTS: &[Variant] = &[
    variant!(
        dphi_linear_tetrahedron_dX,
        "transposed",
        "Rows and columns of the inverse are exchanged. The unit tetrahedron cannot tell; try a sheared one.",
        |V, element, X| {
            let inverse = solved::dphi_linear_tetrahedron_dX(V, element, X).fixed_rows::<3>(1).transpose();
            with_first(&inverse)
        }
    ),
    variant!(
        dphi_linear_tetrahedron_dX,
        "wrong vertex order",
        "The four gradients are right, but in another order: row i belongs to vertex `element[i]`.",
        |V, element, X| {
            let dphi = solved::dphi_linear_tetrahedron_dX(V, element, X);
            Matrix4x3::from_fn(|row, column| dphi[((row + 1) % 4, column)])
        }
    ),
    variant!(
        dphi_linear_tetrahedron_dX,
        "missing term",
        "One vertex has no gradient. The shape functions add up to a constant: what does that say of their gradients?",
        |V, element, X| {
            let mut dphi = solved::dphi_linear_tetrahedron_dX(V, element, X);
            dphi.row_mut(0).fill(0.0);
            dphi
        }
    ),
    variant!(
        dphi_linear_tetrahedron_dX,
        "barycentric sign",
        "Look at the sign of the first row: the gradient of a constant is zero, so each column must add up to zero.",
        |V, element, X| {
            let mut dphi = solved::dphi_linear_tetrahedron_dX(V, element, X);
            dphi.row_mut(0).neg_mut();
            dphi
        }
    ),
    variant!(
        dphi_linear_tetrahedron_dX,
        "missing volume",
        "The gradients point the right way, but their length grows with the element. Their unit is one over metres.",
        |V, element, X| solved::dphi_linear_tetrahedron_dX(V, element, X) * six_volumes(V, element)
    ),
    variant!(
        dphi_linear_tetrahedron_dX,
        "unsigned volume",
        "Elements of one orientation are right and those of the other are not: the sign of a volume was dropped.",
        |V, element, X| solved::dphi_linear_tetrahedron_dX(V, element, X) * six_volumes(V, element).signum()
    ),
    variant!(
        dphi_linear_tetrahedron_dX,
        "local for global indices",
        "The gradients fit the first four vertices of the mesh; `element` says which four are meant.",
        |V, _, X| solved::dphi_linear_tetrahedron_dX(V, &[0, 1, 2, 3], X)
    ),
    variant!(
        dphi_linear_tetrahedron_dX,
        "edges for their inverse",
        "The numbers grow with the element like its edges do. A gradient shrinks when the element grows.",
        |V, element, _| {
            let [a, b, c, d] = element.map(|vertex| V[vertex]);
            with_first(&Matrix3::from_columns(&[b - a, c - a, d - a]))
        }
    ),
];

/// Six times the signed volume.
fn six_volumes(V: &[Vector3<f64>], element: &[usize; 4]) -> f64 {
    let [a, b, c, d] = element.map(|vertex| V[vertex]);
    (b - a).cross(&(c - a)).dot(&(d - a))
}

/// All four rows from the last three.
fn with_first(rows: &Matrix3<f64>) -> Matrix4x3<f64> {
    Matrix4x3::from_rows(&[-rows.row_sum(), rows.row(0).into(), rows.row(1).into(), rows.row(2).into()])
}

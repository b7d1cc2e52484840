//! Mistakes in `d2V_linear_tetrahedron_dq2`.

use finite_elements_3d as solved;
use finite_elements_3d::given::{deformation_gradient, project};
use nalgebra::{DVector, Matrix4x3, SMatrix, Vector3};

use super::Variant;

/// The mistakes that are known.
pub const VARIANTS: &[Variant] = &[
    variant!(
        d2V_linear_tetrahedron_dq2,
        "projected",
        "A compressed element has negative eigenvalues, and they must still be there: projection comes in assembly.",
        |q, V, element, volume, C, D| project(&solved::d2V_linear_tetrahedron_dq2(q, V, element, volume, C, D))
    ),
    variant!(
        d2V_linear_tetrahedron_dq2,
        "negated",
        "The sign is reversed: the page asks for the second derivative of an energy, not of a force.",
        |q, V, element, volume, C, D| -solved::d2V_linear_tetrahedron_dq2(q, V, element, volume, C, D)
    ),
    variant!(
        d2V_linear_tetrahedron_dq2,
        "grouped by coordinate",
        "The entries are right, but sorted by coordinate; each vertex keeps its three rows and columns together.",
        |q, V, element, volume, C, D| {
            let H = solved::d2V_linear_tetrahedron_dq2(q, V, element, volume, C, D);
            SMatrix::from_fn(|row, column| H[(3 * (row % 4) + row / 4, 3 * (column % 4) + column / 4)])
        }
    ),
    variant!(
        d2V_linear_tetrahedron_dq2,
        "columns for rows",
        "The chain rule's matrix flattens F another way than the second derivative of the energy density does.",
        |q, V, element, volume, C, D| {
            let H = second_derivative(q, V, element, C, D);
            let swapped = |entry: usize| 3 * (entry % 3) + entry / 3;
            let H = SMatrix::from_fn(|row, column| H[(swapped(row), swapped(column))]);
            chained(&gradients(V, element), &H) * volume
        }
    ),
    variant!(
        d2V_linear_tetrahedron_dq2,
        "missing volume",
        "The answer does not depend on the volume: an integral over the element is meant.",
        |q, V, element, _, C, D| solved::d2V_linear_tetrahedron_dq2(q, V, element, 1.0, C, D)
    ),
    variant!(
        d2V_linear_tetrahedron_dq2,
        "rest for deformed",
        "The stiffness is that of the undeformed element: does the deformation gradient see `q`?",
        |_, V, element, volume, C, D| {
            let q = DVector::from_fn(3 * V.len(), |row, _| V[row / 3][row % 3]);
            solved::d2V_linear_tetrahedron_dq2(&q, V, element, volume, C, D)
        }
    ),
    variant!(
        d2V_linear_tetrahedron_dq2,
        "local for global indices",
        "The answer fits the first four vertices of the mesh; `element` says which four are meant.",
        |q, V, _, volume, C, D| solved::d2V_linear_tetrahedron_dq2(q, V, &[0, 1, 2, 3], volume, C, D)
    ),
    variant!(
        d2V_linear_tetrahedron_dq2,
        "only the diagonal blocks",
        "Moving one vertex changes the force on the others too: rows must add up to zero over the vertices.",
        |q, V, element, volume, C, D| {
            let H = solved::d2V_linear_tetrahedron_dq2(q, V, element, volume, C, D);
            SMatrix::from_fn(|row, column| if row / 3 == column / 3 { H[(row, column)] } else { 0.0 })
        }
    ),
];

fn gradients(V: &[Vector3<f64>], element: &[usize; 4]) -> Matrix4x3<f64> {
    solved::dphi_linear_tetrahedron_dX(V, element, &V[element[0]])
}

/// Second derivative of the energy density.
fn second_derivative(q: &DVector<f64>, V: &[Vector3<f64>], element: &[usize; 4], C: f64, D: f64) -> SMatrix<f64, 9, 9> {
    solved::d2psi_neo_hookean_dF2(&deformation_gradient(q, element, &gradients(V, element)), C, D)
}

/// The chain rule from F, row by row, to the vertices' coordinates.
fn chained(dphi: &Matrix4x3<f64>, H: &SMatrix<f64, 9, 9>) -> SMatrix<f64, 12, 12> {
    let B = SMatrix::<f64, 9, 12>::from_fn(
        |row, column| {
            if row / 3 == column % 3 { dphi[(column / 3, row % 3)] } else { 0.0 }
        },
    );
    B.transpose() * H * B
}

//! Mistakes in `assemble_stiffness`.

use finite_elements_3d as solved;
use finite_elements_3d::given::project;
use nalgebra::{DMatrix, DVector, SMatrix, Vector3};
use nalgebra_sparse::CsrMatrix;

use super::{Variant, scatter};

/// The mistakes that are known.
pub const VARIANTS: &[Variant] = &[
    variant!(
        assemble_stiffness,
        "negated",
        "The sign is reversed: this is the derivative of the force, not of the energy's gradient.",
        |q, V, T, v0, C, D| solved::assemble_stiffness(q, V, T, v0, C, D) * -1.0
    ),
    variant!(
        assemble_stiffness,
        "projected after the minus",
        "The stiff directions are gone: which sign do they have at the moment of projection?",
        |q, V, T, v0, C, D| plain(q.len(), T, |e| project(&-hessian(q, V, &T[e], v0[e], C, D)))
    ),
    variant!(
        assemble_stiffness,
        "not projected",
        "Fine until the first strong compression: the element matrices are added as they are.",
        |q, V, T, v0, C, D| plain(q.len(), T, |e| -hessian(q, V, &T[e], v0[e], C, D))
    ),
    variant!(
        assemble_stiffness,
        "projected as a whole",
        "Projection belongs to each element, not to the sum of all.",
        |q, V, T, v0, C, D| {
            let sum = plain(q.len(), T, |e| hessian(q, V, &T[e], v0[e], C, D));
            let mut eigen = DMatrix::from(&sum).symmetric_eigen();
            eigen.eigenvalues.apply(|value| *value = value.max(0.0));
            CsrMatrix::from(&-eigen.recompose())
        }
    ),
    variant!(
        assemble_stiffness,
        "transposed",
        "Single 3×3 blocks are transposed. Only the whole matrix is symmetric, its blocks one by one are not.",
        |q, V, T, v0, C, D| {
            let transposed = |H: &SMatrix<f64, 12, 12>, a, b| H.fixed_view::<3, 3>(3 * a, 3 * b).transpose();
            scatter::blocks(q.len(), T, transposed, |e| -project(&hessian(q, V, &T[e], v0[e], C, D)))
        }
    ),
    variant!(
        assemble_stiffness,
        "overwritten instead of added",
        "A single element is right, elements that share a vertex are not: what happens to the entries that are there already?",
        |q, V, T, v0, C, D| scatter::overwriting(q.len(), T, |e| -project(&hessian(q, V, &T[e], v0[e], C, D)))
    ),
    variant!(
        assemble_stiffness,
        "local for global indices",
        "All elements are added to the first twelve rows: which vertices of the mesh does an element have?",
        |q, V, T, v0, C, D| {
            let piled = vec![[0, 1, 2, 3]; T.len()];
            plain(q.len(), &piled, |e| -project(&hessian(q, V, &T[e], v0[e], C, D)))
        }
    ),
    variant!(
        assemble_stiffness,
        "first volume for all",
        "Elements have different volumes: `v0` runs along `T`.",
        |q, V, T, v0, C, D| solved::assemble_stiffness(q, V, T, &scatter::first_for_all(v0), C, D)
    ),
];

fn hessian(
    q: &DVector<f64>,
    V: &[Vector3<f64>],
    element: &[usize; 4],
    volume: f64,
    C: f64,
    D: f64,
) -> SMatrix<f64, 12, 12> {
    solved::d2V_linear_tetrahedron_dq2(q, V, element, volume, C, D)
}

/// Assembly without a mistake.
fn plain(q_size: usize, T: &[[usize; 4]], of_element: impl Fn(usize) -> SMatrix<f64, 12, 12>) -> CsrMatrix<f64> {
    scatter::blocks(q_size, T, |H, a, b| H.fixed_view::<3, 3>(3 * a, 3 * b).into_owned(), of_element)
}

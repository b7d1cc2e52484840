//! Parts of the formulas, as a student writes them out, for mistakes to be made in.

use finite_elements_3d::given::deformation_gradient;
use nalgebra::{DMatrix, DVector, Matrix3, Matrix4x3, SMatrix, SVector, Vector3};
use nalgebra_sparse::{CooMatrix, CsrMatrix};

/// Undeformed vertices of an element.
pub fn corners(V: &[Vector3<f64>], element: &[usize; 4]) -> [Vector3<f64>; 4] {
    element.map(|vertex| V[vertex])
}

/// An energy density of J and tr(FᵀF); infinite for J ≤ 0.
pub fn density(F: &Matrix3<f64>, of: impl Fn(f64, f64) -> f64) -> f64 {
    let J = F.determinant();
    if J > 0.0 { of(J, F.norm_squared()) } else { f64::INFINITY }
}

/// Cofactors of F, the derivative of its determinant.
pub fn cofactors(F: &Matrix3<f64>) -> Matrix3<f64> {
    let (a, b, c) = (F.column(0), F.column(1), F.column(2));
    Matrix3::from_columns(&[b.cross(&c), c.cross(&a), a.cross(&b)])
}

/// A matrix flattened row by row.
pub fn by_rows(M: &Matrix3<f64>) -> SVector<f64, 9> {
    SVector::from_fn(|i, _| M[(i / 3, i % 3)])
}

/// A matrix flattened column by column.
pub fn by_columns(M: &Matrix3<f64>) -> SVector<f64, 9> {
    by_rows(&M.transpose())
}

/// A stress a F + b cof F, where (a, b) are functions of J, tr(FᵀF) and J^(−2/3).
pub fn stress(F: &Matrix3<f64>, factors: impl Fn(f64, f64, f64) -> (f64, f64)) -> SVector<f64, 9> {
    let J = F.determinant();
    let (a, b) = factors(J, F.norm_squared(), J.powf(-2.0 / 3.0));
    by_rows(&(F * a + cofactors(F) * b))
}

/// The second derivative, added up from its terms after their coefficients were changed: of 1, F ⊗ cof, cof ⊗ F, cof ⊗ cof (volume),
/// ∂²J (shape), ∂²J (volume), cof ⊗ cof (shape).
pub fn hessian(F: &Matrix3<f64>, C: f64, D: f64, change: impl Fn(&mut [f64; 7])) -> SMatrix<f64, 9, 9> {
    let (J, I) = (F.determinant(), F.norm_squared());
    let g = J.powf(-2.0 / 3.0);
    let mixed = -4.0 / 3.0 * C * g / J;
    let mut c = [
        2.0 * C * g,
        mixed,
        mixed,
        2.0 * D,
        -2.0 / 3.0 * C * I * g / J,
        2.0 * D * (J - 1.0),
        10.0 / 9.0 * C * I * g / (J * J),
    ];
    change(&mut c);
    let (f, k) = (by_rows(F), by_rows(&cofactors(F)));
    SMatrix::identity() * c[0]
        + f * k.transpose() * c[1]
        + k * f.transpose() * c[2]
        + k * k.transpose() * (c[3] + c[6])
        + second_derivative_of_J(F) * (c[4] + c[5])
}

/// ∂²J/∂F².
pub fn second_derivative_of_J(F: &Matrix3<f64>) -> SMatrix<f64, 9, 9> {
    let sign = |i: usize, j: usize| {
        if i == j {
            0.0
        } else if (i + 1) % 3 == j {
            1.0
        } else {
            -1.0
        }
    };
    SMatrix::from_fn(|row, column| {
        let (i, j, k, l) = (row / 3, row % 3, column / 3, column % 3);
        let factor = sign(i, k) * sign(j, l);
        if factor == 0.0 { 0.0 } else { factor * F[(3 - i - k, 3 - j - l)] }
    })
}

/// Gradients of the shape functions of an element.
pub fn dphi(V: &[Vector3<f64>], element: &[usize; 4]) -> Matrix4x3<f64> {
    finite_elements_3d::dphi_linear_tetrahedron_dX(V, element, &Vector3::zeros())
}

/// Deformation gradient of an element.
pub fn gradient(q: &DVector<f64>, V: &[Vector3<f64>], element: &[usize; 4]) -> Matrix3<f64> {
    deformation_gradient(q, element, &dphi(V, element))
}

/// Stress of an element as a matrix.
pub fn piola(F: &Matrix3<f64>, C: f64, D: f64) -> Matrix3<f64> {
    Matrix3::from_row_slice(finite_elements_3d::dpsi_neo_hookean_dF(F, C, D).as_slice())
}

/// The nodal forces of a stress: three entries for each vertex.
pub fn nodal(P: &Matrix3<f64>, dphi: &Matrix4x3<f64>, volume: f64) -> SVector<f64, 12> {
    SVector::from_fn(|i, _| (P * dphi.row(i / 3).transpose())[i % 3] * volume)
}

/// The matrix from nodal coordinates to F, row by row.
pub fn B_matrix(dphi: &Matrix4x3<f64>) -> SMatrix<f64, 9, 12> {
    SMatrix::from_fn(|row, column| if row / 3 == column % 3 { dphi[(column / 3, row % 3)] } else { 0.0 })
}

/// A square matrix added up from the entries of element matrices; `place` turns local rows into rows of the mesh.
pub fn scattered(
    size: usize,
    T: &[[usize; 4]],
    place: impl Fn(&[usize; 4], usize) -> usize,
    of_element: impl Fn(usize) -> SMatrix<f64, 12, 12>,
) -> CsrMatrix<f64> {
    let mut sum = CooMatrix::new(size, size);
    for (index, element) in T.iter().enumerate() {
        let matrix = of_element(index);
        for (i, j) in (0..12).flat_map(|i| (0..12).map(move |j| (i, j))) {
            sum.push(place(element, i), place(element, j), matrix[(i, j)]);
        }
    }
    CsrMatrix::from(&sum)
}

/// The row of a local coordinate in the mesh.
pub fn global(element: &[usize; 4], i: usize) -> usize {
    3 * element[i / 3] + i % 3
}

/// A vector added up from the entries of element vectors.
pub fn gathered(
    size: usize,
    T: &[[usize; 4]],
    place: impl Fn(&[usize; 4], usize) -> usize,
    of_element: impl Fn(usize) -> SVector<f64, 12>,
) -> DVector<f64> {
    let mut sum = DVector::zeros(size);
    for (index, element) in T.iter().enumerate() {
        let vector = of_element(index);
        (0..12).for_each(|i| sum[place(element, i)] += vector[i]);
    }
    sum
}

/// A sparse matrix with some of its entries kept.
pub fn masked(matrix: &CsrMatrix<f64>, keep: impl Fn(usize, usize) -> bool) -> CsrMatrix<f64> {
    let dense = DMatrix::from(matrix);
    let kept = DMatrix::from_fn(dense.nrows(), dense.ncols(), |i, j| if keep(i, j) { dense[(i, j)] } else { 0.0 });
    CsrMatrix::from(&kept)
}

//! The change of volume at a point, and its derivatives.

use nalgebra::{Matrix3, SMatrix, Vector3};

use fem_elements::sparse::Block;
use fem_elements::tensor::raised;
use fem_solvers::Real;

/// J − 1 of a displacement gradient, without the loss of digits near rest.
pub fn change(G: &Matrix3<f64>) -> f64 {
    let trace = G.trace();
    // The sum of the principal minors of second order is (tr(G)² − tr(G²))/2.
    trace + 0.5 * (trace * trace - (G * G).trace()) + G.determinant()
}

/// cof F = ∂J/∂F
pub fn cofactor(F: &Matrix3<f64>) -> Matrix3<f64> {
    let [a, b, c] = [0, 1, 2].map(|k| F.column(k).into_owned());
    Matrix3::from_columns(&[b.cross(&c), c.cross(&a), a.cross(&b)])
}

/// The derivative of cof F along A, which is the tensor cross product of both.
pub fn cross(A: &Matrix3<f64>, F: &Matrix3<f64>) -> Matrix3<f64> {
    cofactor(&(F + A)) - cofactor(F) - cofactor(A)
}

/// The derivative of (cof F) a by displacements with the gradient b: −[F (a × b)]×.
pub fn second_derivative(F: &Matrix3<f64>, a: &Vector3<f64>, b: &Vector3<f64>) -> Matrix3<f64> {
    -(F * a.cross(b)).cross_matrix()
}

/// `factor` ∂²J/∂F² with its negative eigenvalues raised to zero; the entry F_ij has the number 3 i + j.
pub fn projected_second_derivative(F: &Matrix3<f64>, factor: f64) -> SMatrix<f64, 9, 9> {
    projected(|direction| cross(&(factor * direction), F))
}

/// The second derivative whose product with a direction is given, with its negative eigenvalues raised to zero.
pub fn projected(product: impl Fn(&Matrix3<f64>) -> Matrix3<f64>) -> SMatrix<f64, 9, 9> {
    let mut H = SMatrix::<f64, 9, 9>::zeros();
    for column in 0..9 {
        let mut unit = Matrix3::zeros();
        unit[(column / 3, column % 3)] = 1.0;
        let derivative = product(&unit);
        (0..9).for_each(|row| H[(row, column)] = derivative[(row / 3, row % 3)]);
    }
    raised(H).unwrap_or(H)
}

/// Σ a_j H_(ij)(kl) b_l
pub fn contracted(H: &SMatrix<f64, 9, 9>, a: &Vector3<f64>, b: &Vector3<f64>) -> Matrix3<f64> {
    Matrix3::from_fn(|i, k| (0..3).map(|j| (0..3).map(|l| a[j] * H[(3 * i + j, 3 * k + l)] * b[l]).sum::<f64>()).sum())
}

/// A matrix as a block.
pub fn of_matrix<T: Real>(block: &Matrix3<f64>) -> Block<T, 3> {
    std::array::from_fn(|i| std::array::from_fn(|j| T::of(block[(i, j)])))
}

/// sum += x
pub fn add<T: Real>(sum: &mut [T; 3], x: Vector3<f64>) {
    for i in 0..3 {
        sum[i] += T::of(x[i]);
    }
}

use nalgebra::SMatrix;

/// The integral of the page with its factorials.
pub fn mass_matrix_linear_tetrahedron(density: f64, volume: f64) -> SMatrix<f64, 12, 12> {
    fn factorial(n: u64) -> u64 {
        if n == 0 { 1 } else { n * factorial(n - 1) }
    }
    let integral = |i: usize, j: usize| {
        let exponents = [0, 1, 2, 3].map(|k| u64::from(k == i) + u64::from(k == j));
        let above: u64 = exponents.iter().map(|&e| factorial(e)).product();
        6.0 * volume * above as f64 / factorial(exponents.iter().sum::<u64>() + 3) as f64
    };
    SMatrix::from_fn(|row, column| if row % 3 == column % 3 { density * integral(row / 3, column / 3) } else { 0.0 })
}

//! Assembly with mistakes in it, which several functions share.

use nalgebra::{Matrix3, SMatrix};
use nalgebra_sparse::CsrMatrix;

use finite_elements_3d::given::{add_block, sparsity};

/// Assembles element matrices so that each takes the place of what the elements before it left.
pub fn overwriting(
    q_size: usize,
    T: &[[usize; 4]],
    of_element: impl Fn(usize) -> SMatrix<f64, 12, 12>,
) -> CsrMatrix<f64> {
    let mut sum = sparsity(q_size, T);
    for (index, element) in T.iter().enumerate() {
        let matrix = of_element(index);
        for (a, &row) in element.iter().enumerate() {
            for (b, &column) in element.iter().enumerate() {
                let there = block(&sum, row, column);
                add_block(&mut sum, row, column, &(matrix.fixed_view::<3, 3>(3 * a, 3 * b) - there));
            }
        }
    }
    sum
}

/// Assembles one 3×3 block for each pair of an element's vertices, made from the element's index and the pair.
pub fn blocks(
    q_size: usize,
    T: &[[usize; 4]],
    of_pair: impl Fn(&SMatrix<f64, 12, 12>, usize, usize) -> Matrix3<f64>,
    of_element: impl Fn(usize) -> SMatrix<f64, 12, 12>,
) -> CsrMatrix<f64> {
    let mut sum = sparsity(q_size, T);
    for (index, element) in T.iter().enumerate() {
        let matrix = of_element(index);
        for (a, &row) in element.iter().enumerate() {
            for (b, &column) in element.iter().enumerate() {
                add_block(&mut sum, row, column, &of_pair(&matrix, a, b));
            }
        }
    }
    sum
}

/// The first volume in the place of each.
pub fn first_for_all(v0: &[f64]) -> Vec<f64> {
    v0.iter().map(|_| v0[0]).collect()
}

fn block(matrix: &CsrMatrix<f64>, row: usize, column: usize) -> Matrix3<f64> {
    Matrix3::from_fn(|i, j| matrix.get_entry(3 * row + i, 3 * column + j).map_or(0.0, |entry| entry.into_value()))
}

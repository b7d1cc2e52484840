//! A given function, `given::solve`: no exercise; read include-docs/given_solve.md.

use finite_elements_3d::given;
use nalgebra::{DMatrix, DVector, dmatrix, dvector};
use proptest::prelude::*;

use crate::for_all;
use grader::properties::bodies::{by_elimination, sparse};
use grader::properties::outcome::{Outcome, holds, near};

/// Sparse symmetric matrices of any size; diagonally dominant, so positive definite.
fn positive_definite() -> impl Strategy<Value = DMatrix<f64>> {
    (1..25usize).prop_flat_map(|n| {
        let entry = prop_oneof![3 => Just(0.0), 1 => -1.0..1.0f64];
        prop::collection::vec(entry, n * n).prop_map(move |entries| {
            let A = DMatrix::from_vec(n, n, entries);
            let symmetric = &A + A.transpose();
            let sums = DVector::from_fn(n, |row, _| symmetric.row(row).iter().map(|value| value.abs()).sum::<f64>());
            symmetric + DMatrix::from_diagonal(&sums.add_scalar(0.5))
        })
    })
}

fn right_hand_side(n: usize) -> DVector<f64> {
    DVector::from_fn(n, |row, _| (row as f64 * 1.7 + 0.3).sin())
}

#[test]
fn positive_definite_systems_agree_with_elimination() -> Outcome {
    for_all(positive_definite(), |A| {
        let b = right_hand_side(A.nrows());
        let A = sparse(&A);
        near("A x = b", &given::solve(&A, &b), &by_elimination(&A, &b), 1e-11)
    })
}

#[test]
fn the_unit_of_the_matrix_does_not_matter() -> Outcome {
    for_all((positive_definite(), -20.0..20.0), |(A, power)| {
        let (b, unit) = (right_hand_side(A.nrows()), 10f64.powf(power));
        let expected = by_elimination(&sparse(&A), &b);
        near("(unit A) (x / unit) = b", &(given::solve(&sparse(&(A * unit)), &b) * unit), &expected, 1e-11)
    })
}

#[test]
fn indefinite_systems_have_a_finite_solution_in_a_descent_direction() -> Outcome {
    for_all((positive_definite(), 0.0..20.0), |(A, shift)| {
        let n = A.nrows();
        let (A, b) = (A - DMatrix::identity(n, n) * shift, right_hand_side(n));
        let x = given::solve(&sparse(&A), &b);
        holds("finite", x.iter().all(|entry| entry.is_finite()))?;
        holds("b · x > 0, so a Newton direction goes downhill", x.dot(&b) > 0.0)
    })?;
    for A in [dmatrix![0.0, 1.0; 1.0, 0.0], dmatrix![-1.0, 0.0; 0.0, -1.0]] {
        let x = given::solve(&sparse(&A), &dvector![1.0, -2.0]);
        holds("finite for mixed and negative matrices", x.iter().all(|entry| entry.is_finite()))?;
    }
    Ok(())
}

#[test]
fn nan_and_infinity_give_nan() -> Outcome {
    let A = dmatrix![2.0, 0.0; 0.0, 3.0];
    let is_nan = |x: DVector<f64>| x.len() == 2 && x.iter().all(|entry| entry.is_nan());
    for bad in [f64::NAN, f64::INFINITY] {
        holds("NaN or ∞ in b", is_nan(given::solve(&sparse(&A), &dvector![1.0, bad])))?;
        let broken = dmatrix![2.0, 0.0; 0.0, bad];
        holds("NaN or ∞ in A", is_nan(given::solve(&sparse(&broken), &dvector![1.0, 1.0])))?;
    }
    Ok(())
}

#[test]
fn no_unknowns_have_an_empty_solution() -> Outcome {
    near("0×0", &given::solve(&sparse(&DMatrix::zeros(0, 0)), &DVector::zeros(0)), &DVector::<f64>::zeros(0), 0.0)
}

#[test]
fn a_matrix_of_zeros_has_a_finite_answer() -> Outcome {
    let x = given::solve(&sparse(&DMatrix::zeros(3, 3)), &dvector![1.0, 2.0, 3.0]);
    holds("three finite unknowns", x.len() == 3 && x.iter().all(|value| value.is_finite()))
}

#[test]
fn a_solver_notices_new_values_and_new_patterns() -> Outcome {
    let mut solver = given::Solver::default();
    let b = dvector![1.0, 2.0];
    let systems = [dmatrix![4.0, 1.0; 1.0, 3.0], dmatrix![5.0, 1.0; 1.0, 3.0], dmatrix![5.0, 0.0; 0.0, 3.0]];
    for A in systems.iter().flat_map(|A| [A, A]) {
        let A = sparse(A);
        near("A x = b", &solver.solve(&A, &b), &by_elimination(&A, &b), 1e-14)?;
    }
    holds("each matrix is factorised once", solver.factorizations == 3)?;
    holds("each pattern is analysed once", solver.symbolic_factorizations == 2)
}

#[test]
fn numbers_too_large_to_compute_with_end_in_nan() -> Outcome {
    let huge = dmatrix![1e308, -1.7e308; -1.7e308, 1e308];
    let x = given::solve(&sparse(&huge), &dvector![1.0, 2.0]);
    holds("it ends, and the answer is NaN or finite", x.iter().all(|value| value.is_nan() || value.is_finite()))
}

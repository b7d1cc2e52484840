//! Inverses of blocks, which block Jacobi applies.

use std::sync::Arc;

use fem_elements::sparse::{Block, Pattern, Stored};
use fem_model::simulation::Breakdown;
use fem_solvers::{Preconditioner, Solver, SolverChoice};

/// The inverse of a block.
fn inverse(A: Block<f64, 3>) -> Result<Block<f64, 3>, Breakdown> {
    let pattern = Arc::new(Pattern::new::<4>(1, &[], Stored::Full));
    let mut solver = Solver::new(SolverChoice::Pcg(Preconditioner::BlockJacobi), &pattern, &[[0.0; 3]]);
    solver.prepare(&[A])?;
    // It is symmetric.
    Ok([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(|unit| {
        let mut column = [[0.0; 3]];
        solver.apply(&[unit], &mut column);
        column[0]
    }))
}

#[test]
fn a_block_times_its_inverse_is_the_identity() {
    let A = [[4.0, 1.0, -0.5], [1.0, 3.0, 0.2], [-0.5, 0.2, 2.0]];
    let inverse = inverse(A).unwrap();
    for i in 0..3 {
        for j in 0..3 {
            let entry: f64 = (0..3).map(|k| A[i][k] * inverse[j][k]).sum();
            assert!((entry - f64::from(u8::from(i == j))).abs() < 1e-15, "({i}, {j}): {entry}");
        }
    }
}

#[test]
fn blocks_that_are_not_positive_definite_are_refused() {
    let with = |[[a, b], [c, d]]: [[f64; 2]; 2]| inverse([[a, b, 0.0], [c, d, 0.0], [0.0, 0.0, 1.0]]);
    assert_eq!(with([[-1.0, 0.0], [0.0, 1.0]]), Err(Breakdown::NotPositiveDefinite));
    assert_eq!(with([[1.0, 1.0], [1.0, 1.0]]), Err(Breakdown::Singular));
    assert_eq!(with([[f64::NAN, 0.0], [0.0, 1.0]]), Err(Breakdown::Singular));
}

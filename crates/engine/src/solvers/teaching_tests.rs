//! Steepest descent and conjugate directions: the bounds of Shewchuk (1994) at every iteration, and the iterates of conjugate gradients.

use nalgebra::{DMatrix, DVector};

use super::beam::{Beam, random};
use super::{Solver, SolverChoice};

/// The matrix of a beam with all its entries, its condition number, and a right-hand side.
struct System {
    beam: Beam,
    matrix: DMatrix<f64>,
    condition: f64,
    b: Vec<[f64; 3]>,
}

impl System {
    fn new() -> Self {
        let beam = Beam::new(2, SolverChoice::Cg.stored());
        let (values, pattern) = (beam.values::<f64>(), &beam.pattern);
        let mut matrix = DMatrix::zeros(3 * pattern.rows(), 3 * pattern.rows());
        for row in 0..pattern.rows() {
            for block in pattern.row(row) {
                let column = pattern.columns[block] as usize;
                for i in 0..3 {
                    (0..3).for_each(|j| matrix[(3 * row + i, 3 * column + j)] = values[block][i][j]);
                }
            }
        }
        let eigenvalues = matrix.symmetric_eigenvalues();
        let condition = eigenvalues.max() / eigenvalues.min();
        let b = random(pattern.rows(), 5);
        Self { beam, matrix, condition, b }
    }

    /// The energy norm √(eᵀ A e) of the error of every iterate from zero on, until a relative residual is reached.
    fn errors(&self, choice: SolverChoice, tolerance: f64) -> Vec<f64> {
        let exact = self.matrix.clone().cholesky().unwrap().solve(&DVector::from_column_slice(self.b.as_flattened()));
        let mut errors = Vec::new();
        let mut solver = Solver::new(choice, &self.beam.pattern, &self.beam.rest);
        let values = self.beam.values::<f64>();
        solver.prepare(&values).unwrap();
        let mut x = vec![[0.0; 3]; self.b.len()];
        let mut observe = |x: &[[f64; 3]]| {
            let error = DVector::from_column_slice(x.as_flattened()) - &exact;
            errors.push(error.dot(&(&self.matrix * &error)).sqrt());
        };
        let iterations = solver.solve_observed(&values, &self.b, &mut x, tolerance, &mut observe).unwrap();
        assert_eq!(errors.len(), iterations + 1, "{choice:?}");
        errors
    }
}

#[test]
fn errors_stay_below_the_bounds_of_the_condition_number_at_every_iteration() {
    let system = System::new();
    let (kappa, root) = (system.condition, system.condition.sqrt());
    assert!(kappa > 10.0 && kappa < 1e5, "{kappa}");
    let bounds: [(SolverChoice, f64, f64); 3] = [
        (SolverChoice::SteepestDescent, 1.0, (kappa - 1.0) / (kappa + 1.0)),
        (SolverChoice::ConjugateDirections, 2.0, (root - 1.0) / (root + 1.0)),
        (SolverChoice::Cg, 2.0, (root - 1.0) / (root + 1.0)),
    ];
    for (choice, factor, rate) in bounds {
        let errors = system.errors(choice, 1e-6);
        for (i, error) in errors.iter().enumerate() {
            let bound = factor * rate.powi(i as i32) * errors[0];
            assert!(*error <= bound * (1.0 + 1e-9), "{choice:?}, iteration {i}: {error:e} above {bound:e}");
        }
        assert!(errors.windows(2).all(|pair| pair[1] <= pair[0] * (1.0 + 1e-12)), "{choice:?} does not descend");
    }
}

#[test]
fn conjugate_directions_have_the_iterates_of_conjugate_gradients_and_end_within_as_many_as_there_are_unknowns() {
    let system = System::new();
    let [directions, gradients] =
        [SolverChoice::ConjugateDirections, SolverChoice::Cg].map(|choice| system.errors(choice, 1e-10));
    for (i, (one, other)) in directions.iter().zip(&gradients).take(20).enumerate() {
        assert!((one - other).abs() < 1e-9 * directions[0], "iteration {i}: {one:e} and {other:e}");
    }
    // Round-off decides the last iteration.
    let most = gradients.len().min(3 * system.b.len()) + 1;
    assert!(directions.len() <= most, "{} of {most} iterates", directions.len());
    let descent = system.errors(SolverChoice::SteepestDescent, 1e-6).len();
    assert!(descent > 4 * system.errors(SolverChoice::Cg, 1e-6).len(), "{descent} iterations of steepest descent");
}

#[test]
fn an_indefinite_matrix_and_a_tolerance_out_of_reach_are_reported() {
    use fem_model::simulation::Breakdown;
    let beam = Beam::new(2, SolverChoice::Cg.stored());
    let b = random(beam.pattern.rows(), 3);
    let solve = |choice, values: &[[[f64; 3]; 3]]| {
        let mut solver = Solver::new(choice, &beam.pattern, &beam.rest);
        solver.prepare(values)?;
        solver.solve(values, &b, &mut vec![[0.0; 3]; b.len()], 1e-10)
    };
    for choice in [SolverChoice::SteepestDescent, SolverChoice::ConjugateDirections] {
        assert_eq!(solve(choice, &beam.scaled(|_| -1.0, 0.0)), Err(Breakdown::NotPositiveDefinite), "{choice:?}");
        let broken = beam.scaled(|_| f64::NAN, 0.0);
        assert_eq!(solve(choice, &broken), Err(Breakdown::Singular), "{choice:?}");
        assert!(choice.to_string().ends_with("for teaching") && choice.is_iterative(), "{choice}");
    }
}

//! The Cholesky factorisations against each other.

use super::faer_cholesky::FaerCholesky;
use super::single::SingleCholesky;
use super::{SupernodalCholesky, cholesky};
use crate::solvers::ApproximateInverse;
use crate::solvers::beam::{Beam, random};
use fem_elements::sparse::Stored;
use fem_elements::vector::{norm, subtract_from};

#[test]
fn both_cholesky_factors_give_the_same_solution() {
    let beam = Beam::new(5, Stored::Lower);
    let values = beam.values::<f64>();
    let b = random(beam.pattern.rows(), 9);
    let (mut x, mut y) = (b.clone(), b.clone());
    let (mut supernodal, mut faer) = (SupernodalCholesky::new(&beam.pattern), FaerCholesky::new(&beam.pattern));
    supernodal.prepare(&values).unwrap();
    faer.prepare(&values).unwrap();
    supernodal.apply(&b, &mut x);
    faer.apply(&b, &mut y);
    for (x, y) in x.as_flattened().iter().zip(y.as_flattened()) {
        approx::assert_relative_eq!(x, y, max_relative = 1e-8, epsilon = 1e-16);
    }
}

#[test]
fn both_cholesky_factorisations_fail_alike() {
    let beam = Beam::new(3, Stored::Lower);
    let indefinite = beam.scaled::<f64>(|element| if element % 5 == 0 { -1.5 } else { 1.0 }, 0.0);
    let mut infinite = beam.values::<f64>();
    infinite[7][1][1] = f64::INFINITY;
    for values in [indefinite, infinite] {
        let outcome = SupernodalCholesky::new(&beam.pattern).prepare(&values);
        assert!(outcome.is_err());
        assert_eq!(outcome, FaerCholesky::new(&beam.pattern).prepare(&values));
    }
}

/// Relative distance of the solutions by the factor in single precision and by the one in double precision.
fn error_of_single(beam: &Beam, values: &[[[f64; 3]; 3]]) -> f64 {
    let b = random(beam.pattern.rows(), 9);
    let (mut x, mut y) = (b.clone(), b.clone());
    let (mut single, mut double) = (SingleCholesky::new(&beam.pattern), cholesky::<f64>(&beam.pattern));
    single.prepare(values).unwrap();
    double.prepare(values).unwrap();
    single.apply(&b, &mut x);
    double.apply(&b, &mut y);
    subtract_from(&y, &mut x);
    norm(&x) / norm(&y)
}

#[test]
fn a_factor_in_single_precision_has_a_few_digits_at_any_scale() {
    let beam = Beam::new(4, Stored::Lower);
    for scale in [1.0, 1e-100, 1e100] {
        let values: Vec<_> = beam.values::<f64>().iter().map(|block| block.map(|row| row.map(|x| scale * x))).collect();
        let error = error_of_single(&beam, &values);
        assert!(error < 1e-4 && error > 1e-12, "{scale:e}: {error:e}");
    }
}

#[test]
fn an_ill_conditioned_matrix_is_factored_in_its_own_precision() {
    let beam = Beam::constrained_where(4, Stored::Lower, |x| x.x == 0.0 && x.y == 0.0 && x.z == 0.0);
    assert_eq!(error_of_single(&beam, &beam.scaled(|_| 1.0, 1e-9)), 0.0);
}

#[test]
fn a_factor_in_single_precision_refuses_the_same_matrices() {
    let beam = Beam::new(3, Stored::Lower);
    let indefinite = beam.scaled::<f64>(|element| if element % 5 == 0 { -1.5 } else { 1.0 }, 0.0);
    let zero = beam.scaled::<f64>(|_| 0.0, 0.0);
    let mut infinite = beam.values::<f64>();
    infinite[7][1][1] = f64::INFINITY;
    for values in [indefinite, zero, infinite] {
        let outcome = SingleCholesky::new(&beam.pattern).prepare(&values);
        assert!(outcome.is_err());
        assert_eq!(outcome, SupernodalCholesky::new(&beam.pattern).prepare(&values));
    }
}

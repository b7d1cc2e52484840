//! The two Cholesky factorisations against each other.

use super::SupernodalCholesky;
use super::faer_cholesky::FaerCholesky;
use crate::solvers::ApproximateInverse;
use crate::solvers::beam::{Beam, random};
use crate::sparse::Stored;

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

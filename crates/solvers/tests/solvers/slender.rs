//! Multigrid on slender and curved beams, and the factor that takes over where it breaks down.

use fem_elements::sparse::Stored;
use fem_elements::vector::{norm, subtract_from};
use fem_model::simulation::Breakdown;
use fem_solvers::{Preconditioner, Solver, SolverChoice};

use super::beam::{Beam, random};
use super::residual;

const MULTIGRID: SolverChoice = SolverChoice::Pcg(Preconditioner::Multigrid);

/// A quarter of a ring, as long as `slenderness` times its thickness.
fn quarter_ring(slenderness: f64) -> impl Fn([f64; 3]) -> [f64; 3] {
    move |[s, y, z]| {
        let radius = slenderness * std::f64::consts::FRAC_2_PI;
        let (sine, cosine) = (s * std::f64::consts::FRAC_PI_2).sin_cos();
        [(radius + y) * sine, (radius + y) * cosine, z]
    }
}

/// A straight beam that is twisted by three turns.
fn twisted(slenderness: f64) -> impl Fn([f64; 3]) -> [f64; 3] {
    move |[s, y, z]| {
        let (sine, cosine) = (s * 6.0 * std::f64::consts::PI).sin_cos();
        let (y, z) = (y - 0.5, 0.5 * (z - 0.5));
        [s * slenderness, y * cosine - z * sine, y * sine + z * cosine]
    }
}

/// Displacements under a lateral load on all nodes, and the iterations.
fn bent(beam: &Beam, choice: SolverChoice) -> Result<(Vec<[f64; 3]>, usize), Breakdown> {
    let values = beam.scaled(|_| 1.0, 0.0);
    let mut solver = Solver::new(choice, &beam.pattern, &beam.rest);
    solver.prepare(&values)?;
    let b = vec![[0.0, 1.0, 1.0]; beam.pattern.rows()];
    let mut x = vec![[0.0; 3]; b.len()];
    let iterations = solver.solve(&values, &b, &mut x, 1e-12)?;
    Ok((x, iterations))
}

fn agrees_with_cholesky(beam: &Beam, most_iterations: usize, name: &str) {
    let (mut x, iterations) = bent(beam, MULTIGRID).unwrap_or_else(|breakdown| panic!("{name}: {breakdown:?}"));
    let (exact, _) = bent(beam, SolverChoice::Cholesky).unwrap();
    assert!(iterations <= most_iterations, "{name}: {iterations} iterations");
    subtract_from(&exact, &mut x);
    let error = norm(&x) / norm(&exact);
    // Round-off alone moves the most slender one by 1e-6: its condition number is about 1e10.
    assert!(error < 1e-5, "{name}: {error:e}");
}

#[test]
fn multigrid_agrees_with_cholesky_on_slender_curved_beams() {
    for (along, slenderness) in [(100, 25.0), (200, 100.0), (200, 300.0)] {
        let beam = Beam::mapped([along, 4], Stored::Lower, quarter_ring(slenderness));
        agrees_with_cholesky(&beam, 400, &format!("ring of {slenderness}"));
    }
}

/// A smaller copy of the curved beam of MacNeal and Harder, A Proposed Standard Set of Problems to Test Finite Element Accuracy (1985), in
/// elements five times as long as thick.
#[test]
fn multigrid_agrees_with_cholesky_on_the_curved_beam_of_macneal_and_harder() {
    let map = |[s, y, z]: [f64; 3]| {
        let (sine, cosine) = (s * std::f64::consts::FRAC_PI_2).sin_cos();
        [(4.12 + 0.2 * y) * sine, (4.12 + 0.2 * y) * cosine, 0.1 * z]
    };
    agrees_with_cholesky(&Beam::mapped([192, 4], Stored::Lower, map), 150, "curved beam");
}

#[test]
fn multigrid_agrees_with_cholesky_on_slender_straight_and_twisted_beams() {
    agrees_with_cholesky(&Beam::mapped([300, 4], Stored::Lower, |[s, y, z]| [s * 75.0, y, z]), 150, "straight");
    agrees_with_cholesky(&Beam::mapped([300, 4], Stored::Lower, twisted(75.0)), 150, "twisted");
}

#[test]
fn multigrid_takes_few_iterations_for_stretched_elements() {
    let beam = Beam::mapped([30, 8], Stored::Lower, |[s, y, z]| [s * 40.0, y, z]);
    agrees_with_cholesky(&beam, 150, "elements ten times as long as thick");
}

/// Nine nodes on a line have five rigid motions, and so has an aggregate of them.
#[test]
fn multigrid_works_on_a_beam_of_one_element_across() {
    agrees_with_cholesky(&Beam::mapped([200, 1], Stored::Lower, |[s, y, z]| [s * 200.0, y, z]), 200, "one across");
}

/// A beam so slender that conjugate gradients with sweeps stagnate.
fn stagnating() -> (Beam, Solver<f64>) {
    let choice = SolverChoice::Pcg(Preconditioner::Ssor);
    let beam = Beam::mapped([300, 2], choice.stored(), quarter_ring(1000.0));
    let solver = Solver::new(choice, &beam.pattern, &beam.rest);
    (beam, solver)
}

#[test]
fn a_solver_that_breaks_down_falls_back_to_a_factor_and_counts_it() {
    let (beam, solver) = stagnating();
    let values = beam.scaled(|_| 1.0, 0.0);
    let b = random(beam.pattern.rows(), 3);
    let mut x = vec![[0.0; 3]; b.len()];
    let mut solver = solver.with_direct_fallback();
    solver.prepare(&values).unwrap();
    let iterations = solver.solve(&values, &b, &mut x, 1e-8).unwrap();
    // The product of another order of sums has this residual by rounding alone.
    assert!(residual(&beam, &values, &b, &x) < 1e-5);
    assert_eq!((iterations, solver.counters().fallbacks), (1, 1));
}

#[test]
fn only_a_factor_says_that_a_matrix_is_not_positive_definite() {
    let choice = SolverChoice::Pcg(Preconditioner::Ssor);
    let beam = Beam::new(3, choice.stored());
    let bad = beam.scaled::<f64>(|element| if element % 5 == 0 { -1.5 } else { 1.0 }, 0.0);
    let mut solver = Solver::new(choice, &beam.pattern, &beam.rest).with_direct_fallback();
    assert_eq!(solver.prepare(&bad), Err(Breakdown::NotPositiveDefinite));
    assert_eq!(solver.counters().fallbacks, 0);
}

#[test]
fn without_memory_for_a_factor_nothing_is_known_but_that_the_iteration_has_not_converged() {
    let choice = SolverChoice::Pcg(Preconditioner::Ssor);
    let beam = Beam::new(3, choice.stored());
    let bad = beam.scaled::<f64>(|element| if element % 5 == 0 { -1.5 } else { 1.0 }, 0.0);
    let outcome = |limit: Option<usize>| {
        Solver::new(choice, &beam.pattern, &beam.rest).with_direct_fallback_within(limit).prepare(&bad)
    };
    assert_eq!(outcome(Some(1000)), Err(Breakdown::NotConverged { residual: 1.0 }));
    assert_eq!(outcome(None), Err(Breakdown::NotPositiveDefinite));
}

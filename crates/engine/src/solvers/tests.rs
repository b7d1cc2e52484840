//! Every solver against each other, on matrices of a beam.

use super::beam::{Beam, random};
use super::{Breakdown, Preconditioner, Solver, SolverChoice, product};
use crate::number::Real;
use crate::vector::norm;

const KINDS: [SolverChoice; 7] = [
    SolverChoice::Cholesky,
    SolverChoice::Lu,
    SolverChoice::Cg,
    SolverChoice::Pcg(Preconditioner::BlockJacobi),
    SolverChoice::Pcg(Preconditioner::IncompleteCholesky),
    SolverChoice::Pcg(Preconditioner::Multigrid),
    SolverChoice::Pcg(Preconditioner::Ssor),
];

fn beam<T: Real>(kind: SolverChoice, cells: usize) -> (Beam, Solver<T>) {
    let beam = Beam::new(cells, kind.stored());
    let solver = Solver::new(kind, &beam.pattern, &beam.rest);
    (beam, solver)
}

fn relative_residual<T: Real>(beam: &Beam, values: &[[[T; 3]; 3]], b: &[[T; 3]], x: &[[T; 3]]) -> f64 {
    let mut r = b.to_vec();
    product(&beam.pattern, values, x, &mut r);
    for (r, b) in r.as_flattened_mut().iter_mut().zip(b.as_flattened()) {
        *r = *b - *r;
    }
    norm(&r) / norm(b)
}

fn solves<T: Real>(kind: SolverChoice, tolerance: f64) {
    let (beam, mut solver) = beam::<T>(kind, 4);
    let values = beam.values::<T>();
    solver.prepare(&values).unwrap();
    for seed in 0..3 {
        let b = random::<T>(beam.pattern.rows(), seed);
        let mut x = vec![[T::default(); 3]; b.len()];
        let solved = solver.solve(&values, &b, &mut x, tolerance).unwrap_or_else(|error| panic!("{kind:?}: {error:?}"));
        let direct = matches!(kind, SolverChoice::Cholesky | SolverChoice::Lu);
        assert_eq!(solved.iterations == 0, direct, "{kind:?}: {solved:?}");
        let residual = relative_residual(&beam, &values, &b, &x);
        assert!(residual <= tolerance, "{kind:?}: {residual}");
    }
}

#[test]
fn every_solver_solves_in_double() {
    KINDS.iter().for_each(|&kind| solves::<f64>(kind, 1e-10));
}

#[test]
fn every_solver_solves_in_single() {
    KINDS.iter().for_each(|&kind| solves::<f32>(kind, 1e-5));
}

#[test]
fn every_solver_finds_the_same_solution() {
    let solutions = KINDS.map(|kind| {
        let (beam, mut solver) = beam::<f64>(kind, 3);
        let values = beam.values();
        let b = random(beam.pattern.rows(), 7);
        let mut x = vec![[0.0; 3]; b.len()];
        solver.prepare(&values).unwrap();
        solver.solve(&values, &b, &mut x, 1e-12).unwrap();
        x
    });
    let size = norm(&solutions[0]);
    for (kind, solution) in KINDS.iter().zip(&solutions) {
        let apart: f64 =
            solution.as_flattened().iter().zip(solutions[0].as_flattened()).map(|(x, y)| (x - y).abs()).sum();
        assert!(apart < 1e-9 * size, "{kind:?}: {apart} of {size}");
    }
}

fn outcome(kind: SolverChoice, beam: &Beam, values: &[[[f64; 3]; 3]]) -> Result<(), Breakdown> {
    let mut solver = Solver::new(kind, &beam.pattern, &beam.rest);
    solver.prepare(values)?;
    let b = random(beam.pattern.rows(), 3);
    solver.solve(values, &b, &mut vec![[0.0; 3]; b.len()], 1e-10).map(|_| ())
}

fn held(kind: SolverChoice) -> Beam {
    Beam::new(3, kind.stored())
}

#[test]
fn an_indefinite_matrix_is_told() {
    // LU solves with it as with any other.
    for kind in KINDS.into_iter().filter(|&kind| kind != SolverChoice::Lu) {
        let beam = held(kind);
        let values = beam.scaled(|element| if element % 5 == 0 { -1.5 } else { 1.0 }, 0.0);
        assert_eq!(outcome(kind, &beam, &values), Err(Breakdown::NotPositiveDefinite), "{kind:?}");
    }
}

#[test]
fn a_matrix_that_is_not_finite_is_told() {
    for kind in KINDS {
        for bad in [f64::NAN, f64::INFINITY] {
            let beam = held(kind);
            let mut values = beam.values();
            values[beam.pattern.find(20, 20).unwrap()][1][1] = bad;
            assert_eq!(outcome(kind, &beam, &values), Err(Breakdown::Singular), "{kind:?}: {bad}");
        }
    }
}

#[test]
fn a_bad_matrix_leaves_nothing_behind() {
    for kind in KINDS {
        let (beam, mut solver) = beam::<f64>(kind, 3);
        let good = beam.values();
        let b = random(beam.pattern.rows(), 3);
        let mut x = vec![[0.0; 3]; b.len()];
        for place in [0, 40, beam.pattern.blocks() - 1] {
            let mut bad = good.clone();
            bad[place][2][2] = f64::NAN;
            let told = solver.prepare(&bad).and_then(|()| solver.solve(&bad, &b, &mut x, 1e-10).map(|_| ()));
            assert!(told.is_err(), "{kind:?}: {told:?}");
            solver.prepare(&good).unwrap();
            x.fill([0.0; 3]);
            solver.solve(&good, &b, &mut x, 1e-10).unwrap();
            assert!(relative_residual(&beam, &good, &b, &x) <= 1e-10, "{kind:?}");
        }
    }
}

#[test]
fn a_matrix_that_lets_a_body_float_is_told() {
    for kind in KINDS {
        let beam = Beam::held_where(2, kind.stored(), |_| false);
        let told = outcome(kind, &beam, &beam.scaled(|_| 1.0, 0.0));
        // rounding decides the sign of a pivot that should be 0
        assert!(told.is_err(), "{kind:?}: {told:?}");
    }
}

#[test]
fn an_older_preparation_still_solves() {
    for kind in KINDS {
        let (beam, mut solver) = beam::<f64>(kind, 3);
        solver.prepare(&beam.values()).unwrap();
        let values = beam.scaled(|element| 1.0 + 0.5 * f64::from((element % 7) as u32), 1e4);
        let b = random(beam.pattern.rows(), 5);
        let mut x = vec![[0.0; 3]; b.len()];
        let solved = solver.solve(&values, &b, &mut x, 1e-10).unwrap();
        assert!(relative_residual(&beam, &values, &b, &x) <= 1e-10, "{kind:?}");
        assert!(solved.iterations > 0, "{kind:?}");
        if kind == SolverChoice::Cholesky {
            assert!(solved.iterations < 30, "{solved:?}");
        }
    }
}

#[test]
fn counters_count() {
    let (beam, mut solver) = beam::<f64>(SolverChoice::Pcg(Preconditioner::BlockJacobi), 2);
    let values = beam.values();
    let b = random(beam.pattern.rows(), 5);
    solver.prepare(&values).unwrap();
    let mut x = vec![[0.0; 3]; b.len()];
    let first = solver.solve(&values, &b, &mut x, 1e-8).unwrap();
    let again = solver.solve(&values, &b, &mut x, 1e-8).unwrap();
    assert_eq!(again.iterations, 0);
    let counters = solver.counters();
    assert_eq!(counters.symbolic_factorizations, 1);
    assert_eq!(counters.factorizations, 1);
    assert_eq!(counters.solves, 2);
    assert_eq!(counters.iterations, first.iterations);
}

#[test]
fn multigrid_takes_few_more_iterations_on_a_finer_mesh() {
    let iterations = [6, 12].map(|cells| {
        let (beam, mut solver) = beam::<f64>(SolverChoice::Pcg(Preconditioner::Multigrid), cells);
        let values = beam.scaled(|_| 1.0, 0.0);
        let b = random(beam.pattern.rows(), 11);
        let mut x = vec![[0.0; 3]; b.len()];
        solver.prepare(&values).unwrap();
        solver.solve(&values, &b, &mut x, 1e-8).unwrap().iterations
    });
    assert!(iterations[0] < 40 && 2 * iterations[1] < 3 * iterations[0], "{iterations:?}");
}

#[test]
fn nothing_is_allocated_after_the_first_solve() {
    for kind in KINDS {
        let (beam, mut solver) = beam::<f64>(kind, 3);
        let values = beam.values();
        let b = random(beam.pattern.rows(), 5);
        let mut x = vec![[0.0; 3]; b.len()];
        let mut solve = || {
            x.fill([0.0; 3]);
            solver.prepare(&values).unwrap();
            solver.solve(&values, &b, &mut x, 1e-8).unwrap();
        };
        solve();
        let allocated = allocation_counter::measure(solve);
        assert_eq!(allocated.count_total, 0, "{kind:?}");
    }
}

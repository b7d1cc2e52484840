//! What every solver does.

use fem_elements::vector::{dot, norm};
use fem_model::simulation::Breakdown;
use fem_solvers::{Preconditioner, Real, Solver, SolverChoice};

use super::beam::{Beam, random};
use super::{beam, residual};

const CHOICES: [SolverChoice; 6] = [
    SolverChoice::Cholesky,
    SolverChoice::Lu,
    SolverChoice::Cg,
    SolverChoice::Pcg(Preconditioner::BlockJacobi),
    SolverChoice::Pcg(Preconditioner::Multigrid),
    SolverChoice::Pcg(Preconditioner::Ssor),
];

fn solves<T: Real>(choice: SolverChoice, tolerance: f64) {
    let (beam, mut solver) = beam::<T>(choice, 4);
    let values = beam.values::<T>();
    solver.prepare(&values).unwrap();
    for seed in 0..3 {
        let b = random::<T>(beam.pattern.rows(), seed);
        let mut x = vec![[T::default(); 3]; b.len()];
        let iterations =
            solver.solve(&values, &b, &mut x, tolerance).unwrap_or_else(|error| panic!("{choice:?}: {error:?}"));
        assert_eq!(iterations > 0, choice.is_iterative(), "{choice:?}: {iterations}");
        let left = residual(&beam, &values, &b, &x);
        assert!(left <= tolerance, "{choice:?}: {left}");
    }
}

#[test]
fn every_solver_solves_in_double() {
    CHOICES.iter().for_each(|&choice| solves::<f64>(choice, 1e-10));
}

#[test]
fn every_solver_solves_in_single() {
    CHOICES.iter().for_each(|&choice| solves::<f32>(choice, 1e-5));
}

#[test]
fn every_solver_finds_the_same_solution() {
    let solutions = CHOICES.map(|choice| {
        let (beam, mut solver) = beam::<f64>(choice, 3);
        let values = beam.values();
        let b = random(beam.pattern.rows(), 7);
        let mut x = vec![[0.0; 3]; b.len()];
        solver.prepare(&values).unwrap();
        solver.solve(&values, &b, &mut x, 1e-12).unwrap();
        x
    });
    let size = norm(&solutions[0]);
    for (choice, solution) in CHOICES.iter().zip(&solutions) {
        let difference: f64 =
            solution.as_flattened().iter().zip(solutions[0].as_flattened()).map(|(x, y)| (x - y).abs()).sum();
        assert!(difference < 1e-9 * size, "{choice:?}: {difference} of {size}");
    }
}

fn outcome(choice: SolverChoice, beam: &Beam, values: &[[[f64; 3]; 3]]) -> Result<(), Breakdown> {
    let mut solver = Solver::new(choice, &beam.pattern, &beam.rest);
    solver.prepare(values)?;
    let b = random(beam.pattern.rows(), 3);
    solver.solve(values, &b, &mut vec![[0.0; 3]; b.len()], 1e-10).map(|_| ())
}

#[test]
fn an_indefinite_matrix_is_reported() {
    // LU factorises it as any other matrix.
    for choice in CHOICES.into_iter().filter(|&choice| choice != SolverChoice::Lu) {
        let beam = Beam::new(3, choice.stored());
        let values = beam.scaled(|element| if element % 5 == 0 { -1.5 } else { 1.0 }, 0.0);
        assert_eq!(outcome(choice, &beam, &values), Err(Breakdown::NotPositiveDefinite), "{choice:?}");
    }
}

#[test]
fn a_matrix_that_is_not_finite_is_reported() {
    for choice in CHOICES {
        for bad in [f64::NAN, f64::INFINITY] {
            let beam = Beam::new(3, choice.stored());
            let mut values = beam.values();
            values[beam.pattern.find(20, 20).unwrap()][1][1] = bad;
            assert_eq!(outcome(choice, &beam, &values), Err(Breakdown::Singular), "{choice:?}: {bad}");
        }
    }
}

#[test]
fn a_solver_recovers_from_a_matrix_that_is_not_finite() {
    for choice in CHOICES {
        let (beam, mut solver) = beam::<f64>(choice, 3);
        let good = beam.values();
        let b = random(beam.pattern.rows(), 3);
        let mut x = vec![[0.0; 3]; b.len()];
        for place in [0, 40, beam.pattern.blocks() - 1] {
            let mut bad = good.clone();
            bad[place][2][2] = f64::NAN;
            let outcome = solver.prepare(&bad).and_then(|()| solver.solve(&bad, &b, &mut x, 1e-10).map(|_| ()));
            assert!(outcome.is_err(), "{choice:?}: {outcome:?}");
            solver.prepare(&good).unwrap();
            x.fill([0.0; 3]);
            solver.solve(&good, &b, &mut x, 1e-10).unwrap();
            assert!(residual(&beam, &good, &b, &x) <= 1e-10, "{choice:?}");
        }
    }
}

#[test]
fn the_matrix_of_an_unconstrained_body_is_reported() {
    for choice in CHOICES {
        let beam = Beam::constrained_where(2, choice.stored(), |_| false);
        let outcome = outcome(choice, &beam, &beam.scaled(|_| 1.0, 0.0));
        // Round-off decides the sign of a pivot that should be zero.
        assert!(outcome.is_err(), "{choice:?}: {outcome:?}");
    }
}

#[test]
fn a_factor_or_preconditioner_of_an_earlier_matrix_still_serves() {
    for choice in CHOICES {
        let (beam, mut solver) = beam::<f64>(choice, 3);
        solver.prepare(&beam.values()).unwrap();
        let values = beam.scaled(|element| 1.0 + 0.5 * f64::from((element % 7) as u32), 1e4);
        let b = random(beam.pattern.rows(), 5);
        let mut x = vec![[0.0; 3]; b.len()];
        let iterations = solver.solve(&values, &b, &mut x, 1e-10).unwrap();
        assert!(residual(&beam, &values, &b, &x) <= 1e-10, "{choice:?}");
        assert!(iterations > 0, "{choice:?}");
        if choice == SolverChoice::Cholesky {
            assert!(iterations < 30, "{iterations}");
        }
    }
}

#[test]
fn counters_count_every_operation() {
    let (beam, mut solver) = beam::<f64>(SolverChoice::Pcg(Preconditioner::BlockJacobi), 2);
    let values = beam.values();
    let b = random(beam.pattern.rows(), 5);
    solver.prepare(&values).unwrap();
    let mut x = vec![[0.0; 3]; b.len()];
    let first = solver.solve(&values, &b, &mut x, 1e-8).unwrap();
    let again = solver.solve(&values, &b, &mut x, 1e-8).unwrap();
    assert_eq!(again, 0);
    let counters = solver.counters();
    assert_eq!(counters.symbolic_factorizations, 1);
    assert_eq!(counters.factorizations, 1);
    assert_eq!(counters.solves, 2);
    assert_eq!(counters.iterations, first);
}

#[test]
fn multigrid_takes_few_more_iterations_on_a_finer_mesh() {
    let iterations = [6, 12].map(|cells| {
        let (beam, mut solver) = beam::<f64>(SolverChoice::Pcg(Preconditioner::Multigrid), cells);
        let values = beam.scaled(|_| 1.0, 0.0);
        let b = random(beam.pattern.rows(), 11);
        let mut x = vec![[0.0; 3]; b.len()];
        solver.prepare(&values).unwrap();
        solver.solve(&values, &b, &mut x, 1e-8).unwrap()
    });
    assert!(iterations[0] < 40 && 2 * iterations[1] < 3 * iterations[0], "{iterations:?}");
}

#[test]
fn solutions_are_the_same_bits_with_any_number_of_threads() {
    for choice in [SolverChoice::Cg, SolverChoice::Pcg(Preconditioner::Ssor)] {
        let beam = Beam::new(12, choice.stored());
        let (values, b) = (beam.values::<f64>(), random(beam.pattern.rows(), 5));
        let solution = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| {
                let mut solver = Solver::new(choice, &beam.pattern, &beam.rest);
                let mut x = vec![[0.0; 3]; b.len()];
                solver.prepare(&values).unwrap();
                let iterations = solver.solve(&values, &b, &mut x, 1e-3).unwrap();
                (iterations, x.as_flattened().iter().map(|x| x.to_bits()).collect::<Vec<_>>())
            })
        };
        let one = solution(1);
        assert!([2, 3].into_iter().all(|threads| solution(threads) == one), "{choice}");
    }
}

#[test]
fn a_cycle_of_multigrid_is_symmetric_and_the_same_bits_with_any_number_of_threads() {
    let applied = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let (beam, mut solver) = beam::<f64>(SolverChoice::Pcg(Preconditioner::Multigrid), 12);
            solver.prepare(&beam.values()).unwrap();
            [1, 2].map(|seed| {
                let r = random::<f64>(beam.pattern.rows(), seed);
                let mut z = vec![[0.0; 3]; r.len()];
                solver.apply(&r, &mut z);
                (r, z)
            })
        })
    };
    let one = applied(1);
    assert!([2, 3].into_iter().all(|threads| applied(threads) == one));
    let [(a, Pa), (b, Pb)] = &one;
    let (a_Pb, b_Pa) = (dot(a, Pb), dot(b, Pa));
    assert!((a_Pb - b_Pa).abs() < 1e-5 * norm(a) * norm(Pb), "{a_Pb} and {b_Pa}");
    assert!(dot(a, Pa) > 0.0);
}

/// The beam of 20 cells per metre has 1360 aggregates, which are aggregated in turn; those of 10 cells per metre are not.
#[test]
fn a_further_level_of_multigrid_takes_few_more_iterations() {
    let iterations = [10, 20].map(|cells| {
        let (beam, mut solver) = beam::<f64>(SolverChoice::Pcg(Preconditioner::Multigrid), cells);
        let values = beam.scaled(|_| 1.0, 0.0);
        let mut b = vec![[0.0; 3]; beam.pattern.rows()];
        beam.rest.iter().zip(&mut b).filter(|(x, _)| x[0] == 4.0).for_each(|(_, b)| b[2] = -1.0);
        let mut x = vec![[0.0; 3]; b.len()];
        solver.prepare(&values).unwrap();
        solver.solve(&values, &b, &mut x, 1e-12).unwrap()
    });
    assert!(iterations[1] <= iterations[0] + 4, "{iterations:?}");
}

#[test]
fn every_choice_says_whether_it_has_a_preconditioner_and_names_it() {
    for choice in CHOICES {
        let (_, solver) = beam::<f64>(choice, 1);
        let name = match choice {
            SolverChoice::Cholesky => "Cholesky",
            SolverChoice::Lu => "LU",
            SolverChoice::Cg => "conjugate gradients",
            SolverChoice::Pcg(Preconditioner::BlockJacobi) => "block Jacobi",
            SolverChoice::Pcg(Preconditioner::Multigrid) => "multigrid",
            SolverChoice::Pcg(Preconditioner::Ssor) => "SSOR",
            SolverChoice::Gpu(_) => continue,
        };
        assert!(choice.to_string().contains(name), "{choice}");
        let has_preconditioner = !matches!(choice, SolverChoice::Cholesky | SolverChoice::Lu | SolverChoice::Cg);
        assert_eq!(solver.has_preconditioner(), has_preconditioner, "{choice:?}");
        assert_eq!(choice.to_string().starts_with("conjugate gradients"), solver.is_iterative(), "{choice}");
        // The vectors of the iteration belong to the solver, the rest to the factor or the preconditioner.
        assert_eq!(solver.prepared_bytes() > 0, choice != SolverChoice::Cg, "{choice:?}");
        assert!(solver.bytes() > solver.prepared_bytes(), "{choice:?}");
    }
}

#[test]
fn no_solver_allocates_after_its_first_solve() {
    for choice in CHOICES {
        let (beam, mut solver) = beam::<f64>(choice, 3);
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
        assert_eq!(allocated.count_total, 0, "{choice:?}");
    }
}

#[test]
fn constrained_directions_are_not_corrected() {
    let constrained = |beam: &Beam| {
        let mut values = beam.values::<f64>();
        for row in 0..beam.pattern.rows() {
            for block in beam.pattern.row(row) {
                let column = beam.pattern.columns[block] as usize;
                for (node, is_row) in [(row, true), (column, false)] {
                    if node % 3 == 0 {
                        (0..3).for_each(|k| {
                            *if is_row { &mut values[block][1][k] } else { &mut values[block][k][1] } = 0.0
                        });
                    }
                }
                if row == column && row % 3 == 0 {
                    values[block][1][1] = values[block][0][0];
                }
            }
        }
        values
    };
    let (beam, mut solver) = beam(SolverChoice::Pcg(Preconditioner::Ssor), 4);
    let values = constrained(&beam);
    let mut b = random::<f64>(beam.pattern.rows(), 3);
    b.iter_mut().step_by(3).for_each(|b| b[1] = 0.0);
    let mut x = vec![[0.0; 3]; b.len()];
    solver.prepare(&values).unwrap();
    solver.solve(&values, &b, &mut x, 1e-6).unwrap();
    assert!(x.iter().step_by(3).all(|x| x[1] == 0.0 && x[0] != 0.0));
}

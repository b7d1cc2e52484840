//! Factorisations against the matrices that they are of, and against each other.

use fem_elements::sparse::{Block, Stored};
use fem_elements::vector::{norm, subtract_from};
use fem_model::simulation::Breakdown;
use fem_solvers::{Ldlt, Solver, SolverChoice};

use super::beam::{Beam, random};
use super::{beam, residual};

/// The solution with a prepared factor alone, without a correction.
fn applied(solver: &mut Solver<f64>, b: &[[f64; 3]]) -> Vec<[f64; 3]> {
    let mut x = vec![[0.0; 3]; b.len()];
    solver.apply(b, &mut x);
    x
}

/// Beams of one front and of several, of subtrees that threads share, and of fronts that they share.
const CELLS: [usize; 4] = [1, 3, 6, 11];

#[test]
fn a_cholesky_factor_solves_with_its_matrix() {
    for cells in CELLS {
        let (beam, mut solver) = beam(SolverChoice::Cholesky, cells);
        let (values, b) = (beam.values(), random(beam.pattern.rows(), 9));
        solver.prepare(&values).unwrap();
        let left = residual(&beam, &values, &b, &applied(&mut solver, &b));
        assert!(left < 1e-12, "{cells} cells: {left:e}");
    }
}

/// A matrix that is neither symmetric nor definite, with zeros on its diagonal: blocks of the beam's, and of one that turns by a quarter.
fn turned(beam: &Beam, values: &[Block<f64, 3>]) -> Vec<Block<f64, 3>> {
    let quarter = |[x, y, z]: [f64; 3]| [0.3 * z - y, x, z];
    let rows = (0..beam.pattern.rows()).flat_map(|row| beam.pattern.row(row).map(move |_| row));
    let turn = |(row, block): (usize, &Block<f64, 3>)| match row % 3 {
        0 => *block,
        1 => [0, 1, 2].map(|i| [0, 1, 2].map(|j| quarter([block[0][j], block[1][j], block[2][j]])[i])),
        _ => block.map(|row| row.map(|entry| -entry)),
    };
    rows.zip(values).map(turn).collect()
}

#[test]
fn an_lu_factor_solves_with_matrices_that_are_neither_symmetric_nor_definite() {
    for cells in CELLS {
        let (beam, mut solver) = beam(SolverChoice::Lu, cells);
        let b = random(beam.pattern.rows(), 9);
        for values in [beam.values(), turned(&beam, &beam.values())] {
            solver.prepare(&values).unwrap();
            let left = residual(&beam, &values, &b, &applied(&mut solver, &b));
            assert!(left < 1e-11, "{cells} cells: {left:e}");
        }
    }
}

#[test]
fn an_lu_factor_refuses_a_matrix_with_a_row_of_zeros() {
    let (beam, mut solver) = beam::<f64>(SolverChoice::Lu, 3);
    let mut values = beam.values();
    for block in beam.pattern.row(20) {
        values[block][1] = [0.0; 3];
    }
    assert_eq!(solver.prepare(&values), Err(Breakdown::Singular));
}

#[test]
fn a_factor_does_not_depend_on_the_number_of_threads() {
    for choice in [SolverChoice::Cholesky, SolverChoice::Lu] {
        let (beam, mut solver) = beam(choice, 11);
        let (values, b) = (beam.values(), random(beam.pattern.rows(), 9));
        let [one, two, five] = [1, 2, 5].map(|threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| solver.prepare(&values)).unwrap();
            applied(&mut solver, &b)
        });
        assert!(one == two && two == five, "{choice}");
    }
}

/// The scalars of the lower half of a block matrix: their rows and columns, and their values.
fn scalars(beam: &Beam, values: &[Block<f64, 3>]) -> (Vec<[u32; 2]>, Vec<f64>) {
    let rows = 0..beam.pattern.rows();
    let blocks = rows.flat_map(|row| beam.pattern.row(row).map(move |block| (row as u32, block)));
    let of_block = |(row, block): (u32, usize)| {
        let column = beam.pattern.columns[block];
        let entries =
            (0..9).map(move |k| ([3 * row + k / 3, 3 * column + k % 3], values[block][k as usize / 3][k as usize % 3]));
        entries.filter(|([i, j], _)| j <= i)
    };
    blocks.flat_map(of_block).unzip()
}

#[test]
fn a_factor_of_a_matrix_of_scalars_counts_its_positive_eigenvalues() {
    for cells in [2, 5] {
        let beam = Beam::new(cells, Stored::Lower);
        let (places, mut entries) = scalars(&beam, &beam.values());
        let rows = 3 * beam.pattern.rows();
        let mut factor = Ldlt::new(rows, &places);
        factor.set(entries.iter().copied());
        assert_eq!(factor.factor(), Ok(rows));
        // Congruence with a diagonal of both signs and sizes leaves the matrix definite: so does the other sign of some rows and columns
        // of a quasi-definite matrix count as many negative eigenvalues.
        let negative = |row: u32| row % 7 == 3;
        for (place, entry) in places.iter().zip(&mut entries) {
            if place[0] == place[1] && negative(place[0]) {
                *entry = -*entry;
            } else if negative(place[0]) && negative(place[1]) {
                *entry = 0.0;
            }
        }
        factor.set(entries.iter().copied());
        assert_eq!(factor.factor(), Ok((0..rows as u32).filter(|&row| !negative(row)).count()));
        let b: Vec<f64> = random::<f64>(beam.pattern.rows(), 5).as_flattened().to_vec();
        let mut x = b.clone();
        assert!(factor.solve(&mut x, 1e-10) < 1e-10);
        let mut left = b;
        for (&[i, j], entry) in places.iter().zip(&entries) {
            left[i as usize] -= entry * x[j as usize];
            if i != j {
                left[j as usize] -= entry * x[i as usize];
            }
        }
        assert!(left.iter().all(|left| left.abs() < 1e-8), "{cells} cells");
    }
}

#[test]
fn a_factorisation_of_a_matrix_that_is_not_positive_definite_or_not_finite_fails_in_any_precision() {
    let choice = SolverChoice::Cholesky;
    for cells in [3, 8] {
        let beam = Beam::new(cells, Stored::Lower);
        let indefinite = beam.scaled::<f64>(|element| if element % 5 == 0 { -1.5 } else { 1.0 }, 0.0);
        let mut infinite = beam.values::<f64>();
        infinite[7][1][1] = f64::INFINITY;
        let zero = beam.scaled::<f64>(|_| 0.0, 0.0);
        let verdicts = [Breakdown::NotPositiveDefinite, Breakdown::Singular, Breakdown::Singular];
        for (values, verdict) in [indefinite, infinite, zero].iter().zip(verdicts) {
            for new in [Solver::new, Solver::for_directions] {
                assert_eq!(new(choice, &beam.pattern, &beam.rest).prepare(values), Err(verdict));
            }
        }
    }
}

/// Relative distance of the solutions by the factor in single precision and by the one in double precision.
fn error_of_single(beam: &Beam, values: &[Block<f64, 3>]) -> f64 {
    let b = random(beam.pattern.rows(), 9);
    let [mut x, y] = [Solver::for_directions, Solver::new].map(|new| {
        let mut solver = new(SolverChoice::Cholesky, &beam.pattern, &beam.rest);
        solver.prepare(values).unwrap();
        applied(&mut solver, &b)
    });
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

//! The coarse matrix of SSOR, its effect on the number of iterations, and its next factorisation. A solver's history holds the matrix.

use std::sync::Arc;

use fem_elements::sparse::{Pattern, Stored};
use fem_model::simulation::{Breakdown, History};
use fem_solvers::numbering::{Numbering, Ordering};
use fem_solvers::{Preconditioner, Solver, SolverChoice};
use nalgebra::Vector3;

use super::beam::{Beam, random};

const SSOR: SolverChoice = SolverChoice::Pcg(Preconditioner::Ssor);

/// A prepared solver, and its beam.
fn prepared(cells: usize, values: impl Fn(&Beam) -> Vec<[[f64; 3]; 3]>) -> (Solver<f64>, Beam) {
    let (beam, mut solver) = super::beam(SSOR, cells);
    solver.prepare(&values(&beam)).unwrap();
    (solver, beam)
}

fn history(solver: &Solver<f64>) -> History {
    let mut history = History::default();
    solver.save(false, &mut history);
    history
}

/// Scale of the matrix of which the coarse one was factorised, without which there is no factor.
fn scale(solver: &Solver<f64>) -> f64 {
    history(solver).get("coarse.scale").unwrap()[0]
}

/// Iterations for a right-hand side, with these values of the prepared matrix.
fn iterations(solver: &mut Solver<f64>, beam: &Beam, values: &[[[f64; 3]; 3]]) -> usize {
    let b = random::<f64>(beam.pattern.rows(), 5);
    solver.solve(values, &b, &mut vec![[0.0; 3]; b.len()], 1e-3).unwrap()
}

/// Corners of a row of so many cells, in cells.
fn corners(cells: usize) -> Vec<[usize; 3]> {
    (0..4 * (cells + 1)).map(|corner| [corner / 4, corner / 2 % 2, corner % 2]).collect()
}

/// Values at the nodes of the trilinear functions of a row of cells that fills the box around the nodes.
fn functions(rest: &[[f64; 3]], cells: usize) -> Vec<Vec<f64>> {
    let bound = |i: usize, better: fn(f64, f64) -> f64| rest.iter().map(|x| x[i]).reduce(better).unwrap();
    let [lower, upper] = [f64::min, f64::max].map(|better| [0, 1, 2].map(|i| bound(i, better)));
    let counts = [cells as f64, 1.0, 1.0];
    let value = |x: &[f64; 3], corner: [usize; 3]| {
        let away = |i: usize| (x[i] - lower[i]) / (upper[i] - lower[i]) * counts[i] - corner[i] as f64;
        (0..3).map(|i| (1.0 - away(i).abs()).max(0.0)).product()
    };
    rest.iter().map(|x| corners(cells).into_iter().map(|corner| value(x, corner)).collect()).collect()
}

/// The pattern of the coarse matrix and the corner of each of its rows, in the order that reduces its fill. Cells beside each other are coupled.
fn pattern(cells: usize) -> (Pattern, Vec<u32>) {
    let corners = corners(cells);
    let joined: Vec<[usize; 2]> = (0..corners.len())
        .flat_map(|a| (0..=a).map(move |b| [a, b]))
        .filter(|&[a, b]| corners[a][0] - corners[b][0] <= 2)
        .collect();
    let positions: Vec<_> = corners.iter().map(|corner| Vector3::from(corner.map(|x| x as f64))).collect();
    let constrained = vec![false; corners.len()];
    let numbering = Numbering::new(Ordering::FillReducing, &positions, &joined, &constrained);
    (Pattern::new(corners.len(), &numbering.elements(&joined), Stored::Lower), numbering.mesh_node)
}

#[test]
fn the_coarse_matrix_is_the_galerkin_product_of_the_fine_one() {
    // Cells are about four node distances wide.
    for (fine_cells, cells) in [(3, 2), (7, 5)] {
        let (solver, beam) = prepared(fine_cells, Beam::values);
        let values = beam.values::<f64>();
        // P is the same for the three directions.
        let P = functions(&beam.rest, cells);
        let count = P[0].len();
        let mut expected = vec![vec![[[0.0; 3]; 3]; count]; count];
        for row in 0..beam.pattern.rows() {
            for block in beam.pattern.row(row) {
                let (column, A) = (beam.pattern.columns[block] as usize, values[block]);
                for (i, j, weight) in products(&P[row], &P[column]) {
                    for k in 0..9 {
                        expected[i][j][k / 3][k % 3] += weight * A[k / 3][k % 3];
                        if row != column {
                            expected[j][i][k / 3][k % 3] += weight * A[k % 3][k / 3];
                        }
                    }
                }
            }
        }
        let (pattern, corner) = pattern(cells);
        let history = history(&solver);
        let coarse = history.get("coarse.values").unwrap();
        assert_eq!(coarse.len(), 9 * pattern.blocks(), "{fine_cells} cells");
        let scale = scale(&solver);
        for row in 0..count {
            for block in pattern.row(row) {
                let [a, b] = [row, pattern.columns[block] as usize].map(|row| corner[row] as usize);
                let (exact, size) = (&expected[a][b], expected[a][a][0][0]);
                for k in 0..9 {
                    let error = coarse[9 * block + k] / scale - exact[k / 3][k % 3];
                    assert!(error.abs() <= 2e-4 * size, "{fine_cells} cells: {error} of {size}");
                }
            }
        }
    }
}

fn products<'a>(a: &'a [f64], b: &'a [f64]) -> impl Iterator<Item = (usize, usize, f64)> + 'a {
    let nonzero = |values: &'a [f64]| values.iter().copied().enumerate().filter(|&(_, value)| value != 0.0);
    nonzero(a).flat_map(move |(i, a)| nonzero(b).map(move |(j, b)| (i, j, a * b)))
}

/// Functions that are negative at a node would make entries negative here.
#[test]
fn a_single_node_and_a_flat_body_have_cells() {
    let node: &[[f64; 3]] = &[[3.0, 1.0, 2.0]];
    let triangle: &[[f64; 3]] = &[[0.0, 0.0, 2.0], [1.0, 0.0, 2.0], [0.0, 1.0, 2.0]];
    for (rest, elements) in [(node, vec![]), (triangle, vec![[0, 1, 2]])] {
        let pattern = Arc::new(Pattern::new(rest.len(), &elements, Stored::Lower));
        let entry = |row: usize, column: usize| if row == column { 2.0 } else { 1.0 };
        let block = |a: f64| [[a, 0.0, 0.0], [0.0, a, 0.0], [0.0, 0.0, a]];
        let values: Vec<_> = (0..rest.len())
            .flat_map(|row| pattern.row(row).map(move |block| (row, block)))
            .map(|(row, at)| block(entry(row, pattern.columns[at] as usize)))
            .collect();
        let mut solver = Solver::<f64>::new(SSOR, &pattern, rest);
        solver.prepare(&values).unwrap();
        let history = history(&solver);
        let coarse = history.get("coarse.values").unwrap();
        assert_eq!(coarse.len(), 9 * 36, "the lower half of the eight corners of a cell");
        assert!(coarse.iter().all(|entry| *entry >= 0.0), "{coarse:?}");
        assert!(scale(&solver) == 0.5, "the coarse matrix has a factor");
        let b = random::<f64>(rest.len(), 3);
        solver.solve(&values, &b, &mut vec![[0.0; 3]; b.len()], 1e-6).unwrap();
    }
}

#[test]
fn the_coarse_grid_keeps_iterations_nearly_independent_of_the_mesh_size() {
    let [coarser, finer] = [6, 12].map(|cells| {
        // Inertia is small against stiffness, so that it does not keep the iterations few.
        let small_inertia = |beam: &Beam| beam.scaled(|_| 1.0, 1e3);
        let (mut solver, beam) = prepared(cells, small_inertia);
        let values = small_inertia(&beam);
        let with = iterations(&mut solver, &beam, &values);
        let mut history = history(&solver);
        history.put("coarse.weight", [0.0]);
        solver.restore(false, &history).unwrap();
        (with, iterations(&mut solver, &beam, &values))
    });
    assert!(2 * finer.0 <= 3 * coarser.0, "{coarser:?} {finer:?}");
    assert!(finer.1 > 2 * finer.0, "{finer:?}");
}

#[test]
fn the_coarse_matrix_is_factorised_again_when_solves_take_many_more_iterations() {
    let (mut solver, beam) = prepared(8, Beam::values);
    let (similar, stiff) = (beam.scaled::<f64>(|_| 1.1, 1e4), beam.scaled::<f64>(|_| 1.0, 0.0));
    let before = scale(&solver);
    solver.prepare(&similar).unwrap();
    iterations(&mut solver, &beam, &similar);
    solver.prepare(&similar).unwrap();
    assert_eq!(scale(&solver), before);
    for _ in 0..3 {
        solver.prepare(&stiff).unwrap();
        iterations(&mut solver, &beam, &stiff);
    }
    assert_ne!(scale(&solver), before);
}

#[test]
fn the_coarse_matrix_is_factorised_again_after_a_failed_solve() {
    let (mut solver, beam) = prepared(3, Beam::values);
    let before = scale(&solver);
    // Blocks on the diagonal are positive definite, so that only the iteration finds out.
    let indefinite = beam.scaled::<f64>(|_| 1.0, -100.0);
    solver.prepare(&indefinite).unwrap();
    let b = random::<f64>(beam.pattern.rows(), 5);
    let outcome = solver.solve(&indefinite, &b, &mut vec![[0.0; 3]; b.len()], 1e-3);
    assert_eq!((outcome, scale(&solver)), (Err(Breakdown::NotPositiveDefinite), before));
    solver.prepare(&beam.scaled::<f64>(|_| 1.1, 1e4)).unwrap();
    assert_ne!(scale(&solver), before);
}

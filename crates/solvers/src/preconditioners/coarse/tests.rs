//! The coarse matrix, its effect on the number of iterations, and its next factorisation.

use super::super::Ssor;
use crate::ApproximateInverse;
use crate::beam::{Beam, random};
use fem_elements::sparse::Stored;

/// A prepared preconditioner, and its beam.
fn prepared(cells: usize, values: impl Fn(&Beam) -> Vec<[[f64; 3]; 3]>) -> (Ssor, Beam) {
    let beam = Beam::new(cells, Stored::Lower);
    let mut ssor = Ssor::new(&beam.pattern, &beam.rest);
    ssor.prepare(&values(&beam)).unwrap();
    (ssor, beam)
}

#[test]
fn the_coarse_matrix_is_the_galerkin_product_of_the_fine_one() {
    let (ssor, beam) = prepared(3, Beam::values);
    let (coarse, values) = (&ssor.coarse, beam.values::<f64>());
    let corners = coarse.residual.len();
    // P is the same for the three directions.
    let mut P = vec![vec![0.0; corners]; beam.pattern.rows()];
    for (row, point) in P.iter_mut().zip(&coarse.grid.nodes) {
        let cell = coarse.grid.cells[point.cell as usize];
        cell.iter().zip(point.weights()).for_each(|(&corner, weight)| row[corner as usize] += f64::from(weight));
    }
    let mut expected = vec![vec![[[0.0; 3]; 3]; corners]; corners];
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
    let scale = ssor.matrix.scale;
    for row in 0..corners {
        for block in coarse.pattern.row(row) {
            let (exact, size) = (&expected[row][coarse.pattern.columns[block] as usize], expected[row][row][0][0]);
            for k in 0..9 {
                let error = f64::from(coarse.values[block][k / 3][k % 3]) / scale - exact[k / 3][k % 3];
                assert!(error.abs() <= 2e-4 * size, "{error} of {size}");
            }
        }
    }
}

fn products<'a>(a: &'a [f64], b: &'a [f64]) -> impl Iterator<Item = (usize, usize, f64)> + 'a {
    let both = move |i: usize| b.iter().enumerate().map(move |(j, b)| (i, j, a[i] * b));
    (0..a.len()).flat_map(both).filter(|product| product.2 != 0.0)
}

fn iterations(ssor: &mut Ssor, beam: &Beam) -> usize {
    let b = random::<f64>(beam.pattern.rows(), 5);
    ssor.correct(&b, &mut vec![[0.0; 3]; b.len()], 1e-3).unwrap()
}

#[test]
fn the_coarse_grid_keeps_iterations_nearly_independent_of_the_mesh_size() {
    let [coarser, finer] = [6, 12].map(|cells| {
        // Inertia is small against stiffness, so that it does not keep the iterations few.
        let (mut ssor, beam) = prepared(cells, |beam| beam.scaled(|_| 1.0, 1e3));
        let with = iterations(&mut ssor, &beam);
        ssor.coarse.weight = 0.0;
        (with, iterations(&mut ssor, &beam))
    });
    assert!(2 * finer.0 <= 3 * coarser.0, "{coarser:?} {finer:?}");
    assert!(finer.1 > 2 * finer.0, "{finer:?}");
}

#[test]
fn the_coarse_matrix_is_factorised_again_when_solves_take_many_more_iterations() {
    let (mut ssor, beam) = prepared(8, Beam::values);
    let stiff = beam.scaled::<f64>(|_| 1.0, 0.0);
    let before = ssor.coarse.scale;
    ssor.prepare(&beam.scaled::<f64>(|_| 1.1, 1e4)).unwrap();
    iterations(&mut ssor, &beam);
    ssor.prepare(&beam.scaled::<f64>(|_| 1.1, 1e4)).unwrap();
    assert_eq!(ssor.coarse.scale, before);
    for _ in 0..3 {
        ssor.prepare(&stiff).unwrap();
        iterations(&mut ssor, &beam);
    }
    assert_ne!(ssor.coarse.scale, before);
}

#[test]
fn the_coarse_matrix_is_factorised_again_after_a_failed_solve() {
    let (mut ssor, beam) = prepared(3, Beam::values);
    let before = ssor.coarse.scale;
    let b = random::<f64>(beam.pattern.rows(), 5);
    // More digits than single precision has.
    assert!(ssor.correct(&b, &mut vec![[0.0; 3]; b.len()], 1e-30).is_err());
    ssor.prepare(&beam.scaled::<f64>(|_| 1.1, 1e4)).unwrap();
    assert_ne!(ssor.coarse.scale, before);
}

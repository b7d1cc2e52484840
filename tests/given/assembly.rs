//! Given functions, `given::{sparsity, add_block, add_scaled, select}`: no exercise; read
//! include-docs/given.md.

use finite_elements_3d::{fixed_point_constraints, given};
use nalgebra::{DMatrix, Matrix3};
use proptest::prelude::*;

use crate::for_all;
use grader::properties::bodies::sparse;
use grader::properties::meshes::Mesh;
use grader::properties::outcome::{Outcome, holds, near};

#[test]
fn sparsity_has_a_block_for_every_pair_of_vertices_that_share_an_element() -> Outcome {
    let mesh = Mesh::uneven_box([2, 1, 1], 1.0);
    let matrix = given::sparsity(3 * mesh.V.len(), &mesh.T);
    let mut room = DMatrix::<f64>::zeros(matrix.nrows(), matrix.ncols());
    matrix.triplet_iter().for_each(|(row, column, value)| room[(row, column)] += 1.0 + value);
    let expected = DMatrix::from_fn(matrix.nrows(), matrix.ncols(), |row, column| {
        let share = |element: &[usize; 4]| element.contains(&(row / 3)) && element.contains(&(column / 3));
        if mesh.T.iter().any(share) { 1.0 } else { 0.0 }
    });
    near("one entry, zero, for each pair", &room, &expected, 0.0)?;
    holds("no element, no entry", given::sparsity(9, &[]).nnz() == 0 && given::sparsity(9, &[]).nrows() == 9)
}

#[test]
fn add_block_adds_to_the_block_of_its_vertices() -> Outcome {
    let mut matrix = given::sparsity(15, &[[3, 0, 4, 1]]);
    let block = Matrix3::from_fn(|i, j| 1.0 + 3.0 * i as f64 + j as f64);
    let mut expected = DMatrix::zeros(15, 15);
    for (row, column) in [(3, 0), (0, 3), (4, 4), (3, 0)] {
        given::add_block(&mut matrix, row, column, &block);
        let mut place = expected.fixed_view_mut::<3, 3>(3 * row, 3 * column);
        place += block;
    }
    near("blocks, one of them twice", &DMatrix::from(&matrix), &expected, 0.0)
}

#[test]
#[should_panic(expected = "vertices 0 and 2 share no element")]
fn adding_a_block_outside_the_pattern_panics() {
    given::add_block(&mut given::sparsity(15, &[[3, 0, 4, 1]]), 0, 2, &Matrix3::identity());
}

/// A matrix with zeros in random places.
fn matrix(n: usize) -> impl Strategy<Value = DMatrix<f64>> {
    let entry = prop_oneof![Just(0.0), -1.0..1.0];
    prop::collection::vec(entry, n * n).prop_map(move |entries| DMatrix::from_vec(n, n, entries))
}

#[test]
fn add_scaled_works_for_equal_and_for_different_patterns() -> Outcome {
    for_all((matrix(7), matrix(7), -3.0..3.0), |(A, B, factor)| {
        let sum = given::add_scaled(&sparse(&A), factor, &sparse(&B));
        near("A + factor B", &DMatrix::from(&sum), &(&A + &B * factor), 1e-15)?;
        let same_places = given::add_scaled(&sparse(&A), factor, &sparse(&A));
        near("A + factor A", &DMatrix::from(&same_places), &(&A * (1.0 + factor)), 1e-14)
    })
}

#[test]
fn select_is_the_product_p_k_p_transposed() -> Outcome {
    for_all((matrix(12), prop::collection::vec(0..4usize, 0..4)), |(K, fixed)| {
        let P = fixed_point_constraints(12, &fixed);
        let dense_P = DMatrix::from(&P);
        let selected = given::select(&P, &sparse(&K));
        near("P K Pᵀ", &DMatrix::from(&selected), &(&dense_P * K * dense_P.transpose()), 0.0)
    })
}

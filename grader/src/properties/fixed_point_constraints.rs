//! To do: the matrix that leaves out the coordinates of fixed vertices. Read include-docs/fixed_point_constraints.md.

use nalgebra::{DMatrix, DVector};
use proptest::prelude::*;

use super::outcome::{Mistake, Outcome, dense_of, near};
use super::random::for_all;
use super::{Check, Course};

/// The properties of the function.
pub const CHECKS: &[Check] = checks![
    fixing_the_middle_of_three_vertices_agrees_with_a_matrix_by_hand,
    p_q_is_q_without_the_fixed_vertices_in_the_old_order,
    no_fixed_vertices_give_the_identity,
    repeats_count_once_and_order_does_not_matter,
    all_vertices_fixed_give_a_matrix_without_rows,
];

fn P(course: &Course, q_size: usize, indices: &[usize]) -> Result<DMatrix<f64>, Mistake> {
    let fixed = (0..q_size / 3).filter(|vertex| indices.contains(vertex)).count();
    dense_of((q_size - 3 * fixed, q_size), &course.subject.fixed_point_constraints(q_size, indices)?)
}

/// The coordinates of q that stay, by plain selection.
fn kept(q: &DVector<f64>, indices: &[usize]) -> DVector<f64> {
    let free = (0..q.len() / 3).filter(|vertex| !indices.contains(vertex));
    DVector::from_vec(free.flat_map(|vertex| [q[3 * vertex], q[3 * vertex + 1], q[3 * vertex + 2]]).collect())
}

fn fixing_the_middle_of_three_vertices_agrees_with_a_matrix_by_hand(course: &Course) -> Outcome {
    let expected = DMatrix::from_fn(6, 9, |row, column| if [0, 1, 2, 6, 7, 8][row] == column { 1.0 } else { 0.0 });
    near("P, (q_size − 3m) × q_size", &P(course, 9, &[1])?, &expected, 0.0)
}

fn p_q_is_q_without_the_fixed_vertices_in_the_old_order(course: &Course) -> Outcome {
    let orders = Just((0..9).collect::<Vec<usize>>()).prop_shuffle();
    for_all(course.seed, (2..10usize, orders, 1..9usize), |(vertices, mut indices, fixed)| {
        // Some of the vertices, in any order, and not all of them.
        indices.retain(|&vertex| vertex < vertices);
        indices.truncate(fixed.min(vertices - 1));
        let q = DVector::from_fn(3 * vertices, |row, _| 1.5 + row as f64);
        let (P, expected) = (P(course, q.len(), &indices)?, kept(&q, &indices));
        near("P q (indices may be unsorted)", &(&P * &q), &expected, 0.0)?;
        let identity = DMatrix::<f64>::identity(expected.len(), expected.len());
        near("P Pᵀ = 1", &(&P * P.transpose()), &identity, 0.0)?;
        let padded = P.transpose() * expected;
        let fixed_to_zero = DVector::from_fn(q.len(), |row, _| if indices.contains(&(row / 3)) { 0.0 } else { q[row] });
        near("Pᵀ puts zeros where vertices are fixed", &padded, &fixed_to_zero, 0.0)
    })
}

fn no_fixed_vertices_give_the_identity(course: &Course) -> Outcome {
    near("P for no index", &P(course, 12, &[])?, &DMatrix::<f64>::identity(12, 12), 0.0)
}

fn repeats_count_once_and_order_does_not_matter(course: &Course) -> Outcome {
    near(
        "repeats count once, and the order of the indices does not matter",
        &P(course, 15, &[3, 0, 3, 3, 0])?,
        &P(course, 15, &[0, 3])?,
        0.0,
    )
}

fn all_vertices_fixed_give_a_matrix_without_rows(course: &Course) -> Outcome {
    near("P, all vertices fixed", &P(course, 9, &[2, 0, 1])?, &DMatrix::<f64>::zeros(0, 9), 0.0)?;
    near("P of an empty mesh", &P(course, 0, &[])?, &DMatrix::<f64>::zeros(0, 0), 0.0)
}

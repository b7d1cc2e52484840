//! Mistakes in `fixed_point_constraints`.

use finite_elements_3d as solved;
use nalgebra_sparse::{CooMatrix, CsrMatrix};

use super::Variant;

/// The mistakes that are known.
pub const VARIANTS: &[Variant] = &[
    variant!(
        fixed_point_constraints,
        "indices for coordinates",
        "The list holds vertices, and each vertex stands for more than one coordinate.",
        |q_size, indices| selecting(q_size, (0..q_size).filter(|coordinate| !indices.contains(coordinate)).collect())
    ),
    variant!(
        fixed_point_constraints,
        "duplicates counted twice",
        "There are too few rows when a vertex is named twice: it can be fixed only once.",
        |q_size, indices| {
            let rows = q_size.saturating_sub(3 * indices.len());
            selecting(q_size, kept(q_size, indices).take(rows).collect())
        }
    ),
    variant!(
        fixed_point_constraints,
        "trusts the order",
        "The list need not be sorted: what happens to a vertex that is named after a larger one?",
        |q_size, indices| {
            let mut next = indices.iter().peekable();
            let mut rows = Vec::new();
            for vertex in 0..q_size / 3 {
                if next.next_if_eq(&&vertex).is_some() {
                    while next.next_if_eq(&&vertex).is_some() {}
                } else {
                    rows.extend([3 * vertex, 3 * vertex + 1, 3 * vertex + 2]);
                }
            }
            selecting(q_size, rows)
        }
    ),
    variant!(
        fixed_point_constraints,
        "transposed",
        "Rows and columns are exchanged: applied to all coordinates, the matrix leaves the free ones.",
        |q_size, indices| solved::fixed_point_constraints(q_size, indices).transpose()
    ),
    variant!(
        fixed_point_constraints,
        "fixed instead of free",
        "The matrix picks the vertices that are fixed. Which coordinates does the solver still have to find?",
        |q_size, indices| {
            let free: Vec<usize> = (0..q_size / 3).filter(|vertex| !indices.contains(vertex)).collect();
            solved::fixed_point_constraints(q_size, &free)
        }
    ),
    variant!(
        fixed_point_constraints,
        "rows of zeros kept",
        "A fixed coordinate has no row at all, not an empty one: the matrix is not square.",
        |q_size, indices| {
            let mut entries = CooMatrix::new(q_size, q_size);
            kept(q_size, indices).for_each(|coordinate| entries.push(coordinate, coordinate, 1.0));
            CsrMatrix::from(&entries)
        }
    ),
    variant!(
        fixed_point_constraints,
        "columns removed too",
        "Its columns are all coordinates, also the fixed ones: that is what it is applied to.",
        |q_size, indices| CsrMatrix::identity(kept(q_size, indices).count())
    ),
    variant!(
        fixed_point_constraints,
        "grouped by coordinate",
        "The right coordinates are kept, but not in their order.",
        |q_size, indices| {
            let mut rows: Vec<usize> = kept(q_size, indices).collect();
            rows.sort_by_key(|coordinate| coordinate % 3);
            selecting(q_size, rows)
        }
    ),
];

fn kept(q_size: usize, indices: &[usize]) -> impl Iterator<Item = usize> {
    (0..q_size).filter(move |coordinate| !indices.contains(&(coordinate / 3)))
}

/// One row for each of these coordinates.
fn selecting(q_size: usize, coordinates: Vec<usize>) -> CsrMatrix<f64> {
    let mut entries = CooMatrix::new(coordinates.len(), q_size);
    coordinates.iter().enumerate().for_each(|(row, &column)| entries.push(row, column, 1.0));
    CsrMatrix::from(&entries)
}

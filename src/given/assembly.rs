//! Sparse matrices whose entries come in 3×3 blocks, one for each pair of vertices that share an element.

use nalgebra::Matrix3;
use nalgebra_sparse::CsrMatrix;

/// A `q_size × q_size` matrix of zeros with the pattern of the elements `T`: a 3×3 block for each pair of vertices of the
/// same element.
pub fn sparsity(q_size: usize, T: &[[usize; 4]]) -> CsrMatrix<f64> {
    let (starts, neighbours) = neighbours(q_size / 3, T);
    let mut offsets = Vec::with_capacity(q_size + 1);
    let mut columns = Vec::with_capacity(9 * neighbours.len());
    offsets.push(0);
    for vertex in 0..q_size / 3 {
        for _ in 0..3 {
            for &neighbour in &neighbours[starts[vertex]..starts[vertex + 1]] {
                columns.extend([3 * neighbour, 3 * neighbour + 1, 3 * neighbour + 2]);
            }
            offsets.push(columns.len());
        }
    }
    let zeros = vec![0.0; columns.len()];
    CsrMatrix::try_from_csr_data(q_size, q_size, offsets, columns, zeros)
        .expect("neighbours are sorted and belong to the mesh")
}

/// The vertices that share an element with vertex i, and i itself, ascending: `neighbours[starts[i]..starts[i + 1]]`.
fn neighbours(vertices: usize, T: &[[usize; 4]]) -> (Vec<usize>, Vec<usize>) {
    let mut elements_of = vec![Vec::with_capacity(32); vertices];
    for (index, element) in T.iter().enumerate() {
        for &vertex in element {
            assert!(vertex < vertices, "an element has vertex {vertex}, but there are only {vertices}");
            elements_of[vertex].push(index);
        }
    }
    let (mut starts, mut neighbours) = (vec![0], Vec::with_capacity(16 * vertices));
    // `entered[other]` is the last vertex whose list `other` has entered.
    let mut entered = vec![usize::MAX; vertices];
    for (vertex, elements) in elements_of.iter().enumerate() {
        let start = neighbours.len();
        for &other in elements.iter().flat_map(|&index| &T[index]) {
            if entered[other] != vertex {
                entered[other] = vertex;
                neighbours.push(other);
            }
        }
        neighbours[start..].sort_unstable();
        starts.push(neighbours.len());
    }
    (starts, neighbours)
}

/// Adds a 3×3 block to the rows of vertex `row` and the columns of vertex `column`.
///
/// Panics if the pattern has no such block.
#[inline]
pub fn add_block(matrix: &mut CsrMatrix<f64>, row: usize, column: usize, block: &Matrix3<f64>) {
    let (offsets, columns, values) = matrix.csr_data_mut();
    let first_row = &columns[offsets[3 * row]..offsets[3 * row + 1]];
    let Ok(place) = first_row.binary_search(&(3 * column)) else {
        panic!("vertices {row} and {column} share no element");
    };
    // The three rows of a vertex have the same columns, and the three columns of a vertex are neighbours.
    for i in 0..3 {
        let start = offsets[3 * row + i] + place;
        let [x, y, z] = &mut values[start..start + 3] else { unreachable!("a slice of three") };
        *x += block[(i, 0)];
        *y += block[(i, 1)];
        *z += block[(i, 2)];
    }
}

/// `A + factor · B`; fast where both have the same entries, correct where they do not.
pub fn add_scaled(A: &CsrMatrix<f64>, factor: f64, B: &CsrMatrix<f64>) -> CsrMatrix<f64> {
    if A.pattern() != B.pattern() {
        return A + B * factor;
    }
    let values = A.values().iter().zip(B.values()).map(|(a, b)| a + factor * b).collect();
    CsrMatrix::try_from_pattern_and_values(A.pattern().clone(), values).expect("as many values as before")
}

/// `P K Pᵀ` for a matrix P that selects coordinates, as `fixed_point_constraints` makes it.
pub fn select(P: &CsrMatrix<f64>, K: &CsrMatrix<f64>) -> CsrMatrix<f64> {
    let mut new_index = vec![None; K.ncols()];
    for (row, &column) in P.col_indices().iter().enumerate() {
        new_index[column] = Some(row);
    }
    let mut offsets = Vec::with_capacity(P.nrows() + 1);
    let (mut columns, mut values) = (Vec::with_capacity(K.nnz()), Vec::with_capacity(K.nnz()));
    offsets.push(0);
    for &kept in P.col_indices() {
        let row = K.row(kept);
        for (&column, &value) in row.col_indices().iter().zip(row.values()) {
            if let Some(column) = new_index[column] {
                columns.push(column);
                values.push(value);
            }
        }
        offsets.push(columns.len());
    }
    CsrMatrix::try_from_csr_data(P.nrows(), P.nrows(), offsets, columns, values)
        .expect("rows of K stay sorted when columns are left out")
}

//! Mistakes in `mass_matrix_mesh`.

use finite_elements_3d as solved;
use nalgebra::DVector;
use nalgebra_sparse::{CooMatrix, CsrMatrix};

use super::{Variant, scatter};

/// The mistakes that are known.
pub const VARIANTS: &[Variant] = &[
    variant!(
        mass_matrix_mesh,
        "overwritten instead of added",
        "A single element is right, elements that share a vertex are not: what happens to the entries that are there already?",
        |q_size, T, density, v0| {
            scatter::overwriting(q_size, T, |e| solved::mass_matrix_linear_tetrahedron(density, v0[e]))
        }
    ),
    variant!(
        mass_matrix_mesh,
        "local for global indices",
        "All elements are added to the first twelve rows: which vertices of the mesh does an element have?",
        |q_size, T, density, v0| {
            let piled = vec![[0, 1, 2, 3]; T.len()];
            solved::mass_matrix_mesh(q_size, &piled, density, v0)
        }
    ),
    variant!(
        mass_matrix_mesh,
        "size of the largest index",
        "The matrix has as many rows as there are coordinates, also where a vertex belongs to no element.",
        |_, T, density, v0| {
            let vertices = T.iter().flatten().max().map_or(0, |largest| largest + 1);
            solved::mass_matrix_mesh(3 * vertices, T, density, v0)
        }
    ),
    variant!(
        mass_matrix_mesh,
        "first volume for all",
        "Elements have different volumes: which one is used for the second element?",
        |q_size, T, density, v0| solved::mass_matrix_mesh(q_size, T, density, &scatter::first_for_all(v0))
    ),
    variant!(
        mass_matrix_mesh,
        "missing density",
        "The mass does not depend on the density. Look at its unit.",
        |q_size, T, _, v0| solved::mass_matrix_mesh(q_size, T, 1.0, v0)
    ),
    variant!(
        mass_matrix_mesh,
        "lumped",
        "The total mass is right, but neighbours are not coupled: off the diagonal something is missing.",
        |q_size, T, density, v0| {
            let M = solved::mass_matrix_mesh(q_size, T, density, v0);
            let sums = &M * DVector::from_element(q_size, 1.0);
            let mut diagonal = CooMatrix::new(q_size, q_size);
            (0..q_size).for_each(|row| diagonal.push(row, row, sums[row]));
            CsrMatrix::from(&diagonal)
        }
    ),
    variant!(
        mass_matrix_mesh,
        "grouped by coordinate",
        "The entries are right, but sorted by coordinate; each vertex keeps its three rows and columns together.",
        |q_size, T, density, v0| {
            let M = solved::mass_matrix_mesh(q_size, T, density, v0);
            let place = |entry: usize| entry % 3 * (q_size / 3) + entry / 3;
            let mut sorted = CooMatrix::new(q_size, q_size);
            M.triplet_iter().for_each(|(row, column, &value)| sorted.push(place(row), place(column), value));
            CsrMatrix::from(&sorted)
        }
    ),
];

//! Mistakes in `assemble_forces`.

use finite_elements_3d as solved;
use nalgebra::DVector;

use super::{Variant, scatter};

/// The mistakes that are known.
pub const VARIANTS: &[Variant] = &[
    variant!(
        assemble_forces,
        "negated",
        "The sign is reversed: a stretched body must pull itself together.",
        |q, V, T, v0, C, D| -solved::assemble_forces(q, V, T, v0, C, D)
    ),
    variant!(
        assemble_forces,
        "overwritten instead of added",
        "A single element is right, elements that share a vertex are not: what happens to the entries that are there already?",
        |q, V, T, v0, C, D| {
            let mut f = DVector::zeros(q.len());
            for (element, &volume) in T.iter().zip(v0) {
                let gradient = solved::dV_linear_tetrahedron_dq(q, V, element, volume, C, D);
                for row in 0..12 {
                    f[3 * element[row / 3] + row % 3] = -gradient[row];
                }
            }
            f
        }
    ),
    variant!(
        assemble_forces,
        "first volume for all",
        "Elements have different volumes: `v0` runs along `T`.",
        |q, V, T, v0, C, D| solved::assemble_forces(q, V, T, &scatter::first_for_all(v0), C, D)
    ),
    variant!(
        assemble_forces,
        "local for global indices",
        "All elements pile up on the first four vertices: to which vertices of the mesh do the twelve numbers belong?",
        |q, V, T, v0, C, D| {
            let mut f = DVector::zeros(q.len());
            for (element, &volume) in T.iter().zip(v0) {
                let gradient = solved::dV_linear_tetrahedron_dq(q, V, element, volume, C, D);
                f.rows_mut(0, 12).axpy(-1.0, &gradient, 1.0);
            }
            f
        }
    ),
    variant!(
        assemble_forces,
        "grouped by coordinate",
        "The forces are right, but sorted by coordinate; they must be stacked like `q`.",
        |q, V, T, v0, C, D| {
            let f = solved::assemble_forces(q, V, T, v0, C, D);
            let vertices = f.len() / 3;
            DVector::from_fn(f.len(), |row, _| f[3 * (row % vertices) + row / vertices])
        }
    ),
    variant!(
        assemble_forces,
        "one element too few",
        "An element at the end of the list pulls at nothing. Where does the loop end?",
        |q, V, T, v0, C, D| {
            let count = T.len().saturating_sub(1);
            solved::assemble_forces(q, V, &T[..count], &v0[..count], C, D)
        }
    ),
    variant!(
        assemble_forces,
        "missing volume",
        "Small elements pull as hard as large ones. Which volume goes to the element's gradient?",
        |q, V, T, v0, C, D| solved::assemble_forces(q, V, T, &vec![1.0; v0.len()], C, D)
    ),
];

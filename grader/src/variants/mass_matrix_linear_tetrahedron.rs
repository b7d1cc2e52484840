//! Mistakes in `mass_matrix_linear_tetrahedron`.

use finite_elements_3d as solved;
use nalgebra::SMatrix;

use super::Variant;

/// The mistakes that are known.
pub const VARIANTS: &[Variant] = &[
    variant!(
        mass_matrix_linear_tetrahedron,
        "lumped",
        "The total mass is right, but the mass is not concentrated at the vertices: shape functions overlap.",
        |density, volume| SMatrix::from_diagonal_element(density * volume / 4.0)
    ),
    variant!(
        mass_matrix_linear_tetrahedron,
        "one-point rule",
        "All blocks are alike and the matrix is singular. One point is too few for a product of two linear functions.",
        |density, volume| SMatrix::from_fn(|row, column| {
            if row % 3 == column % 3 { density * volume / 16.0 } else { 0.0 }
        })
    ),
    variant!(
        mass_matrix_linear_tetrahedron,
        "x pushes y",
        "A push along x must not move anything along y: look at the 3×3 blocks off their diagonal.",
        |density, volume| SMatrix::from_fn(|row, column| {
            density * volume / if row / 3 == column / 3 { 10.0 } else { 20.0 }
        })
    ),
    variant!(
        mass_matrix_linear_tetrahedron,
        "grouped by coordinate",
        "The entries are right, but sorted by coordinate; each vertex keeps its three rows and columns together.",
        |density, volume| {
            let M = solved::mass_matrix_linear_tetrahedron(density, volume);
            SMatrix::from_fn(|row, column| M[(3 * (row % 4) + row / 4, 3 * (column % 4) + column / 4)])
        }
    ),
    variant!(
        mass_matrix_linear_tetrahedron,
        "missing density",
        "The mass does not depend on the density. Look at its unit.",
        |_, volume| solved::mass_matrix_linear_tetrahedron(1.0, volume)
    ),
    variant!(
        mass_matrix_linear_tetrahedron,
        "missing volume",
        "The mass does not depend on the volume. Look at its unit.",
        |density, _| solved::mass_matrix_linear_tetrahedron(density, 1.0)
    ),
    variant!(
        mass_matrix_linear_tetrahedron,
        "scaled by 6",
        "The total mass is six times too large: integrals over the unit tetrahedron already hold its volume.",
        |density, volume| solved::mass_matrix_linear_tetrahedron(density, volume) * 6.0
    ),
];

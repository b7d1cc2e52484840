//! Mistakes in `dV_linear_tetrahedron_dq`.

use finite_elements_3d as solved;
use finite_elements_3d::given::deformation_gradient;
use nalgebra::{Matrix3, SVector};

use super::Variant;

/// The mistakes that are known.
pub const VARIANTS: &[Variant] = &[
    variant!(
        dV_linear_tetrahedron_dq,
        "negated",
        "The sign is reversed: the page asks for the gradient of the energy, not the force.",
        |q, V, element, volume, C, D| -solved::dV_linear_tetrahedron_dq(q, V, element, volume, C, D)
    ),
    variant!(
        dV_linear_tetrahedron_dq,
        "grouped by coordinate",
        "The twelve numbers are right, but sorted by coordinate; each vertex keeps its three together.",
        |q, V, element, volume, C, D| {
            let gradient = solved::dV_linear_tetrahedron_dq(q, V, element, volume, C, D);
            SVector::from_fn(|row, _| gradient[3 * (row % 4) + row / 4])
        }
    ),
    variant!(
        dV_linear_tetrahedron_dq,
        "transposed",
        "The four vectors add up to zero, but they turn the element: which index of F moves, and how is the stress flattened?",
        |q, V, element, volume, C, D| {
            let dphi = solved::dphi_linear_tetrahedron_dX(V, element, &V[element[0]]);
            let F = deformation_gradient(q, element, &dphi);
            let P = Matrix3::from_column_slice(solved::dpsi_neo_hookean_dF(&F, C, D).as_slice());
            SVector::from_column_slice((P * dphi.transpose() * volume).as_slice())
        }
    ),
    variant!(
        dV_linear_tetrahedron_dq,
        "missing volume",
        "The answer does not depend on the volume: an integral over the element is meant.",
        |q, V, element, _, C, D| solved::dV_linear_tetrahedron_dq(q, V, element, 1.0, C, D)
    ),
    variant!(
        dV_linear_tetrahedron_dq,
        "local for global indices",
        "The answer fits the first four vertices of the mesh; `element` says which four are meant.",
        |q, V, _, volume, C, D| solved::dV_linear_tetrahedron_dq(q, V, &[0, 1, 2, 3], volume, C, D)
    ),
    variant!(
        dV_linear_tetrahedron_dq,
        "missing term",
        "The four vectors must add up to zero, since moving the whole element costs nothing. One vertex has none.",
        |q, V, element, volume, C, D| {
            let mut gradient = solved::dV_linear_tetrahedron_dq(q, V, element, volume, C, D);
            gradient.fixed_rows_mut::<3>(0).fill(0.0);
            gradient
        }
    ),
    variant!(
        dV_linear_tetrahedron_dq,
        "wrong vertex order",
        "The four vectors are right, but in another order: entries 3i to 3i + 2 belong to vertex `element[i]`.",
        |q, V, element, volume, C, D| {
            let gradient = solved::dV_linear_tetrahedron_dq(q, V, element, volume, C, D);
            SVector::from_fn(|row, _| gradient[(row + 3) % 12])
        }
    ),
];

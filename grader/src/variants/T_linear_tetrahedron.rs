//! Mistakes in `T_linear_tetrahedron`.

use finite_elements_3d as solved;
use nalgebra::{DVector, Vector3};

use super::Variant;

/// The mistakes that are known.
pub const VARIANTS: &[Variant] = &[
    variant!(
        T_linear_tetrahedron,
        "local for global indices",
        "The energy fits the first four vertices of the mesh; `element` says whose velocities are meant.",
        |qdot, _, density, volume| solved::T_linear_tetrahedron(qdot, &[0, 1, 2, 3], density, volume)
    ),
    variant!(
        T_linear_tetrahedron,
        "lumped",
        "Right for a translating element, too large for a spinning one: the mass is not concentrated at the vertices.",
        |qdot, element, density, volume| {
            let squares: f64 = velocities(qdot, element).iter().map(Vector3::norm_squared).sum();
            0.5 * density * volume / 4.0 * squares
        }
    ),
    variant!(
        T_linear_tetrahedron,
        "only the centroid",
        "An element that spins about its centroid has kinetic energy. One velocity does not describe all points.",
        |qdot, element, density, volume| {
            let mean = velocities(qdot, element).iter().sum::<Vector3<f64>>() / 4.0;
            0.5 * density * volume * mean.norm_squared()
        }
    ),
    variant!(
        T_linear_tetrahedron,
        "scaled by 2",
        "The energy is twice too large: compare with a point of the same mass.",
        |qdot, element, density, volume| 2.0 * solved::T_linear_tetrahedron(qdot, element, density, volume)
    ),
    variant!(
        T_linear_tetrahedron,
        "scaled by 0.5",
        "The energy is half of what it should be: is a factor taken twice?",
        |qdot, element, density, volume| 0.5 * solved::T_linear_tetrahedron(qdot, element, density, volume)
    ),
    variant!(
        T_linear_tetrahedron,
        "missing density",
        "The energy does not depend on the density. Look at its unit.",
        |qdot, element, _, volume| solved::T_linear_tetrahedron(qdot, element, 1.0, volume)
    ),
    variant!(
        T_linear_tetrahedron,
        "missing volume",
        "The energy does not depend on the volume. Look at its unit.",
        |qdot, element, density, _| solved::T_linear_tetrahedron(qdot, element, density, 1.0)
    ),
];

fn velocities(qdot: &DVector<f64>, element: &[usize; 4]) -> [Vector3<f64>; 4] {
    element.map(|vertex| qdot.fixed_rows::<3>(3 * vertex).into_owned())
}

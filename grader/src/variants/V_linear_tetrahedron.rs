//! Mistakes in `V_linear_tetrahedron`.

use finite_elements_3d as solved;
use finite_elements_3d::given::deformation_gradient;
use nalgebra::{DVector, Matrix3, Vector3};

use super::Variant;

/// The mistakes that are known.
pub const VARIANTS: &[Variant] = &[
    variant!(
        V_linear_tetrahedron,
        "missing volume",
        "This is energy per volume, in J/m³. What is still missing for an energy?",
        |q, V, element, _, C, D| solved::V_linear_tetrahedron(q, V, element, 1.0, C, D)
    ),
    variant!(
        V_linear_tetrahedron,
        "displacements for positions",
        "`q` holds positions. For a body at rest the deformation gradient is the identity, not zero.",
        |q, V, element, volume, C, D| {
            let F = gradient(q, V, element) - Matrix3::identity();
            solved::psi_neo_hookean(&F, C, D) * volume
        }
    ),
    variant!(
        V_linear_tetrahedron,
        "deformed for rest",
        "There is never any energy here: the shape functions' gradients belong to the undeformed element.",
        |q, V, element, volume, C, D| {
            let moved: Vec<_> = (0..V.len()).map(|i| Vector3::new(q[3 * i], q[3 * i + 1], q[3 * i + 2])).collect();
            solved::V_linear_tetrahedron(q, &moved, element, volume, C, D)
        }
    ),
    variant!(
        V_linear_tetrahedron,
        "deformed volume",
        "The energy density counts per undeformed volume, so that is what one integrates over.",
        |q, V, element, volume, C, D| {
            let J = gradient(q, V, element).determinant();
            solved::V_linear_tetrahedron(q, V, element, volume, C, D) * J
        }
    ),
    variant!(
        V_linear_tetrahedron,
        "local for global indices",
        "The energy fits the first four vertices of the mesh; `element` says which four are meant.",
        |q, V, _, volume, C, D| solved::V_linear_tetrahedron(q, V, &[0, 1, 2, 3], volume, C, D)
    ),
    variant!(
        V_linear_tetrahedron,
        "C and D swapped",
        "Look at the order of the arguments that go to the energy density.",
        |q, V, element, volume, C, D| solved::V_linear_tetrahedron(q, V, element, volume, D, C)
    ),
    variant!(
        V_linear_tetrahedron,
        "zero for inverted",
        "An inverted element must not have zero energy: a line search would step right into that state.",
        |q, V, element, volume, C, D| {
            let energy = solved::V_linear_tetrahedron(q, V, element, volume, C, D);
            if energy.is_finite() { energy } else { 0.0 }
        }
    ),
];

fn gradient(q: &DVector<f64>, V: &[Vector3<f64>], element: &[usize; 4]) -> Matrix3<f64> {
    deformation_gradient(q, element, &solved::dphi_linear_tetrahedron_dX(V, element, &V[element[0]]))
}

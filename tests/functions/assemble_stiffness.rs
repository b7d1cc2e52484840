//! To do: the stiffness of the whole mesh, K = −Σ project(∂²V/∂q²). Read include-docs/assemble_stiffness.md.

use finite_elements_3d::{assemble_forces, assemble_stiffness, d2V_linear_tetrahedron_dq2, given};
use nalgebra::{DMatrix, DVector, Matrix3, SMatrix, Vector3};

use crate::finite_differences::jacobian;
use crate::meshes::{Mesh, Tetrahedron, stacked};
use crate::outcome::{Outcome, for_all, holds, near};
use crate::random::vector;

const C: f64 = 2e5;
const D: f64 = 7e5;

fn stiffness(mesh: &Mesh, q: &DVector<f64>) -> DMatrix<f64> {
    DMatrix::from(&assemble_stiffness(q, &mesh.V, &mesh.T, &mesh.v0, C, D))
}

/// A strongly squeezed state, in which elements have negative curvature.
fn squeezed(mesh: &Mesh) -> DVector<f64> {
    mesh.placed(|X| Matrix3::new(0.5, 0.3, 0.0, 0.0, 0.6, -0.2, 0.1, 0.0, 0.7) * X + Vector3::x() * X.y * X.z * 0.1)
}

#[test]
fn every_element_subtracts_its_projected_hessian() -> Outcome {
    let mesh = Mesh::uneven_box([2, 1, 1], 1.0);
    for q in [mesh.placed(|X| *X), squeezed(&mesh)] {
        let mut expected = DMatrix::zeros(q.len(), q.len());
        for (element, &volume) in mesh.T.iter().zip(&mesh.v0) {
            let H = given::project(&d2V_linear_tetrahedron_dq2(&q, &mesh.V, element, volume, C, D));
            for (row, column) in (0..12).flat_map(|row| (0..12).map(move |column| (row, column))) {
                let (i, j) = (3 * element[row / 3] + row % 3, 3 * element[column / 3] + column % 3);
                expected[(i, j)] -= H[(row, column)];
            }
        }
        let allowed = 1e-12 * expected.amax();
        near("K = −Σ project(d2V), each element on its own", &stiffness(&mesh, &q), &expected, allowed)?;
    }
    Ok(())
}

#[test]
fn near_rest_it_is_the_derivative_of_the_forces() -> Outcome {
    // At rest nothing is projected. Sizes and volumes differ from element to element.
    let mesh = Mesh::uneven_box([1, 2, 1], 1.0);
    let q = mesh.placed(|X| *X);
    let force = |q: &DVector<f64>| assemble_forces(q, &mesh.V, &mesh.T, &mesh.v0, C, D);
    let expected = jacobian(force, &q, 0.01);
    near("differences of assemble_forces (K = ∂f/∂q)", &stiffness(&mesh, &q), &expected, 1e-8 * expected.amax())
}

#[test]
fn no_motion_is_pushed_on() -> Outcome {
    let mesh = Mesh::uneven_box([1, 1, 1], 1.0);
    for_all(proptest::collection::vec(vector(-0.1..0.1), mesh.V.len()), |noise| {
        let q = squeezed(&mesh) + stacked(&noise) * 0.5;
        let K = stiffness(&mesh, &q);
        near("K is symmetric", &K, &K.transpose(), 1e-12 * K.amax())?;
        let eigenvalues = K.symmetric_eigenvalues();
        holds("K is negative semi-definite", eigenvalues.max() <= 1e-11 * -eigenvalues.min())?;
        let translation = &K * mesh.placed(|_| Vector3::new(1.0, 2.0, 3.0));
        let zero = DVector::<f64>::zeros(translation.len());
        near("translations meet no resistance, also after projecting", &translation, &zero, 1e-10 * K.amax())
    })
}

#[test]
fn at_rest_exactly_the_six_rigid_motions_are_free() -> Outcome {
    let mesh = Mesh::uneven_box([2, 1, 1], 1.0);
    let K = stiffness(&mesh, &mesh.placed(|X| *X));
    for axis in [Vector3::x(), Vector3::y(), Vector3::z()] {
        let torque = &K * mesh.placed(|X| axis.cross(X));
        near("K times a rotation, at rest", &torque, &DVector::<f64>::zeros(torque.len()), 1e-11 * K.amax())?;
    }
    let eigenvalues = K.symmetric_eigenvalues();
    let zeros = eigenvalues.iter().filter(|value| value.abs() < 1e-10 * K.amax()).count();
    holds("at rest exactly six eigenvalues are zero", zeros == 6)
}

#[test]
fn a_squeezed_element_is_projected_and_not_flipped() -> Outcome {
    // Where an element has negative curvature, K must differ from −d2V, and must keep what was positive.
    let t = Tetrahedron::unit();
    let q = t.moved(&(Matrix3::identity() * 0.5), &Vector3::zeros()).rows(0, 12).into_owned();
    let V = &t.V[..4];
    let H = d2V_linear_tetrahedron_dq2(&q, V, &t.element, t.volume, C, D);
    let K = DMatrix::from(&assemble_stiffness(&q, V, &[t.element], &[t.volume], C, D));
    let eigen = H.symmetric_eigen();
    holds("the squeezed element has negative curvature", eigen.eigenvalues.min() < -0.01 * eigen.eigenvalues.max())?;
    let kept = eigen.eigenvalues.map(|value| value.max(0.0));
    let expected =
        -(eigen.eigenvectors * SMatrix::<f64, 12, 12>::from_diagonal(&kept)) * eigen.eigenvectors.transpose();
    near("negative eigenvalues become zero, the others stay", &K, &expected, 1e-11 * K.amax())
}

#[test]
fn vertices_without_elements_have_no_stiffness_and_the_matrix_keeps_its_size() -> Outcome {
    let t = Tetrahedron::new([7, 1, 4, 2], &Matrix3::identity(), &Vector3::zeros());
    let mut q = t.moved(&(Matrix3::identity() * 1.5), &Vector3::zeros());
    q.iter_mut().filter(|entry| entry.is_nan()).for_each(|entry| *entry = 0.0);
    let K = DMatrix::from(&assemble_stiffness(&q, &t.V, &[t.element, t.element], &[1.0, 10.0], C, D));
    let eleven = given::project(&d2V_linear_tetrahedron_dq2(&q, &t.V, &t.element, 11.0, C, D));
    let mut expected = DMatrix::zeros(27, 27);
    for (row, column) in (0..12).flat_map(|row| (0..12).map(move |column| (row, column))) {
        let (i, j) = (3 * t.element[row / 3] + row % 3, 3 * t.element[column / 3] + column % 3);
        expected[(i, j)] = -eleven[(row, column)];
    }
    near("the same element twice, with volumes 1 and 10", &K, &expected, 1e-12 * K.amax())?;
    let none = DMatrix::from(&assemble_stiffness(&q, &t.V, &[], &[], C, D));
    near("no element at all", &none, &DMatrix::zeros(27, 27), 0.0)
}

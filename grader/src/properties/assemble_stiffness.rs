//! To do: the stiffness of the whole mesh, K = −Σ project(∂²V/∂q²). Read include-docs/assemble_stiffness.md.

use nalgebra::{DMatrix, DVector, Matrix3, Vector3};

use super::bodies::without_negative_eigenvalues;
use super::finite_differences::jacobian;
use super::meshes::{Mesh, Tetrahedron, stacked};
use super::outcome::{Mistake, Outcome, dense_of, eigenvalues_of, holds, near, slack, waits, with_input};
use super::random::{for_all, vector};
use super::{Check, Course};
use crate::implementation::Trouble;

/// The properties of the function.
pub const CHECKS: &[Check] = checks![
    every_element_subtracts_its_projected_hessian,
    near_rest_it_is_the_derivative_of_the_forces,
    it_is_negative_semi_definite,
    at_rest_only_the_six_rigid_motions_have_no_stiffness,
    a_squeezed_element_is_projected_and_not_flipped,
    vertices_without_elements_have_no_stiffness_and_the_matrix_keeps_its_size,
];

const C: f64 = 2e5;
const D: f64 = 7e5;

fn stiffness(course: &Course, mesh: &Mesh, q: &DVector<f64>) -> Result<DMatrix<f64>, Mistake> {
    let K = course.subject.assemble_stiffness(q, &mesh.V, &mesh.T, &mesh.v0, C, D)?;
    dense_of((q.len(), q.len()), &K)
}

/// An element's Hessian without negative curvature, subtracted where its vertices say.
fn subtract(
    K: &mut DMatrix<f64>,
    course: &Course,
    q: &DVector<f64>,
    V: &[Vector3<f64>],
    element: &[usize; 4],
    volume: f64,
) -> Outcome {
    let H = course.trusted.d2V_linear_tetrahedron_dq2(q, V, element, volume, C, D);
    let H = without_negative_eigenvalues(&H.map_err(waits("d2V_linear_tetrahedron_dq2"))?);
    for (row, column) in (0..12).flat_map(|row| (0..12).map(move |column| (row, column))) {
        let (i, j) = (3 * element[row / 3] + row % 3, 3 * element[column / 3] + column % 3);
        K[(i, j)] -= H[(row, column)];
    }
    Ok(())
}

/// A strongly squeezed state, in which elements have negative curvature.
fn squeezed(mesh: &Mesh) -> DVector<f64> {
    mesh.placed(|X| Matrix3::new(0.5, 0.3, 0.0, 0.0, 0.6, -0.2, 0.1, 0.0, 0.7) * X + Vector3::x() * X.y * X.z * 0.1)
}

fn every_element_subtracts_its_projected_hessian(course: &Course) -> Outcome {
    let mesh = Mesh::uneven_box([2, 1, 1], 1.0);
    for q in [mesh.placed(|X| *X), squeezed(&mesh)] {
        let mut expected = DMatrix::zeros(q.len(), q.len());
        for (element, &volume) in mesh.T.iter().zip(&mesh.v0) {
            subtract(&mut expected, course, &q, &mesh.V, element, volume)?;
        }
        let allowed = 1e-12 * expected.amax();
        near("K = −Σ project(d2V), each element on its own", &stiffness(course, &mesh, &q)?, &expected, allowed)?;
    }
    Ok(())
}

fn near_rest_it_is_the_derivative_of_the_forces(course: &Course) -> Outcome {
    // At rest nothing is projected. Sizes and volumes differ from element to element.
    let mesh = Mesh::uneven_box([1, 2, 1], 1.0);
    let q = mesh.placed(|X| *X);
    let force = |q: &DVector<f64>| {
        let needs = waits("assemble_forces");
        let f = course.trusted.assemble_forces(q, &mesh.V, &mesh.T, &mesh.v0, C, D).map_err(&needs)?;
        if f.len() == q.len() { Ok(f) } else { Err(needs(Trouble::Malformed)) }
    };
    let expected = jacobian(force, &q, 0.01)?;
    near(
        "differences of assemble_forces (K = ∂f/∂q)",
        &stiffness(course, &mesh, &q)?,
        &expected,
        1e-8 * expected.amax(),
    )
}

fn it_is_negative_semi_definite(course: &Course) -> Outcome {
    let mesh = Mesh::uneven_box([1, 1, 1], 1.0);
    for_all(course.seed, proptest::collection::vec(vector(-0.1..0.1), mesh.V.len()), |noise| {
        let q = squeezed(&mesh) + stacked(&noise) * 0.5;
        let K = stiffness(course, &mesh, &q)?;
        near("K is symmetric", &K, &K.transpose(), 1e-12 * K.amax())?;
        let eigenvalues = eigenvalues_of(&K)?;
        holds("K is negative semi-definite", eigenvalues.max() <= slack(1e-11) * -eigenvalues.min())?;
        let translation = &K * mesh.placed(|_| Vector3::new(1.0, 2.0, 3.0));
        let zero = DVector::<f64>::zeros(translation.len());
        near("translations meet no resistance, also after projecting", &translation, &zero, 1e-10 * K.amax())
    })
}

fn at_rest_only_the_six_rigid_motions_have_no_stiffness(course: &Course) -> Outcome {
    let mesh = Mesh::uneven_box([2, 1, 1], 1.0);
    let K = stiffness(course, &mesh, &mesh.placed(|X| *X))?;
    for axis in [Vector3::x(), Vector3::y(), Vector3::z()] {
        let torque = &K * mesh.placed(|X| axis.cross(X));
        near("K times a rotation, at rest", &torque, &DVector::<f64>::zeros(torque.len()), 1e-11 * K.amax())?;
    }
    let eigenvalues = eigenvalues_of(&K)?;
    let zeros = eigenvalues.iter().filter(|value| value.abs() < slack(1e-10) * K.amax()).count();
    holds("at rest exactly six eigenvalues are zero", zeros == 6)
}

fn a_squeezed_element_is_projected_and_not_flipped(course: &Course) -> Outcome {
    // Where an element has negative curvature, K must differ from −d2V, and must keep what was positive.
    let t = Tetrahedron::unit();
    let q = t.moved(&(Matrix3::identity() * 0.5), &Vector3::zeros()).rows(0, 12).into_owned();
    let V = &t.V[..4];
    let mut expected = DMatrix::zeros(12, 12);
    subtract(&mut expected, course, &q, V, &t.element, t.volume)?;
    let K = course.subject.assemble_stiffness(&q, V, &[t.element], &[t.volume], C, D)?;
    let K = dense_of((12, 12), &K)?;
    near("negative eigenvalues become zero, the others stay", &K, &expected, 1e-11 * K.amax())
}

fn vertices_without_elements_have_no_stiffness_and_the_matrix_keeps_its_size(course: &Course) -> Outcome {
    let t = Tetrahedron::new([7, 1, 4, 2], &Matrix3::identity(), &Vector3::zeros());
    let q = t.moved(&(Matrix3::identity() * 1.5), &Vector3::zeros());
    let K = course.subject.assemble_stiffness(&q, &t.V, &[t.element, t.element], &[1.0, 10.0], C, D)?;
    let K = dense_of((27, 27), &K)?;
    let mut expected = DMatrix::zeros(27, 27);
    subtract(&mut expected, course, &q, &t.V, &t.element, 11.0)?;
    let rule = "each element has its own volume, and a vertex without elements no stiffness";
    with_input("the same element twice, with volumes 1 and 10", near(rule, &K, &expected, 1e-12 * K.amax()))?;
    let none = dense_of((27, 27), &course.subject.assemble_stiffness(&q, &t.V, &[], &[], C, D)?)?;
    near("no element at all", &none, &DMatrix::zeros(27, 27), 0.0)
}

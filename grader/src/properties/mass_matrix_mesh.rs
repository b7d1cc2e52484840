//! To do: the mass matrix of the whole mesh. Read include-docs/mass_matrix_mesh.md.

use nalgebra::{DMatrix, Vector3};

use super::meshes::{Mesh, stacked};
use super::outcome::{Mistake, Outcome, dense_of, holds, near, near_number, waits};
use super::random::{for_some, vector};
use super::{Check, Course};

/// What must hold for the function.
pub const CHECKS: &[Check] = checks![
    elements_add_up_where_they_share_vertices,
    each_element_has_its_own_volume,
    half_v_m_v_is_the_kinetic_energy_of_the_elements,
    the_total_mass_is_density_times_volume,
    vertices_without_elements_have_no_mass_and_the_matrix_keeps_its_size,
    it_is_symmetric_and_positive_definite,
];

const DENSITY: f64 = 800.0;

fn dense(course: &Course, q_size: usize, T: &[[usize; 4]], v0: &[f64]) -> Result<DMatrix<f64>, Mistake> {
    dense_of((q_size, q_size), &course.subject.mass_matrix_mesh(q_size, T, DENSITY, v0)?)
}

/// Every entry of every element, added where its vertices say.
fn by_definition(course: &Course, q_size: usize, T: &[[usize; 4]], v0: &[f64]) -> Result<DMatrix<f64>, Mistake> {
    let needs = waits("mass_matrix_linear_tetrahedron");
    let mut M = DMatrix::zeros(q_size, q_size);
    for (element, &volume) in T.iter().zip(v0) {
        let of_element = course.trusted.mass_matrix_linear_tetrahedron(DENSITY, volume).map_err(&needs)?;
        for (row, column) in (0..12).flat_map(|row| (0..12).map(move |column| (row, column))) {
            let (i, j) = (3 * element[row / 3] + row % 3, 3 * element[column / 3] + column % 3);
            M[(i, j)] += of_element[(row, column)];
        }
    }
    Ok(M)
}

fn elements_add_up_where_they_share_vertices(course: &Course) -> Outcome {
    let mesh = Mesh::uneven_box([2, 1, 1], 0.3);
    let q_size = 3 * mesh.V.len();
    let expected = by_definition(course, q_size, &mesh.T, &mesh.v0)?;
    near("M, summed over the elements", &dense(course, q_size, &mesh.T, &mesh.v0)?, &expected, 1e-13 * expected.amax())
}

fn each_element_has_its_own_volume(course: &Course) -> Outcome {
    let T = [[0, 1, 2, 3], [3, 2, 1, 4]];
    let M = dense(course, 15, &T, &[1.0, 20.0])?;
    near_number(
        "a vertex of the first element alone has mass of that element",
        M[(0, 0)],
        DENSITY * 1.0 / 10.0,
        1e-10,
    )?;
    near_number(
        "a vertex of the second element alone has mass of that element",
        M[(14, 14)],
        DENSITY * 20.0 / 10.0,
        1e-10,
    )?;
    near_number("a vertex of both elements has mass of both", M[(10, 10)], DENSITY * 21.0 / 10.0, 1e-10)?;
    near_number("two vertices that share both elements are coupled by both", M[(5, 8)], DENSITY * 21.0 / 20.0, 1e-10)?;
    near_number("two vertices that share no element are not coupled", M[(0, 12)], 0.0, 0.0)
}

fn half_v_m_v_is_the_kinetic_energy_of_the_elements(course: &Course) -> Outcome {
    let mesh = Mesh::uneven_box([1, 2, 1], 2.0);
    let M = dense(course, 3 * mesh.V.len(), &mesh.T, &mesh.v0)?;
    for_some(course.seed, proptest::collection::vec(vector(-3.0..3.0), mesh.V.len()), |velocities| {
        let qdot = stacked(&velocities);
        let mut expected = 0.0;
        for (element, &volume) in mesh.T.iter().zip(&mesh.v0) {
            let T = course.trusted.T_linear_tetrahedron(&qdot, element, DENSITY, volume);
            expected += T.map_err(waits("T_linear_tetrahedron"))?;
        }
        near_number("½ q̇ᵀ M q̇ = Σ T", 0.5 * qdot.dot(&(&M * &qdot)), expected, 1e-12 * expected)
    })
}

fn the_total_mass_is_density_times_volume(course: &Course) -> Outcome {
    let mesh = Mesh::uneven_box([2, 2, 1], 0.1);
    let M = dense(course, 3 * mesh.V.len(), &mesh.T, &mesh.v0)?;
    let mass = DENSITY * mesh.v0.iter().sum::<f64>();
    for axis in [Vector3::x(), Vector3::y(), Vector3::z()] {
        let along = mesh.placed(|_| axis);
        near_number("mass felt by a translation", along.dot(&(&M * &along)), mass, 1e-12 * mass)?;
    }
    Ok(())
}

fn vertices_without_elements_have_no_mass_and_the_matrix_keeps_its_size(course: &Course) -> Outcome {
    let M = dense(course, 24, &[[6, 2, 5, 1]], &[2.0])?;
    near("vertices without elements have no mass", &M, &by_definition(course, 24, &[[6, 2, 5, 1]], &[2.0])?, 1e-10)?;
    near("no element at all", &dense(course, 6, &[], &[])?, &DMatrix::zeros(6, 6), 0.0)
}

fn it_is_symmetric_and_positive_definite(course: &Course) -> Outcome {
    let mesh = Mesh::uneven_box([1, 1, 2], 1.0);
    let M = dense(course, 3 * mesh.V.len(), &mesh.T, &mesh.v0)?;
    near("a mass matrix is symmetric", &M, &M.transpose(), 1e-14 * M.amax())?;
    let is_positive = M.cholesky().is_some();
    holds("where every vertex has an element, M is positive definite", is_positive)
}

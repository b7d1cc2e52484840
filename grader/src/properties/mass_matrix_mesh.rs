//! To do: the mass matrix of the whole mesh. Read include-docs/mass_matrix_mesh.md.

use nalgebra::{DMatrix, SMatrix, Vector3};

use super::meshes::{Mesh, stacked};
use super::outcome::{Mistake, Outcome, dense_of, holds, near, near_number, waits};
use super::random::{for_some, vector};
use super::{Check, Course};
use crate::implementation::Answer;

/// The properties of the function.
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

type OfElement = SMatrix<f64, 12, 12>;

/// uᵀ M v as a sum over elements, from the velocities of their four vertices.
fn of_all(elements: &[OfElement], mesh: &Mesh, u: &[Vector3<f64>], v: &[Vector3<f64>]) -> f64 {
    let felt = elements.iter().zip(&mesh.T).map(|(of_element, element)| {
        let [u, v] = [u, v].map(|all| stacked(&element.map(|vertex| all[vertex])));
        u.dot(&(of_element * v))
    });
    felt.sum()
}

fn elements_add_up_where_they_share_vertices(course: &Course) -> Outcome {
    let mesh = Mesh::uneven_box([2, 1, 1], 0.3);
    let M = dense(course, 3 * mesh.V.len(), &mesh.T, &mesh.v0)?;
    let of_volume = |&volume: &f64| course.trusted.mass_matrix_linear_tetrahedron(DENSITY, volume);
    let elements = mesh.v0.iter().map(of_volume).collect::<Answer<Vec<OfElement>>>();
    let elements = elements.map_err(waits("mass_matrix_linear_tetrahedron"))?;
    let positive = || proptest::collection::vec(vector(0.5..1.5), mesh.V.len());
    for_some(course.seed, (positive(), positive()), |(u, v)| {
        let expected = of_all(&elements, &mesh, &u, &v);
        let found = stacked(&u).dot(&(&M * stacked(&v)));
        near_number("uᵀ M v, summed over the elements", found, expected, 1e-13 * expected)
    })?;
    // One wrong entry among many can be lost in such sums, but not if only two vertices move.
    let at = |vertex: usize, axis: Vector3<f64>| {
        let mut all = vec![Vector3::zeros(); mesh.V.len()];
        all[vertex] = axis;
        all
    };
    let axes = [Vector3::x(), Vector3::y(), Vector3::z()];
    for (row, column) in (0..M.nrows()).flat_map(|row| (0..M.ncols()).map(move |column| (row, column))) {
        let (u, v) = (at(row / 3, axes[row % 3]), at(column / 3, axes[column % 3]));
        let expected = of_all(&elements, &mesh, &u, &v);
        near_number("the coupling of two vertices", M[(row, column)], expected, 1e-13 * M.amax())?;
    }
    Ok(())
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
        near_number("mass of a translation", along.dot(&(&M * &along)), mass, 1e-12 * mass)?;
    }
    Ok(())
}

fn vertices_without_elements_have_no_mass_and_the_matrix_keeps_its_size(course: &Course) -> Outcome {
    let M = dense(course, 24, &[[6, 2, 5, 1]], &[2.0])?;
    for vertex in [0, 3, 4, 7] {
        let row = M.rows(3 * vertex, 3);
        near("vertices without elements have no mass", &row, &DMatrix::zeros(3, 24), 0.0)?;
    }
    near_number("those of the one element have all of it, along each axis", M.sum(), 3.0 * DENSITY * 2.0, 1e-10)?;
    near("no element at all", &dense(course, 6, &[], &[])?, &DMatrix::zeros(6, 6), 0.0)
}

fn it_is_symmetric_and_positive_definite(course: &Course) -> Outcome {
    let mesh = Mesh::uneven_box([1, 1, 2], 1.0);
    let M = dense(course, 3 * mesh.V.len(), &mesh.T, &mesh.v0)?;
    near("a mass matrix is symmetric", &M, &M.transpose(), 1e-14 * M.amax())?;
    let is_positive = M.cholesky().is_some();
    holds("where every vertex has an element, M is positive definite", is_positive)
}

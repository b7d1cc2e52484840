//! To do: the mass matrix of the whole mesh. Read include-docs/mass_matrix_mesh.md.

use finite_elements_3d::{T_linear_tetrahedron, mass_matrix_linear_tetrahedron, mass_matrix_mesh};
use nalgebra::{DMatrix, Vector3};

use crate::meshes::{Mesh, stacked};
use crate::outcome::{Outcome, for_all, holds, near, near_number};
use crate::random::vector;

const DENSITY: f64 = 800.0;

fn dense(q_size: usize, T: &[[usize; 4]], v0: &[f64]) -> DMatrix<f64> {
    DMatrix::from(&mass_matrix_mesh(q_size, T, DENSITY, v0))
}

/// Every entry of every element, added where its vertices say.
fn by_definition(q_size: usize, T: &[[usize; 4]], v0: &[f64]) -> DMatrix<f64> {
    let mut M = DMatrix::zeros(q_size, q_size);
    for (row, column) in (0..12).flat_map(|row| (0..12).map(move |column| (row, column))) {
        for (element, &volume) in T.iter().zip(v0) {
            let (i, j) = (3 * element[row / 3] + row % 3, 3 * element[column / 3] + column % 3);
            M[(i, j)] += mass_matrix_linear_tetrahedron(DENSITY, volume)[(row, column)];
        }
    }
    M
}

#[test]
fn elements_add_up_where_they_share_vertices() -> Outcome {
    let mesh = Mesh::uneven_box([2, 1, 1], 0.3);
    let q_size = 3 * mesh.V.len();
    let expected = by_definition(q_size, &mesh.T, &mesh.v0);
    near("M, summed over the elements", &dense(q_size, &mesh.T, &mesh.v0), &expected, 1e-13 * expected.amax())
}

#[test]
fn each_element_has_its_own_volume() -> Outcome {
    let T = [[0, 1, 2, 3], [3, 2, 1, 4]];
    let M = dense(15, &T, &[1.0, 20.0]);
    near_number("vertex 0 has the first element alone", M[(0, 0)], DENSITY * 1.0 / 10.0, 1e-10)?;
    near_number("vertex 4 has the second element alone", M[(14, 14)], DENSITY * 20.0 / 10.0, 1e-10)?;
    near_number("vertex 3 has both", M[(10, 10)], DENSITY * 21.0 / 10.0, 1e-10)?;
    near_number("vertices 1 and 2 have both", M[(5, 8)], DENSITY * 21.0 / 20.0, 1e-10)?;
    near_number("vertices 0 and 4 have none", M[(0, 12)], 0.0, 0.0)
}

#[test]
fn half_v_m_v_is_the_kinetic_energy_of_the_elements() -> Outcome {
    let mesh = Mesh::uneven_box([1, 2, 1], 2.0);
    let M = mass_matrix_mesh(3 * mesh.V.len(), &mesh.T, DENSITY, &mesh.v0);
    for_all(proptest::collection::vec(vector(-3.0..3.0), mesh.V.len()), |velocities| {
        let qdot = stacked(&velocities);
        let kinetic = |(element, &volume): (&[usize; 4], &f64)| T_linear_tetrahedron(&qdot, element, DENSITY, volume);
        let expected: f64 = mesh.T.iter().zip(&mesh.v0).map(kinetic).sum();
        near_number("½ q̇ᵀ M q̇ = Σ T", 0.5 * qdot.dot(&(&M * &qdot)), expected, 1e-12 * expected)
    })
}

#[test]
fn the_total_mass_is_density_times_volume() -> Outcome {
    let mesh = Mesh::uneven_box([2, 2, 1], 0.1);
    let M = mass_matrix_mesh(3 * mesh.V.len(), &mesh.T, DENSITY, &mesh.v0);
    let mass = DENSITY * mesh.v0.iter().sum::<f64>();
    for axis in [Vector3::x(), Vector3::y(), Vector3::z()] {
        let along = mesh.placed(|_| axis);
        near_number("mass felt by a translation", along.dot(&(&M * &along)), mass, 1e-12 * mass)?;
    }
    Ok(())
}

#[test]
fn vertices_without_elements_have_no_mass_and_the_matrix_keeps_its_size() -> Outcome {
    let M = dense(24, &[[6, 2, 5, 1]], &[2.0]);
    near("eight vertices, one element", &M, &by_definition(24, &[[6, 2, 5, 1]], &[2.0]), 1e-10)?;
    near("no element at all", &dense(6, &[], &[]), &DMatrix::zeros(6, 6), 0.0)
}

#[test]
fn it_is_symmetric_and_positive_definite() -> Outcome {
    let mesh = Mesh::uneven_box([1, 1, 2], 1.0);
    let M = dense(3 * mesh.V.len(), &mesh.T, &mesh.v0);
    near("a mass matrix is symmetric", &M, &M.transpose(), 1e-14 * M.amax())?;
    let is_positive = M.cholesky().is_some();
    holds("where every vertex has an element, M is positive definite", is_positive)
}

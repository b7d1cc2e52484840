//! The fields of a `.vtu`: displacements, velocities, forces, stresses and strains of a simulation.

use std::path::Path;

use nalgebra::{Matrix3, Vector3};

use super::StressError;
use super::recovery;
use fem_mesh::MeshError;
use fem_mesh::write::{Field, write_vtu};
use fem_model::BodyMesh;
use fem_model::simulation::Simulation;

/// Writes the undeformed mesh with the fields of the state. Names have neither blanks nor units, so that programs can use them:
/// point data `displacement` (m), `velocity` (m/s), `nodal_force` (N), `contact_force` (N), `stress_averaged` (Pa), recovered by patches, and `stress_volume_averaged` (Pa), cell data `stress`,
/// `von_mises` (Pa), `stress_error`, `strain`, `J` and, of a plastic body, `plastic_strain`. A mass-spring body has no fields of stress. Matrices have nine components, row by row.
pub(super) fn export_fields(path: &Path, simulation: &dyn Simulation) -> Result<(), MeshError> {
    let shape = simulation.shape();
    let (q, qdot) = (simulation.positions(), simulation.velocities());
    let displacement: Vec<f64> = q.iter().enumerate().map(|(i, x)| x - shape.mesh.vertices()[i / 3][i % 3]).collect();
    let force = simulation.nodal_forces();
    let contact = simulation.contact_forces();
    let stresses = simulation.stresses();
    let recovered = entries(&stresses_at_nodes(simulation));
    let averaged = entries(&averages_at_nodes(&shape.mesh, &stresses));
    let gradients = displacement_gradients(&shape.mesh, &displacement);
    let strain = entries(&gradients.iter().map(green_lagrange_strain).collect::<Vec<_>>());
    let J: Vec<f64> = gradients.iter().map(|G| (Matrix3::identity() + G).determinant()).collect();
    let stress = entries(&stresses);
    let von_mises: Vec<f64> = stresses.iter().map(von_mises).collect();

    let mut point = vec![
        Field { name: "displacement", components: 3, values: &displacement },
        Field { name: "velocity", components: 3, values: qdot.as_slice() },
    ];
    if simulation.has_stress() {
        point.push(Field { name: "stress_averaged", components: 9, values: &recovered });
        point.push(Field { name: "stress_volume_averaged", components: 9, values: &averaged });
    }
    if let Some(force) = &force {
        point.push(Field { name: "nodal_force", components: 3, values: force.as_slice() });
    }
    if let Some(contact) = &contact {
        point.push(Field { name: "contact_force", components: 3, values: contact.as_slice() });
    }
    let flow = simulation.plastic_flow();
    let error = StressError::of(simulation);
    let mut cell = Vec::new();
    if simulation.has_stress() {
        cell.push(Field { name: "stress", components: 9, values: &stress });
        cell.push(Field { name: "von_mises", components: 1, values: &von_mises });
    }
    if let Some(error) = &error {
        cell.push(Field { name: "stress_error", components: 1, values: &error.of_elements });
    }
    cell.extend([
        Field { name: "strain", components: 9, values: &strain },
        Field { name: "J", components: 1, values: &J },
    ]);
    if let Some(flow) = &flow {
        cell.push(Field { name: "plastic_strain", components: 1, values: &flow.strains });
    }
    write_vtu(path, shape.mesh.grid(), &point, &cell)
}

/// Von Mises stress √(3/2 s:s) of a Cauchy stress with the deviator s, Pa.
pub fn von_mises(stress: &Matrix3<f64>) -> f64 {
    let deviator = stress - Matrix3::identity() * (stress.trace() / 3.0);
    (1.5 * deviator.norm_squared()).sqrt()
}

/// The entries of symmetric matrices, whose columns are their rows.
fn entries(matrices: &[Matrix3<f64>]) -> Vec<f64> {
    matrices.iter().flat_map(|matrix| matrix.iter().copied()).collect()
}

/// The Cauchy stress of each node now, recovered by patches, Pa; of a mass-spring body none.
pub fn stresses_at_nodes(simulation: &dyn Simulation) -> Vec<Matrix3<f64>> {
    if !simulation.has_stress() {
        return Vec::new();
    }
    let mesh = &simulation.shape().mesh;
    recovery::stresses_at_nodes(mesh, &simulation.material_of_elements(), &simulation.stresses_at_points())
}

/// The mean over the elements of each node, weighted by their undeformed volumes.
pub(super) fn averages_at_nodes(mesh: &BodyMesh, values: &[Matrix3<f64>]) -> Vec<Matrix3<f64>> {
    let mut sums = vec![(Matrix3::zeros(), 0.0); mesh.vertices().len()];
    for ((nodes, value), volume) in mesh.corners().zip(values).zip(mesh.volumes()) {
        for &node in nodes {
            sums[node].0 += volume * value;
            sums[node].1 += volume;
        }
    }
    sums.into_iter().map(|(sum, volume)| sum / volume).collect()
}

/// G = F − 1 of each element, from the displacements `u  (3n)`, m: the mean over it.
fn displacement_gradients(mesh: &BodyMesh, u: &[f64]) -> Vec<Matrix3<f64>> {
    let of_node = |node: usize| Vector3::from_column_slice(&u[3 * node..3 * node + 3]);
    (0..mesh.elements()).map(|element| mesh.displacement_gradient(element, of_node)).collect()
}

/// E = (FᵀF − 1)/2 = (G + Gᵀ + GᵀG)/2, which keeps its digits near rest.
fn green_lagrange_strain(G: &Matrix3<f64>) -> Matrix3<f64> {
    0.5 * (G + G.transpose() + G.transpose() * G)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_von_mises_stress_is_the_stress_of_a_tension_and_zero_for_a_pressure() {
        assert_eq!(von_mises(&Matrix3::from_diagonal(&[2.0, 0.0, 0.0].into())), 2.0);
        assert_eq!(von_mises(&Matrix3::from_diagonal_element(-3.0)), 0.0);
    }

    /// Displacements of a box under x ↦ F x, stacked.
    fn stretched(F: &Matrix3<f64>) -> (BodyMesh, Vec<f64>) {
        let mesh = fem_mesh::box_mesh([2.0, 1.0, 1.0], 2, fem_mesh::Pattern::Alternating).unwrap();
        let u = mesh.vertices.iter().flat_map(|x| <[f64; 3]>::from((F - Matrix3::identity()) * x)).collect();
        (mesh.into(), u)
    }

    #[test]
    fn the_strain_of_an_affine_deformation_is_half_of_the_metric_less_one_in_every_element() {
        let F = Matrix3::new(1.3, 0.2, 0.0, -0.1, 0.9, 0.3, 0.05, 0.0, 1.1);
        let (mesh, u) = stretched(&F);
        for G in displacement_gradients(&mesh, &u) {
            let expected = 0.5 * (F.transpose() * F - Matrix3::identity());
            assert!((green_lagrange_strain(&G) - expected).norm() < 1e-13);
            assert!(((Matrix3::identity() + G).determinant() - F.determinant()).abs() < 1e-13);
        }
    }

    #[test]
    fn a_rotation_has_no_strain() {
        let F = nalgebra::Rotation3::from_euler_angles(0.4, 1.0, -2.0);
        let (mesh, u) = stretched(F.matrix());
        let largest = displacement_gradients(&mesh, &u).into_iter().map(|G| green_lagrange_strain(&G).amax());
        assert!(largest.fold(0.0, f64::max) < 1e-14);
    }

    #[test]
    fn averages_at_nodes_are_weighted_by_volume_and_keep_a_uniform_field() {
        let (mesh, _) = stretched(&Matrix3::identity());
        let uniform = Matrix3::new(1.0, 2.0, 3.0, 2.0, 4.0, 5.0, 3.0, 5.0, 6.0);
        let averages = averages_at_nodes(&mesh, &vec![uniform; mesh.elements()]);
        assert!(averages.iter().all(|average| (average - uniform).amax() < 1e-14));
        let vertices = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [0.0, 0.0, -3.0]];
        let two =
            fem_mesh::TetrahedralMesh::new(vertices.map(Vector3::from).to_vec(), vec![[0, 1, 2, 3], [0, 2, 1, 4]]);
        let averages = averages_at_nodes(&two.into(), &[Matrix3::identity(), 5.0 * Matrix3::identity()]);
        assert_eq!(averages.iter().map(|average| average[0]).collect::<Vec<_>>(), [4.0, 4.0, 4.0, 1.0, 5.0]);
    }
}

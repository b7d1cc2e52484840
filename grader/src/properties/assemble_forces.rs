//! To do: the elastic force on every vertex, f = −∂V/∂q. Read include-docs/assemble_forces.md.

use nalgebra::{DVector, Matrix3, Vector3};

use super::finite_differences::gradient;
use super::meshes::{Mesh, Tetrahedron, stacked};
use super::outcome::{Mistake, Outcome, holds, long, near, waits};
use super::random::{constants, for_all, rotation, vector};
use super::{Check, Course};

/// The properties of the function.
pub const CHECKS: &[Check] = checks![
    every_element_subtracts_its_gradient_at_its_vertices,
    it_is_minus_the_gradient_of_the_total_energy,
    a_rigid_motion_causes_no_force,
    internal_forces_and_torques_balance,
    an_affine_deformation_leaves_interior_vertices_in_equilibrium,
    each_element_has_its_own_volume_and_other_vertices_no_force,
];

const C: f64 = 2e5;
const D: f64 = 7e5;

fn force(course: &Course, mesh: &Mesh, q: &DVector<f64>) -> Result<DVector<f64>, Mistake> {
    long(q.len(), course.subject.assemble_forces(q, &mesh.V, &mesh.T, &mesh.v0, C, D)?)
}

/// A state in which every element is deformed in its own way.
fn deformed(mesh: &Mesh, size: f64) -> DVector<f64> {
    mesh.placed(|X| {
        let x = X / size;
        let bend = Vector3::new((x.y * 1.3).sin(), x.x * x.z * 0.3, (x.x + x.y).cos());
        Matrix3::new(1.1, 0.2, 0.0, -0.1, 0.9, 0.1, 0.0, 0.3, 1.2) * X + bend * (0.1 * size)
    })
}

fn every_element_subtracts_its_gradient_at_its_vertices(course: &Course) -> Outcome {
    let mesh = Mesh::uneven_box([2, 1, 1], 0.3);
    let q = deformed(&mesh, 0.3);
    let mut expected = DVector::zeros(q.len());
    for (element, &volume) in mesh.T.iter().zip(&mesh.v0) {
        let gradient = course.trusted.dV_linear_tetrahedron_dq(&q, &mesh.V, element, volume, C, D);
        let gradient = gradient.map_err(waits("dV_linear_tetrahedron_dq"))?;
        for row in 0..12 {
            expected[3 * element[row / 3] + row % 3] -= gradient[row];
        }
    }
    near("f = −Σ dV (mind the sign)", &force(course, &mesh, &q)?, &expected, 1e-12 * expected.amax())
}

fn it_is_minus_the_gradient_of_the_total_energy(course: &Course) -> Outcome {
    let mesh = Mesh::uneven_box([1, 2, 1], 0.3);
    let q = deformed(&mesh, 0.3);
    let energy = |q: &DVector<f64>| {
        let mut sum = 0.0;
        for (element, &volume) in mesh.T.iter().zip(&mesh.v0) {
            let V = course.trusted.V_linear_tetrahedron(q, &mesh.V, element, volume, C, D);
            sum += V.map_err(waits("V_linear_tetrahedron"))?;
        }
        Ok(sum)
    };
    let expected = -gradient(energy, &q, 0.005)?;
    near("differences of the total energy", &force(course, &mesh, &q)?, &expected, 1e-9 * (C + D) * 0.09)
}

fn a_rigid_motion_causes_no_force(course: &Course) -> Outcome {
    let mesh = Mesh::uneven_box([2, 2, 2], 1.0);
    for_all(course.seed, (rotation(), vector(-5.0..5.0)), |(R, shift)| {
        let found = force(course, &mesh, &mesh.placed(|X| R * X + shift))?;
        near("f of a moved and rotated body", &found, &DVector::<f64>::zeros(found.len()), 1e-12 * (C + D) * 10.0)
    })
}

fn internal_forces_and_torques_balance(course: &Course) -> Outcome {
    let mesh = Mesh::uneven_box([2, 2, 1], 1.0);
    for_all(course.seed, proptest::collection::vec(vector(-0.05..0.05), mesh.V.len()), |noise| {
        let q = deformed(&mesh, 1.0) + stacked(&noise);
        let f = force(course, &mesh, &q)?;
        let (mut sum, mut torque) = (Vector3::zeros(), Vector3::zeros());
        for vertex in 0..mesh.V.len() {
            let (x, f) = (q.fixed_rows::<3>(3 * vertex), f.fixed_rows::<3>(3 * vertex));
            sum += f;
            torque += x.cross(&f);
        }
        holds("a deformed body has forces", f.amax() > 1e-3 * (C + D))?;
        near("the resultant of the internal forces", &sum, &Vector3::zeros(), 1e-12 * (C + D) * 10.0)?;
        near("the resultant torque of the internal forces", &torque, &Vector3::zeros(), 1e-12 * (C + D) * 10.0)
    })
}

fn an_affine_deformation_leaves_interior_vertices_in_equilibrium(course: &Course) -> Outcome {
    // The patch test: the same stress everywhere, so the force on an inner vertex is zero. Two cells a side have one.
    let mesh = Mesh::uneven_box([2, 2, 2], 1.0);
    let F = Matrix3::new(1.2, 0.4, 0.0, -0.2, 0.8, 0.1, 0.1, 0.0, 1.5);
    let f = force(course, &mesh, &mesh.placed(|X| F * X))?;
    let middle = Vector3::repeat(1.0);
    let inside = (0..mesh.V.len()).min_by(|&a, &b| {
        let distance = |vertex: usize| (mesh.V[vertex] - middle).norm();
        distance(a).total_cmp(&distance(b))
    });
    let inside = inside.expect("the mesh has vertices");
    near("the force inside", &f.fixed_rows::<3>(3 * inside), &Vector3::zeros(), 1e-12 * (C + D) * 10.0)
}

fn each_element_has_its_own_volume_and_other_vertices_no_force(course: &Course) -> Outcome {
    let t = Tetrahedron::new([7, 1, 4, 2], &Matrix3::identity(), &Vector3::zeros());
    let q = t.moved(&(Matrix3::identity() * 2.0), &Vector3::zeros());
    for_all(course.seed, constants(), |(c, d)| {
        // The same element twice, with volumes 1 and 10: the forces of 11 times the unit volume.
        let f = course.subject.assemble_forces(&q, &t.V, &[t.element, t.element], &[1.0, 10.0], c, d)?;
        let p = 56.0 * d * 11.0;
        let expected = [(7, [p, p, p]), (1, [-p, 0.0, 0.0]), (4, [0.0, -p, 0.0]), (2, [0.0, 0.0, -p])];
        let mut f_expected = DVector::zeros(27);
        for (vertex, force) in expected {
            f_expected.fixed_rows_mut::<3>(3 * vertex).copy_from(&Vector3::from(force));
        }
        near("f of two stretched elements", &f, &f_expected, 1e-12 * 11.0 * 100.0 * (c + d))
    })?;
    let none = course.subject.assemble_forces(&q, &t.V, &[], &[], 1.0, 1.0)?;
    near("no element, no force, one entry for each coordinate", &none, &DVector::<f64>::zeros(27), 0.0)
}

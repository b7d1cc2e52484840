//! Given functions, `given::{deformation_gradient, volumes}`: no exercise; read include-docs/given.md.

use approx::assert_relative_eq;
use finite_elements_3d::{dphi_linear_tetrahedron_dX, given};
use nalgebra::{Matrix3, Vector3};

use crate::for_all;
use grader::properties::meshes::{Mesh, Tetrahedron};
use grader::properties::outcome::{Outcome, near, near_number};
use grader::properties::random::deformed_tetrahedron;

#[test]
fn an_affine_motion_has_its_own_deformation_gradient() -> Outcome {
    for_all(deformed_tetrahedron(), |(t, F, shift)| {
        let dphi = dphi_linear_tetrahedron_dX(&t.V, &t.element, &t.X()[0]);
        let found = given::deformation_gradient(&t.moved(&F, &shift), &t.element, &dphi);
        near("F of X → F X + shift", &found, &F, 1e-12 * F.norm() * t.size() / t.height() * 10.0)
    })
}

#[test]
fn volumes_are_those_of_geometry() -> Outcome {
    let unit = Tetrahedron::unit();
    let T = [[0, 1, 2, 3], [1, 0, 2, 3]];
    let volumes = given::volumes(&unit.V, &T);
    near_number("the unit tetrahedron", volumes[0], 1.0 / 6.0, 1e-15)?;
    near_number("turned inside out", volumes[1], -1.0 / 6.0, 1e-15)?;
    let mesh = Mesh::uneven_box([2, 1, 2], 0.1);
    for (found, expected) in given::volumes(&mesh.V, &mesh.T).into_iter().zip(&mesh.v0) {
        near_number("a sixth of the determinant of the edges", found, *expected, 1e-15 * expected)?;
    }
    let stretched =
        Tetrahedron::new([4, 1, 7, 3], &Matrix3::from_diagonal(&Vector3::new(2.0, 3.0, 4.0)), &Vector3::x());
    assert_relative_eq!(
        given::volumes(&stretched.V, &[stretched.element])[0],
        2.0 * 3.0 * 4.0 / 6.0,
        max_relative = 1e-14
    );
    Ok(())
}

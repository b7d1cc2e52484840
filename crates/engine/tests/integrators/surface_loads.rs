//! Nodal forces of tractions and pressures: shares, resultants and moments.

use std::path::Path;

use approx::assert_relative_eq;
use fem_engine::forces::{Moment, dead_load, pressure};
use fem_engine::materials::AnyLaw;
use fem_engine::model::system::System;
use fem_engine::solvers::SolverChoice;
use nalgebra::{Rotation3, Vector3};

use crate::pressures::{closed, pressed};
use crate::{scene, soft};

/// Position and force of each node of a box of 2 × 1 × 1 m in a deformed state, m and N.
fn nodal_forces(
    tables: &str,
    name: &str,
    deformed: impl Fn(&Vector3<f64>) -> Vector3<f64>,
) -> Vec<(Vector3<f64>, Vector3<f64>)> {
    let scene = scene(&soft("rk4", 1e-3, tables));
    let body = fem_scene::body(&scene, Path::new("no data")).unwrap();
    let system = System::<f64>::new(body, AnyLaw::new(&scene.material.value()).unwrap(), SolverChoice::Cholesky);
    let positions: Vec<_> = system.rest.iter().map(deformed).collect();
    let u: Vec<[f64; 3]> = positions.iter().zip(&system.rest).map(|(x, X)| (x - X).into()).collect();
    let mut gradient = vec![[0.0; 3]; system.nodes()];
    let (potential, _) = system.forces.all().find(|(potential, _)| potential.name() == name).unwrap();
    potential.subtract_force(&u, Moment::at(0.0), &mut gradient);
    positions.into_iter().zip(gradient).map(|(x, gradient)| (x, -Vector3::from(gradient))).collect()
}

fn resultant(forces: &[(Vector3<f64>, Vector3<f64>)]) -> Vector3<f64> {
    forces.iter().map(|(_, force)| force).sum()
}

fn moment(forces: &[(Vector3<f64>, Vector3<f64>)]) -> Vector3<f64> {
    forces.iter().map(|(x, force)| x.cross(force)).sum()
}

const TRACTION: &str =
    "[[traction]]\non = { axis = \"x\", side = \"max\", within = 1e-9 }\nforce_per_area = [3, -5, 7]\n";

#[test]
fn a_traction_gives_each_corner_a_third_of_its_triangles() {
    let mut shares: Vec<f64> = nodal_forces(TRACTION, dead_load::NAME, |X| *X)
        .into_iter()
        .filter(|(x, _)| x.x == 2.0)
        .map(|(_, force)| force.z / 7.0)
        .collect();
    shares.sort_by(f64::total_cmp);
    // Two triangles of ½ m² share the nodes of a diagonal.
    let expected = [1.0 / 6.0, 1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0];
    assert_relative_eq!(&shares[..], &expected[..], max_relative = 1e-14);
}

#[test]
fn a_traction_keeps_its_resultant_and_its_moment() {
    let (traction, forces) = (Vector3::new(3.0, -5.0, 7.0), nodal_forces(TRACTION, dead_load::NAME, |X| *X));
    assert_relative_eq!(resultant(&forces), traction, max_relative = 1e-14);
    assert_relative_eq!(moment(&forces), Vector3::new(2.0, 0.5, 0.5).cross(&traction), max_relative = 1e-14);
}

#[test]
fn a_pressure_on_a_closed_surface_is_in_balance() {
    let bent = |X: &Vector3<f64>| X + Vector3::new(0.3 * X.y * X.z, X.x.sin(), 0.2 * X.y);
    let forces = nodal_forces(&closed(1e3), pressure::NAME, bent);
    assert!(resultant(&forces).norm() < 1e-10 && moment(&forces).norm() < 1e-10, "{forces:?}");
}

#[test]
fn a_pressure_pushes_inward_and_turns_with_its_surface() {
    let rotation = Rotation3::from_axis_angle(&Vector3::z_axis(), 0.7);
    let forces = nodal_forces(&pressed(&[("x", "max")], 10.0), pressure::NAME, |X| rotation * X);
    assert_relative_eq!(resultant(&forces), rotation * Vector3::new(-10.0, 0.0, 0.0), epsilon = 1e-13);
}

//! Sides of a mesh, and the forces that a load on them gives to the nodes.

use approx::assert_relative_eq;
use fem_mesh::{
    Side, area_vector, boundary, box_mesh, faces_on_side, nodes_on_side, pressure_forces, pressure_stiffness,
    traction_forces,
};
use nalgebra::{DMatrix, DVector, Rotation3, Vector3};

#[test]
fn the_side_of_a_box_has_its_triangles_and_its_area() {
    let mesh = box_mesh([2.0, 1.0, 0.5], 2).unwrap();
    let faces = boundary(&mesh);
    for (axis, area, triangles) in [(0, 0.5, 2 * 2), (1, 1.0, 2 * 4), (2, 2.0, 2 * 8)] {
        for (side, sign) in [(Side::Min, -1.0), (Side::Max, 1.0)] {
            let found = faces_on_side(&mesh.vertices, &faces, axis, side, 1e-9);
            assert_eq!(found.len(), triangles);
            let sum: Vector3<f64> = found.iter().map(|face| area_vector(face.map(|i| mesh.vertices[i]))).sum();
            let mut expected = Vector3::zeros();
            expected[axis] = sign * area;
            assert_relative_eq!(sum, expected, epsilon = 1e-15);
        }
    }
}

#[test]
fn nodes_within_the_distance_belong_to_a_side_and_those_at_it() {
    let mesh = box_mesh([4.0, 1.0, 1.0], 1).unwrap();
    assert_eq!(nodes_on_side(&mesh.vertices, 0, Side::Max, 0.0), [4, 9, 14, 19]);
    assert_eq!(nodes_on_side(&mesh.vertices, 0, Side::Max, 1.0), [3, 4, 8, 9, 13, 14, 18, 19]);
    assert_eq!(nodes_on_side(&mesh.vertices, 0, Side::Min, 0.9), [0, 5, 10, 15]);
}

#[test]
fn an_even_traction_gives_each_corner_a_third_of_its_triangles() {
    let mesh = box_mesh([1.0, 1.0, 1.0], 1).unwrap();
    let side = faces_on_side(&mesh.vertices, &boundary(&mesh), 0, Side::Max, 0.0);
    let forces = traction_forces(&mesh.vertices, &side, &Vector3::new(0.0, 0.0, 6.0));
    // The diagonal of the side runs from node 1 to node 7, which have both triangles.
    let expected = [(1, 2.0), (3, 1.0), (5, 1.0), (7, 2.0)].map(|(node, force)| (node, Vector3::new(0.0, 0.0, force)));
    assert_eq!(forces.len(), 4);
    for ((node, force), (expected_node, expected)) in forces.into_iter().zip(expected) {
        assert_eq!(node, expected_node);
        assert_relative_eq!(force, expected, max_relative = 1e-15);
    }
}

#[test]
fn an_even_traction_keeps_force_and_moment() {
    let mesh = box_mesh([1.0, 2.0, 3.0], 2).unwrap();
    let side = faces_on_side(&mesh.vertices, &boundary(&mesh), 2, Side::Max, 0.0);
    let traction = Vector3::new(3.0, -5.0, 7.0);
    let forces = traction_forces(&mesh.vertices, &side, &traction);
    let sum: Vector3<f64> = forces.iter().map(|(_, force)| force).sum();
    assert_relative_eq!(sum, 2.0 * traction, max_relative = 1e-14);
    let moment: Vector3<f64> = forces.iter().map(|(node, force)| mesh.vertices[*node].cross(force)).sum();
    assert_relative_eq!(moment, Vector3::new(0.5, 1.0, 3.0).cross(&(2.0 * traction)), max_relative = 1e-14);
}

#[test]
fn a_pressure_all_around_a_body_is_in_balance() {
    let mesh = box_mesh([1.0, 2.0, 0.5], 2).unwrap();
    let places: Vec<_> =
        mesh.vertices.iter().map(|x| x + Vector3::new(0.3 * x.y * x.z, x.x.sin(), 0.2 * x.y)).collect();
    let forces = pressure_forces(&places, &boundary(&mesh), 1e3);
    let sum: Vector3<f64> = forces.iter().map(|(_, force)| force).sum();
    let moment: Vector3<f64> = forces.iter().map(|(node, force)| places[*node].cross(force)).sum();
    assert!(sum.norm() < 1e-10 && moment.norm() < 1e-10, "{sum} {moment}");
}

#[test]
fn a_pressure_pushes_inward_and_turns_with_the_face() {
    let mesh = box_mesh([1.0, 1.0, 1.0], 1).unwrap();
    let side = faces_on_side(&mesh.vertices, &boundary(&mesh), 0, Side::Max, 0.0);
    let turn = Rotation3::from_axis_angle(&Vector3::z_axis(), 0.7);
    let turned: Vec<_> = mesh.vertices.iter().map(|x| turn * x).collect();
    let sum: Vector3<f64> = pressure_forces(&turned, &side, 10.0).iter().map(|(_, force)| force).sum();
    assert_relative_eq!(sum, turn * Vector3::new(-10.0, 0.0, 0.0), epsilon = 1e-13);
}

fn assembled(places: &[Vector3<f64>], faces: &[[usize; 3]], pressure: f64) -> DMatrix<f64> {
    let mut stiffness = DMatrix::zeros(3 * places.len(), 3 * places.len());
    for (face, block) in pressure_stiffness(places, faces, pressure) {
        for (i, j) in (0..9).flat_map(|i| (0..9).map(move |j| (i, j))) {
            stiffness[(3 * face[i / 3] + i % 3, 3 * face[j / 3] + j % 3)] += block[(i, j)];
        }
    }
    stiffness
}

#[test]
fn the_stiffness_of_a_pressure_is_the_derivative_of_its_forces() {
    let places = [[0.1, 0.2, -0.3], [1.2, 0.1, 0.4], [-0.2, 0.9, 0.3], [0.8, 1.1, -0.6]].map(Vector3::from).to_vec();
    let faces = [[0, 1, 2], [1, 3, 2]];
    let forces = |places: &[Vector3<f64>]| {
        let mut all = DVector::zeros(12);
        for (node, force) in pressure_forces(places, &faces, 7.0) {
            all.fixed_rows_mut::<3>(3 * node).copy_from(&force);
        }
        all
    };
    let stiffness = assembled(&places, &faces, 7.0);
    for coordinate in 0..12 {
        let moved = |step: f64| {
            let mut places = places.clone();
            places[coordinate / 3][coordinate % 3] += step;
            forces(&places)
        };
        // Forces are quadratic in each coordinate, so a central difference has no error but rounding.
        let difference = moved(0.5) - moved(-0.5);
        assert_relative_eq!(stiffness.column(coordinate).into_owned(), difference, epsilon = 1e-13);
    }
}

#[test]
fn the_stiffness_of_a_pressure_on_a_closed_surface_is_symmetric() {
    let mesh = box_mesh([1.0, 1.0, 1.0], 1).unwrap();
    let stiffness = assembled(&mesh.vertices, &boundary(&mesh), 1.0);
    assert!((&stiffness - stiffness.transpose()).amax() < 1e-15 && stiffness.amax() > 0.1);
}

//! Shapes of tetrahedra and triangles.

use approx::assert_relative_eq;
use fem_mesh::{Mesh, Quality, TetrahedralMesh, quality, triangle_quality};
use nalgebra::{Vector2, Vector3};

fn one(vertices: [[f64; 3]; 4]) -> Quality {
    quality(&TetrahedralMesh::new(vertices.map(Vector3::from).to_vec(), vec![[0, 1, 2, 3]]))
}

#[test]
fn the_regular_tetrahedron_is_perfect() {
    let regular = one([[0.0, 0.0, 0.0], [1.0, 1.0, 0.0], [1.0, 0.0, 1.0], [0.0, 1.0, 1.0]]);
    // This order of the corners is the mirrored one.
    assert_relative_eq!(regular.volume, -1.0 / 3.0, max_relative = 1e-14);
    let regular = one([[0.0, 0.0, 0.0], [1.0, 0.0, 1.0], [1.0, 1.0, 0.0], [0.0, 1.0, 1.0]]);
    assert_relative_eq!(regular.radius_ratio.value, 1.0, max_relative = 1e-14);
    assert_relative_eq!(regular.smallest_height.value, (4.0_f64 / 3.0).sqrt(), max_relative = 1e-14);
    let angle = (1.0_f64 / 3.0).acos().to_degrees();
    assert_relative_eq!(regular.dihedral_angles[0].value, angle, max_relative = 1e-13);
    assert_relative_eq!(regular.dihedral_angles[1].value, angle, max_relative = 1e-13);
}

#[test]
fn the_corner_of_a_cube_has_angles_of_90_degrees_and_of_the_arc_tangent_of_the_root_of_two() {
    let corner = one([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
    assert_relative_eq!(corner.dihedral_angles[0].value, 2.0_f64.sqrt().atan().to_degrees(), max_relative = 1e-13);
    assert_relative_eq!(corner.dihedral_angles[1].value, 90.0, max_relative = 1e-13);
    // r = 1 / (3 + √3), R = √3 / 2
    let ratio = 3.0 / (3.0 + 3.0_f64.sqrt()) / (3.0_f64.sqrt() / 2.0);
    assert_relative_eq!(corner.radius_ratio.value, ratio, max_relative = 1e-13);
    assert_relative_eq!(corner.smallest_height.value, 1.0 / 3.0_f64.sqrt(), max_relative = 1e-13);
}

#[test]
fn the_worst_ratio_is_that_of_the_smallest_angle() {
    let corners = [[0.0, 0.0], [1.0, 0.0], [0.5, 0.75_f64.sqrt()], [0.5, -0.1]].map(Vector2::from);
    let found = triangle_quality(&Mesh::new(corners.to_vec(), vec![[0, 1, 2], [1, 0, 3]]));
    let angle = 0.2_f64.atan();
    assert_relative_eq!(found.angles[0].value, angle.to_degrees(), max_relative = 1e-14);
    assert_relative_eq!(found.angles[1].value, 180.0 - 2.0 * angle.to_degrees(), max_relative = 1e-14);
    assert_relative_eq!(found.radius_to_edge.value, 0.5 / angle.sin(), max_relative = 1e-14);
    assert_eq!((found.radius_to_edge.element, found.angles[0].element), (1, 1));
    assert_relative_eq!(found.median_radius_to_edge, 1.0 / 3.0_f64.sqrt(), max_relative = 1e-14);
    assert_relative_eq!(found.area, 0.75_f64.sqrt() / 2.0 + 0.05, max_relative = 1e-14);
    assert_relative_eq!(found.mean_edge, (3.0 + 2.0 * 0.26_f64.sqrt()) / 5.0, max_relative = 1e-14);
}

#[test]
fn a_mesh_in_space_is_measured_as_one_in_the_plane() {
    let corners = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 0.0, 1.0]].map(Vector3::from);
    let found = triangle_quality(&Mesh::new(corners.to_vec(), vec![[0, 1, 2]]));
    assert_relative_eq!(found.area, 1.0, max_relative = 1e-14);
    assert_relative_eq!(found.angles[1].value, 90.0, max_relative = 1e-14);
    assert_relative_eq!(found.radius_to_edge.value, 5.0_f64.sqrt() / 2.0, max_relative = 1e-14);
}

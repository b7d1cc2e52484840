//! Distributions of shapes.

use approx::assert_relative_eq;
use fem_mesh::{
    Distribution, Pattern, SurfaceMesh, TetrahedralMesh, box_mesh, tetrahedron_distributions, triangle_distributions,
};
use nalgebra::Vector3;

#[test]
fn a_regular_tetrahedron_has_the_best_values() {
    let vertices = [[0.0, 0.0, 0.0], [1.0, 0.0, 1.0], [1.0, 1.0, 0.0], [0.0, 1.0, 1.0]].map(Vector3::from);
    let found = tetrahedron_distributions(&TetrahedralMesh::new(vertices.to_vec(), vec![[0, 1, 2, 3]]));
    let best = [(1.0_f64 / 3.0).acos().to_degrees(), 1.0, 1.0, 6.0_f64.sqrt() / 4.0];
    for (distribution, best) in found.iter().zip(best) {
        assert_relative_eq!(distribution.quantile(0.0), best, max_relative = 1e-13);
        assert_relative_eq!(distribution.quantile(1.0), best, max_relative = 1e-13);
    }
    assert_eq!(found.iter().map(Distribution::count).collect::<Vec<_>>(), [6, 1, 1, 1, 0]);
}

#[test]
fn the_corner_of_a_cube_has_the_values_of_its_inscribed_and_circumscribed_spheres() {
    let vertices = vec![Vector3::zeros(), Vector3::x(), Vector3::y(), Vector3::z()];
    let found = tetrahedron_distributions(&TetrahedralMesh::new(vertices, vec![[0, 1, 2, 3]]));
    let r = 1.0 / (3.0 + 3.0_f64.sqrt());
    assert_relative_eq!(found[2].quantile(0.5), 2.0_f64.sqrt() / (2.0 * 6.0_f64.sqrt() * r), max_relative = 1e-13);
    assert_relative_eq!(found[3].quantile(0.5), 3.0_f64.sqrt() / 2.0, max_relative = 1e-13);
}

#[test]
fn neighbours_of_different_size_have_the_ratio_of_their_heights() {
    let mut vertices = vec![Vector3::zeros(), Vector3::x(), Vector3::y(), Vector3::z(), -4.0 * Vector3::z()];
    vertices[4].x = 0.3;
    let mesh = TetrahedralMesh::new(vertices, vec![[0, 1, 2, 3], [0, 2, 1, 4]]);
    let ratios = &tetrahedron_distributions(&mesh)[4];
    assert_eq!(ratios.count(), 1);
    assert_relative_eq!(ratios.quantile(0.5), 4.0, max_relative = 1e-14);
    // 48 tetrahedra have 192 faces, 48 of them on the boundary.
    assert_eq!(tetrahedron_distributions(&box_mesh([1.0; 3], 2, Pattern::Alternating).unwrap())[4].count(), 72);
}

#[test]
fn the_radius_of_a_triangle_belongs_to_its_smallest_angle() {
    let vertices = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.2, 0.4, 0.0], [0.5, 0.0, 0.0]].map(Vector3::from);
    let found = triangle_distributions(&SurfaceMesh::new(vertices.to_vec(), vec![[0, 1, 2], [0, 3, 1]]));
    assert_eq!(found[0].count(), 1, "the second triangle is flat");
    let angle = found[0].quantile(0.5).to_radians();
    assert_relative_eq!(found[2].quantile(0.5), 0.5 / angle.sin(), max_relative = 1e-13);
}

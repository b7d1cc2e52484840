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

fn some() -> Distribution {
    let values = [3.0, 1.0, 0.5, f64::NAN, 9.0, 1.5, f64::INFINITY];
    Distribution::new("ratio", "", vec![0.0, 1.0, 2.0, 4.0], f64::INFINITY, values.into_iter())
}

#[test]
fn a_quantile_is_a_value_that_the_share_does_not_exceed() {
    let found = [0.0, 0.2, 0.21, 0.5, 1.0].map(|part| some().quantile(part));
    assert_eq!(found, [0.5, 0.5, 1.0, 1.5, 9.0]);
    let of = |values: &mut dyn Iterator<Item = f64>| Distribution::new("", "", vec![0.0], 1.0, values);
    assert!(of(&mut std::iter::empty()).quantile(0.5).is_nan());
    let many = of(&mut (1..=200).map(f64::from));
    let found = [many.quantile(0.99), many.quantile(0.5), of(&mut [1.0].into_iter()).quantile(0.5)];
    assert_eq!(found, [198.0, 100.0, 1.0]);
}

#[test]
fn a_value_at_the_end_of_a_bin_belongs_to_the_next() {
    assert_eq!(some().counts(), [1, 2, 1, 1]);
    assert_eq!(some().counts().iter().sum::<usize>(), some().count());
}

#[test]
fn histograms_have_a_line_for_each_bin_up_to_the_last_that_is_used() {
    let text = some().to_string();
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!(lines[0], "ratio");
    assert_eq!(lines[1], format!("     0 … 1            1  20.00 %  {}", "█".repeat(20)));
    assert_eq!(lines[4], format!("     4 …              1  20.00 %  {}", "█".repeat(20)));
    // Whatever is not zero can be seen.
    let values = std::iter::once(1.5).chain(std::iter::repeat_n(0.5, 9999));
    let uneven = Distribution::new("", "", vec![0.0, 1.0], 2.0, values).to_string();
    assert!(uneven.ends_with(" %  ▏\n"), "{uneven}");
    let empty = Distribution::new("x", "°", vec![0.0, 1.0], 2.0, std::iter::empty());
    assert_eq!(empty.to_string(), "x, °\n    no values\n");
}

//! Surfaces that are turned outwards.

use fem_mesh::{Pattern, SurfaceMesh, boundary, box_mesh, oriented, surface_quality};
use nalgebra::Vector3;

fn cube() -> SurfaceMesh {
    let mesh = box_mesh([1.0; 3], 4, Pattern::Alternating).unwrap();
    SurfaceMesh::new(mesh.vertices.clone(), boundary(&mesh))
}

#[test]
fn each_part_is_turned_as_most_of_its_area_was() {
    let (mut surface, count) = (cube(), cube().vertices.len());
    // A cavity, whose triangles look inwards.
    surface.vertices.extend(cube().vertices.iter().map(|x| 0.5 * x + Vector3::repeat(0.25)));
    surface.elements.extend(cube().elements.iter().map(|&[a, b, c]| [a + count, c + count, b + count]));
    let whole = surface.clone();
    assert_eq!(oriented(&whole), whole);
    surface.elements.iter_mut().enumerate().filter(|(i, _)| i % 5 < 2).for_each(|(_, triangle)| triangle.swap(1, 2));
    assert!(surface_quality(&surface).flipped_edges > 50);
    let found = surface_quality(&oriented(&surface));
    assert!(found.is_closed() && (found.volume - 0.875).abs() < 1e-14, "{found}");
}

#[test]
fn edges_of_three_triangles_and_strips_with_a_twist_are_no_obstacle() {
    let mut surface = cube();
    let [a, b, _] = surface.elements[0];
    surface.vertices.push(Vector3::repeat(3.0));
    surface.elements.push([a, b, surface.vertices.len() - 1]);
    assert_eq!(oriented(&surface), surface);
    let strip: Vec<[usize; 3]> = (0..7).map(|i| [i % 7, (i + 1) % 7, (i + 2) % 7]).collect();
    let strip = SurfaceMesh::new((0..7).map(|i| Vector3::new(i as f64, (i * i) as f64, 0.0)).collect(), strip);
    assert_eq!(oriented(&strip).elements.len(), 7);
}

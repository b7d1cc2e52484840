//! Whether surfaces are closed, and their measures.

use approx::assert_relative_eq;
use fem_mesh::{Pattern, SurfaceMesh, boundary, box_mesh, surface_quality};
use nalgebra::Vector3;

fn cube() -> SurfaceMesh {
    let mesh = box_mesh([1.0, 1.0, 1.0], 2, Pattern::Alternating).unwrap();
    SurfaceMesh::new(mesh.vertices.clone(), boundary(&mesh))
}

#[test]
fn the_surface_of_a_cube_is_closed_and_has_its_area_volume_and_angles() {
    let found = surface_quality(&cube());
    assert!(found.is_closed());
    assert_relative_eq!(found.area, 6.0, max_relative = 1e-14);
    assert_relative_eq!(found.volume, 1.0, max_relative = 1e-14);
    assert_eq!((found.euler_characteristic, found.parts, found.flat_triangles), (2, 1, 0));
    assert_relative_eq!(found.angles[0], 45.0, max_relative = 1e-14);
    assert_relative_eq!(found.angles[1], 90.0, max_relative = 1e-14);
    assert_relative_eq!(found.worst_radius_to_edge, 0.5_f64.sqrt(), max_relative = 1e-14);
    assert_relative_eq!(found.edges[1], 0.5_f64.sqrt(), max_relative = 1e-14);
}

#[test]
fn an_equilateral_triangle_has_the_best_ratio_and_open_edges() {
    let corners = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(Vector3::from);
    let found = surface_quality(&SurfaceMesh::new(corners.to_vec(), vec![[0, 1, 2]]));
    assert_relative_eq!(found.worst_radius_to_edge, 1.0 / 3.0_f64.sqrt(), max_relative = 1e-14);
    assert_eq!((found.open_edges, found.is_closed()), (3, false));
    assert!(found.to_string().contains("not closed"));
}

#[test]
fn holes_flipped_triangles_and_third_triangles_at_an_edge_are_counted() {
    let mut open = cube();
    open.elements.pop();
    assert_eq!(surface_quality(&open).open_edges, 3);
    let mut flipped = cube();
    flipped.elements[0].swap(0, 1);
    assert_eq!(surface_quality(&flipped).flipped_edges, 3);
    let mut branching = cube();
    let [a, b, _] = branching.elements[0];
    branching.vertices.push(Vector3::repeat(3.0));
    branching.elements.push([a, b, branching.vertices.len() - 1]);
    assert_eq!(surface_quality(&branching).branching_edges, 1);
    assert!(!surface_quality(&branching).is_closed());
    assert!(!surface_quality(&branching).is_manifold());
    let mut touching = cube();
    let count = touching.vertices.len();
    touching.vertices.extend(cube().vertices.iter().map(|x| x + Vector3::repeat(1.0)));
    touching.elements.extend(cube().elements.iter().map(|element| element.map(|i| i + count)));
    assert!(surface_quality(&touching).is_manifold());
    // The corner in which the two cubes touch becomes one vertex.
    let corner = |x: f64| touching.vertices.iter().position(|y| *y == Vector3::repeat(x)).unwrap();
    let (last, first) = (corner(1.0), count + corner(0.0));
    touching.elements.iter_mut().flatten().filter(|i| **i == first).for_each(|i| *i = last);
    let found = surface_quality(&touching);
    assert_eq!((found.branching_vertices, found.branching_edges, found.parts), (1, 0, 1));
    assert!(found.is_closed() && !found.is_manifold());
    let mut flat = cube();
    flat.elements.push([a, b, a]);
    assert_eq!(surface_quality(&flat).flat_triangles, 1);
}

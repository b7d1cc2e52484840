//! Rectangles; `box_rule` has the boxes.

use fem_mesh::{Pattern, area_vector, check_plane, rectangle_mesh};

#[test]
fn a_rectangle_has_two_triangles_to_a_cell_and_its_area() {
    let mesh = rectangle_mesh([2.0, 0.75], 4, Pattern::Alternating).unwrap();
    assert_eq!((mesh.vertices.len(), mesh.elements.len()), (36, 48));
    check_plane(&mesh, "rectangle".as_ref()).unwrap();
    let area: f64 = mesh.elements.iter().map(|e| area_vector(e.map(|i| mesh.vertices[i])).z).sum();
    assert!((area - 1.5).abs() < 1e-14);
}

#[test]
fn the_diagonals_of_four_squares_meet_in_their_common_node_and_those_of_kuhn_s_pattern_are_parallel() {
    let elements = |pattern| rectangle_mesh([2.0, 2.0], 1, pattern).unwrap().elements;
    let kuhn = [[0, 1, 4], [0, 4, 3], [1, 2, 5], [1, 5, 4], [3, 4, 7], [3, 7, 6], [4, 5, 8], [4, 8, 7]];
    assert_eq!(elements(Pattern::Kuhn), kuhn);
    assert!(elements(Pattern::Alternating).iter().all(|triangle| triangle.contains(&4)));
}

#[test]
fn sizes_that_are_no_whole_cells_and_too_many_cells_are_refused_with_their_counts() {
    let error = |size, cells| rectangle_mesh(size, cells, Pattern::Alternating).unwrap_err().to_string();
    assert!(error([1.0, 0.3], 4).contains("along y"));
    assert!(error([1e6, 1e6], 1000).contains("2e18 triangles"));
}

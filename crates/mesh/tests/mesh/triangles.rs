//! Regions in the plane: constrained Delaunay triangulation, and improvement of triangles.

use fem_mesh::generate::delaunay::{DelaunayError, triangulate_region};
use fem_mesh::generate::odt::improve_triangles;
use fem_mesh::{Mesh, MeshSet, triangle_quality};
use nalgebra::Vector2;
use proptest::prelude::*;
use robust::{Coord, incircle};

use crate::fixed_seed;

fn circle(radius: f64, points: usize, shift: Vector2<f64>) -> Vec<Vector2<f64>> {
    let at = |i: usize| std::f64::consts::TAU * i as f64 / points as f64;
    (0..points).map(|i| shift + radius * Vector2::new(at(i).cos(), at(i).sin())).collect()
}

/// Inner edges whose opposite vertices violate the condition of Delaunay, by exact signs.
fn violations(mesh: &Mesh<2, 3>) -> usize {
    let mut sides = std::collections::HashMap::new();
    for &[a, b, c] in &mesh.elements {
        sides.extend([([a, b], c), ([b, c], a), ([c, a], b)]);
    }
    let at = |i: usize| Coord { x: mesh.vertices[i].x, y: mesh.vertices[i].y };
    let is_violated = |(&[a, b], &apex): (&[usize; 2], &usize)| {
        sides.get(&[b, a]).is_some_and(|&beyond| incircle(at(a), at(b), at(apex), at(beyond)) > 0.0)
    };
    sides.iter().filter(|side| is_violated(*side)).count()
}

proptest! {
    #![proptest_config(fixed_seed(60))]

    #[test]
    fn a_star_with_a_hole_has_a_delaunay_triangulation_with_its_area_and_edges(
        radii in prop::collection::vec(0.5..2.0_f64, 5..60),
        hole in prop::collection::vec(0.1..0.3_f64, 3..20),
    ) {
        let star = |radii: &[f64]| {
            let unit = circle(1.0, radii.len(), Vector2::zeros());
            unit.iter().zip(radii).map(|(x, radius)| x * *radius).collect::<Vec<_>>()
        };
        let (outer, inner) = (star(&radii), star(&hole));
        // Edges of the outer star may come nearer to the centre than its corners.
        let nearest = radii.iter().copied().fold(f64::INFINITY, f64::min) * (std::f64::consts::PI / radii.len() as f64).cos();
        prop_assume!(nearest > 0.31);
        let area = |points: &[Vector2<f64>]| (0..points.len()).map(|i| 0.5 * points[i].perp(&points[(i + 1) % points.len()])).sum::<f64>();
        let expected = area(&outer) - area(&inner);
        let mesh = triangulate_region(&[outer.clone(), inner.clone()]).unwrap();
        prop_assert!((triangle_quality(&mesh).area - expected).abs() < 1e-12);
        prop_assert_eq!(mesh.elements.len(), outer.len() + inner.len());
        prop_assert_eq!(violations(&mesh), 0);
        prop_assert_eq!(mesh.vertices, [outer, inner].concat());
    }
}

#[test]
fn polygons_that_cross_touch_or_have_no_area_are_refused() {
    let square = circle(1.0, 4, Vector2::zeros());
    let moved = circle(1.0, 4, Vector2::new(0.5, 0.1));
    assert!(matches!(triangulate_region(&[square.clone(), moved]), Err(DelaunayError::Crossing { .. })));
    let touching = [[1.0, 0.0], [2.0, -1.0], [3.0, 0.0], [2.0, 1.0]].map(Vector2::from).to_vec();
    assert!(matches!(triangulate_region(&[square.clone(), touching]), Err(DelaunayError::Crossing { .. })));
    let flat = [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0]].map(Vector2::from).to_vec();
    assert!(triangulate_region(&[flat]).is_err());
    assert!(matches!(triangulate_region(&[]), Err(DelaunayError::Flat { .. })));
    let mut nan = square;
    nan[2].x = f64::NAN;
    assert_eq!(triangulate_region(&[nan]), Err(DelaunayError::NotFinite { point: 2 }));
}

/// A grid of squares with moved inner nodes and nodes on its sides.
fn grid(n: usize, random: &[f64]) -> Mesh<2, 3> {
    let mut random = random.iter().cycle();
    let mut vertices = Vec::new();
    for j in 0..=n {
        for i in 0..=n {
            let mut moved = |on_side: bool| if on_side { 0.0 } else { 0.3 * random.next().unwrap() };
            let x = Vector2::new(i as f64 + moved(i == 0 || i == n), j as f64 + moved(j == 0 || j == n));
            vertices.push(x / n as f64);
        }
    }
    let node = |i: usize, j: usize| i + j * (n + 1);
    let cells = (0..n * n).map(|k| (k % n, k / n));
    let elements = cells.flat_map(|(i, j)| {
        [[node(i, j), node(i + 1, j), node(i + 1, j + 1)], [node(i, j), node(i + 1, j + 1), node(i, j + 1)]]
    });
    Mesh::new(vertices, elements.collect())
}

proptest! {
    #![proptest_config(fixed_seed(40))]

    #[test]
    fn improved_triangles_keep_their_square_and_are_never_worse(
        n in 2..14_usize,
        random in prop::collection::vec(-1.0..1.0_f64, 200),
    ) {
        let mesh = grid(n, &random);
        let (before, improved) = (triangle_quality(&mesh), improve_triangles(&mesh, 12).unwrap());
        let after = triangle_quality(&improved.mesh);
        prop_assert!(after.radius_to_edge.value <= before.radius_to_edge.value * (1.0 + 1e-12));
        prop_assert!((after.area - 1.0).abs() < 1e-12);
        prop_assert_eq!((after.vertices, after.triangles), (before.vertices, before.triangles));
        for pair in improved.steps.windows(2) {
            prop_assert!(pair[1].energy <= pair[0].energy * (1.0 + 1e-12));
        }
        let corners = [0, n, n * (n + 1), (n + 1) * (n + 1) - 1];
        prop_assert!(corners.iter().all(|&corner| improved.mesh.vertices[corner] == mesh.vertices[corner]));
        prop_assert!(improved.mesh.vertices[..=n].iter().all(|x| x.y == 0.0), "nodes slide along the side");
    }
}

#[test]
fn improvement_makes_a_disturbed_grid_much_better() {
    let random: Vec<f64> = (0..400).map(|i| ((i * i * 37 % 101) as f64 / 50.0) - 1.0).collect();
    let mesh = grid(14, &random);
    let improved = improve_triangles(&mesh, 30).unwrap();
    let (first, last) = (improved.steps[0], improved.steps[improved.steps.len() - 1]);
    assert!(last.smallest_angle > 2.0 * first.smallest_angle, "{first:?} {last:?}");
    assert!(last.median_radius_to_edge < first.median_radius_to_edge - 0.05, "{first:?} {last:?}");
}

#[test]
fn improvement_keeps_the_line_between_two_sets_and_the_points_of_a_third() {
    let mut mesh = grid(8, &[0.7, -0.4, 0.9, -0.8, 0.1]);
    // Nodes in the middle column stand on one line, which divides the sets.
    for j in 0..=8 {
        mesh.vertices[4 + 9 * j].x = 0.5;
    }
    let is_left = |element: &[usize; 3]| element.iter().all(|node| node % 9 <= 4);
    let left: Vec<usize> = (0..mesh.elements.len()).filter(|&i| is_left(&mesh.elements[i])).collect();
    mesh.sets.insert("left".to_owned(), MeshSet { elements: left.clone(), ..MeshSet::default() });
    mesh.sets.insert("probe".to_owned(), MeshSet { points: vec![20], ..MeshSet::default() });
    let improved = improve_triangles(&mesh, 10).unwrap().mesh;
    assert_eq!(improved.sets, mesh.sets);
    assert_eq!(improved.vertices[20], mesh.vertices[20]);
    assert_ne!(improved.vertices[21], mesh.vertices[21]);
    let area: f64 = left
        .iter()
        .map(|&element| {
            let [a, b, c] = improved.elements[element].map(|i| improved.vertices[i]);
            assert!([a, b, c].iter().all(|x| x.x <= 0.5));
            0.5 * (b - a).perp(&(c - a))
        })
        .sum();
    assert!((area - 0.5).abs() < 1e-12, "{area}");
}

#[test]
fn an_edge_of_three_triangles_is_refused() {
    let corners = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [0.5, 1.0], [0.5, -1.0]].map(Vector2::from);
    let mesh = Mesh::new(corners.to_vec(), vec![[0, 1, 2], [0, 1, 3], [1, 0, 4]]);
    let error = improve_triangles(&mesh, 3).unwrap_err();
    assert_eq!(error.vertices, [0, 1]);
}

//! Properties of every element.

use std::collections::{BTreeSet, HashMap};

use fem_mesh::{Pattern, box_mesh, rectangle_mesh};
use fem_model::element::Element;
use fem_model::simulation::Shape;
use fem_model::{BodyMesh, with_elements};
use nalgebra::{Matrix3, Vector3};

/// An irregular body of these elements.
fn body(element: &Element) -> BodyMesh {
    let linear = match element.dimension {
        2 => BodyMesh::flat(rectangle_mesh([2.0, 1.0], 2, Pattern::Alternating).unwrap(), 0.1),
        _ => BodyMesh::solid(box_mesh([2.0, 1.0, 1.0], 2, Pattern::Alternating).unwrap()),
    };
    linear.of_order(element.order).unwrap()
}

/// Barycentric coordinates of each node.
fn places(element: &Element) -> Vec<Vec<f64>> {
    let at = |of: &[usize]| {
        (0..element.corners()).map(|i| of.iter().filter(|&&k| k == i).count() as f64 / of.len() as f64).collect()
    };
    (0..element.corners()).map(|corner| at(&[corner])).chain(element.edges.iter().map(|edge| at(edge))).collect()
}

/// Barycentric coordinates of a few points inside.
fn inside(element: &Element) -> Vec<Vec<f64>> {
    let point = |k: usize| {
        let L: Vec<f64> = (0..element.corners()).map(|i| 1.0 + ((5 * k + 3 * i) % 7) as f64).collect();
        let sum: f64 = L.iter().sum();
        L.into_iter().map(|L| L / sum).collect()
    };
    (0..5).map(point).collect()
}

fn centroid(mesh: &BodyMesh, nodes: &[usize]) -> Vector3<f64> {
    nodes.iter().map(|&node| mesh.vertices()[node]).sum::<Vector3<f64>>() / nodes.len() as f64
}

#[test]
fn no_two_elements_have_the_same_dimension_and_order_and_each_has_its_loops() {
    let kinds: BTreeSet<_> = Element::ALL.iter().map(|element| (element.dimension, element.order)).collect();
    assert_eq!(kinds.len(), Element::ALL.len());
    for element in Element::ALL {
        let mesh = body(element);
        assert_eq!(mesh.element(), element);
        assert_eq!(with_elements!(&mesh, elements => elements[0].to_vec()), mesh.nodes_of(0));
        assert_eq!(mesh.nodes_of(0).len(), element.nodes());
    }
}

#[test]
fn a_shape_function_is_one_at_its_node_and_zero_at_the_others_and_all_add_up_to_one() {
    for element in Element::ALL {
        for (node, place) in places(element).iter().enumerate() {
            let expected: Vec<f64> = (0..element.nodes()).map(|i| f64::from(i == node)).collect();
            assert_eq!(element.values(place), expected, "{}", element.name);
        }
        for L in inside(element) {
            assert!((element.values(&L).iter().sum::<f64>() - 1.0).abs() < 1e-15, "{}", element.name);
        }
    }
}

#[test]
fn gradients_are_those_of_finite_differences() {
    for element in Element::ALL {
        // Coordinates in which the barycentric ones are 1 − Σ x, x, y, z.
        let unit = |axis: usize| std::array::from_fn::<f64, 3, _>(|j| f64::from(j == axis && j < element.dimension));
        let first = unit(0).map(|_| -1.0);
        let corners: Vec<_> = std::iter::once(first).chain((0..element.dimension).map(unit)).collect();
        for L in inside(element) {
            let gradients = element.gradients(&corners, &L);
            for axis in 0..element.dimension {
                let h = 1e-5;
                let at = |h: f64| {
                    let mut L = L.clone();
                    (L[0], L[axis + 1]) = (L[0] - h, L[axis + 1] + h);
                    element.values(&L)
                };
                let differences = at(h).into_iter().zip(at(-h)).map(|(after, before)| (after - before) / (2.0 * h));
                for (gradient, difference) in gradients.iter().zip(differences) {
                    assert!((gradient[axis] - difference).abs() < 1e-9, "{}: {gradient:?} {difference}", element.name);
                }
            }
        }
    }
}

#[test]
fn the_quadrature_is_exact_for_products_of_two_gradients() {
    let factorial = |n: usize| (1..=n).product::<usize>() as f64;
    for element in Element::ALL {
        let degree = 2 * (element.order - 1);
        for powers in (0..3_usize.pow(element.corners() as u32))
            .map(|code| (0..element.corners()).map(|i| code / 3_usize.pow(i as u32) % 3).collect::<Vec<_>>())
        {
            if powers.iter().sum::<usize>() > degree {
                continue;
            }
            let value = |L: &&[f64]| L.iter().zip(&powers).map(|(L, &power)| L.powi(power as i32)).product::<f64>();
            let found = element.points.iter().map(value).sum::<f64>() / element.points.len() as f64;
            let exact = factorial(element.dimension) * powers.iter().map(|&power| factorial(power)).product::<f64>()
                / factorial(element.dimension + powers.iter().sum::<usize>());
            assert!((found - exact).abs() < 1e-15, "{} {powers:?}: {found} {exact}", element.name);
        }
    }
}

#[test]
fn faces_look_outward_and_close_the_element() {
    for element in Element::ALL {
        let mesh = body(element);
        for number in 0..mesh.elements() {
            let (nodes, middle) = (mesh.nodes_of(number), centroid(&mesh, mesh.corners_of(number)));
            let mut sum = Vector3::zeros();
            for face in element.faces {
                let face: Vec<usize> = face.iter().map(|&node| nodes[node]).collect();
                let area = element.area_vector(|i| mesh.vertices()[face[i]]);
                assert!(area.dot(&(centroid(&mesh, &face) - middle)) > 0.0, "{}", element.name);
                sum += area;
            }
            assert!(sum.norm() < 1e-15, "{}", element.name);
        }
    }
}

#[test]
fn the_triangles_that_are_drawn_cover_the_surface_once_with_its_nodes_and_orientation() {
    for element in Element::ALL {
        let mesh = body(element);
        let x = mesh.vertices();
        let triangles = mesh.surface();
        let area = |triangle: &[usize; 3]| fem_mesh::area_vector(triangle.map(|node| x[node]));
        let found: f64 = triangles.iter().map(|triangle| area(triangle).norm()).sum();
        let is_outward = match element.dimension {
            2 => triangles.iter().all(|triangle| area(triangle).z > 0.0),
            // The volume inside, by Gauss's theorem.
            _ => (triangles.iter().map(|t| area(t).dot(&x[t[0]])).sum::<f64>() / 3.0 - 2.0).abs() < 1e-12,
        };
        let expected = if element.dimension == 2 { 2.0 } else { 10.0 };
        assert!((found - expected).abs() < 1e-12 && is_outward, "{}: {found}", element.name);
        let shown: BTreeSet<usize> = triangles.iter().flatten().copied().collect();
        let outer: BTreeSet<usize> = mesh.faces().into_iter().flatten().collect();
        assert!(outer.is_subset(&shown), "{}", element.name);
        for (triangle, element) in triangles.iter().zip(mesh.elements_of_surface()) {
            assert!(triangle.iter().all(|node| mesh.nodes_of(element).contains(node)));
        }
    }
}

#[test]
fn the_faces_of_a_body_are_its_boundary() {
    for element in Element::ALL {
        let mesh = body(element);
        let faces = mesh.faces();
        let found: f64 = faces.iter().map(|face| mesh.area(face)).sum();
        let expected = if element.dimension == 2 { 0.1 * 6.0 } else { 10.0 };
        assert!((found - expected).abs() < 1e-12, "{}: {found}", element.name);
        assert!(faces.iter().all(|face| face.len() == element.faces[0].len()));
        let shape = Shape { boundary: mesh.surface(), mesh, display: None, picture: None };
        assert_eq!(shape.faces(), faces);
    }
}

#[test]
fn neighbours_share_the_nodes_at_the_middles_of_their_common_edges() {
    for element in Element::ALL {
        let mesh = body(element);
        let mut middles: HashMap<[usize; 2], usize> = HashMap::new();
        for ([a, b], middle) in (0..mesh.elements()).flat_map(|element| mesh.middles_of(element)) {
            assert_eq!(mesh.vertices()[middle], 0.5 * (mesh.vertices()[a] + mesh.vertices()[b]));
            assert_eq!(*middles.entry([a.min(b), a.max(b)]).or_insert(middle), middle);
        }
        let corners: BTreeSet<usize> = (0..mesh.elements()).flat_map(|e| mesh.corners_of(e)).copied().collect();
        assert_eq!(mesh.vertices().len(), corners.len() + middles.len());
    }
}

#[test]
fn the_triangles_between_the_nodes_of_a_quadratic_element_are_those_of_one_refinement() {
    for element in Element::ALL.into_iter().filter(|element| element.order == 2) {
        let quadratic = body(element);
        let is_linear = |linear: &&Element| (linear.dimension, linear.order) == (element.dimension, 1);
        let linear = body(Element::ALL.into_iter().find(is_linear).unwrap());
        let refined = linear.refined(1, "mesh".as_ref()).unwrap();
        assert_eq!(refined.vertices(), quadratic.vertices());
        let sorted = |mesh: &BodyMesh| {
            // A triangle keeps its orientation, whichever corner comes first.
            let first = |[a, b, c]: [usize; 3]| [[a, b, c], [b, c, a], [c, a, b]].into_iter().min().unwrap();
            mesh.surface().into_iter().map(first).collect::<BTreeSet<_>>()
        };
        assert_eq!(sorted(&refined), sorted(&quadratic), "{}", element.name);
    }
}

#[test]
fn faces_and_their_drawn_triangles_have_the_nodes_of_the_flat_element_in_its_order() {
    for element in Element::ALL.into_iter().filter(|element| element.dimension == 3) {
        let is_flat = |flat: &&Element| (flat.dimension, flat.order) == (2, element.order);
        let flat = Element::ALL.into_iter().find(is_flat).unwrap();
        assert_eq!(element.triangles, flat.triangles);
        for face in element.faces {
            for (edge, &middle) in flat.edges.iter().zip(&face[3..]) {
                let mut ends = edge.map(|corner| face[corner]);
                let mut expected = element.edges[middle - element.corners()];
                ends.sort_unstable();
                expected.sort_unstable();
                assert_eq!(ends, expected, "{}", element.name);
            }
        }
    }
}

#[test]
fn parts_of_a_surface_have_the_middles_of_their_edges() {
    for element in Element::ALL {
        let mesh = body(element);
        for face in mesh.faces() {
            let corners = &face[..element.dimension];
            let nodes = match *corners {
                [a, b] => mesh.with_middles(corners.to_vec(), &[[b, a]], &[]),
                [a, b, c] => mesh.with_middles(corners.to_vec(), &[], &[[c, a, b]]),
                _ => unreachable!("a face is an edge or a triangle"),
            };
            assert_eq!(nodes.into_iter().collect::<BTreeSet<_>>(), face.into_iter().collect(), "{}", element.name);
        }
    }
}

#[test]
fn the_displacement_gradient_is_the_mean_of_those_at_the_quadrature_points() {
    for element in Element::ALL {
        let mesh = body(element);
        let u = |node: usize| {
            let x = mesh.vertices()[node];
            Vector3::new(x.x * x.y, 0.3 * x.y * x.y - x.x, if element.dimension == 3 { x.z * x.x } else { 0.0 })
        };
        for number in 0..mesh.elements() {
            let corners = mesh.corners_of(number);
            let edge = |k: usize| match corners.get(k) {
                Some(&corner) => mesh.vertices()[corner] - mesh.vertices()[corners[0]],
                None => Vector3::z(),
            };
            let inverse = Matrix3::from_columns(&[edge(1), edge(2), edge(3)]).try_inverse().unwrap();
            let others: Vec<[f64; 3]> = (0..element.dimension).map(|k| [0, 1, 2].map(|j| inverse[(k, j)])).collect();
            let first = [0, 1, 2].map(|j| -others.iter().map(|other| other[j]).sum::<f64>());
            let of_corners: Vec<_> = std::iter::once(first).chain(others).collect();
            let at = |L: &&[f64]| -> Matrix3<f64> {
                let gradients = element.gradients(&of_corners, L);
                let terms = mesh.nodes_of(number).iter().zip(&gradients);
                terms.map(|(&node, gradient)| u(node) * Vector3::from(*gradient).transpose()).sum()
            };
            let mean = element.points.iter().map(at).sum::<Matrix3<f64>>() / element.points.len() as f64;
            let found = mesh.displacement_gradient(number, u);
            assert!((found - mean).amax() < 1e-13, "{}: {found} {mean}", element.name);
        }
    }
}

/// A body of one element with corners at the origin and on the axes.
fn single(element: &Element) -> BodyMesh {
    let x = (0..element.corners()).map(|i| Vector3::from_fn(|j, _| f64::from(i == j + 1))).collect();
    let mesh = match element.dimension {
        2 => BodyMesh::flat(fem_mesh::Mesh::new(x, vec![[0, 1, 2]]), 1.0),
        _ => BodyMesh::solid(fem_mesh::Mesh::new(x, vec![[0, 1, 2, 3]])),
    };
    mesh.of_order(element.order).unwrap()
}

#[test]
fn the_bound_of_det_F_finds_an_inversion_that_no_quadrature_point_sees() {
    for element in Element::ALL.into_iter().filter(|element| element.order == 2) {
        let mesh = single(element);
        let edge = element.corners() + element.edges.iter().position(|&edge| edge == [0, 1]).unwrap();
        // With the middle of the edge along x moved by d, det F at the first corner is 1 − 4 d.
        for (d, is_inverted) in [(0.24, false), (0.26, true)] {
            let u = |node: usize| if node == edge { Vector3::new(-d, 0.0, 0.0) } else { Vector3::zeros() };
            let at = |L: &[f64]| (Matrix3::identity() + mesh.displacement_gradient_at(0, L, u)).determinant();
            assert!(element.points.iter().all(|L| at(L) > 0.4), "{}", element.name);
            let bound = mesh.least_det_F(0, u);
            assert!(
                (bound - (1.0 - 4.0 * d)).abs() < 1e-14 && (bound < 0.0) == is_inverted,
                "{}: {bound}",
                element.name
            );
        }
    }
}

#[test]
fn the_bound_of_det_F_is_its_value_where_the_deformation_is_uniform_and_below_it_elsewhere() {
    for element in Element::ALL {
        let mesh = body(element);
        let (x, up) = (mesh.vertices(), if element.dimension == 3 { 1.0 } else { 0.0 });
        let uniform =
            |node: usize| Vector3::new(0.1 * x[node].x + 0.3 * x[node].y, -0.2 * x[node].y, up * 0.05 * x[node].z);
        let wavy = |node: usize| {
            let f = |k: f64| 0.03 * (7.0 * x[node].x + 5.0 * x[node].y * k + 3.0 * x[node].z).sin();
            Vector3::new(f(1.0), f(2.0), up * f(3.0))
        };
        for number in 0..mesh.elements() {
            let expected = 1.1 * 0.8 * (1.0 + up * 0.05);
            assert!((mesh.least_det_F(number, uniform) - expected).abs() < 1e-14, "{}", element.name);
            for L in inside(element).iter().chain(&places(element)) {
                let J = (Matrix3::identity() + mesh.displacement_gradient_at(number, L, wavy)).determinant();
                assert!(mesh.least_det_F(number, wavy) <= J + 1e-14, "{}", element.name);
            }
        }
    }
}

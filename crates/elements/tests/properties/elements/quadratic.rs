//! Quadratic triangles.

use nalgebra::Vector3;

use super::{Case, blocks_of_both_kinds_are_alike, case_of, converges, largest, law, product_without_a_matrix, random};
use fem_elements::elements::Elements;
use fem_elements::materials::{Law, Linear};
use fem_elements::tensor::Tensor;
use fem_mesh::{Pattern, SurfaceMesh, rectangle_mesh};
use fem_model::BodyMesh;

/// Quadrature points of a triangle.
const POINTS: usize = 3;

/// Triangles of 2 × 1 m whose inner nodes are displaced, and whose triangles begin at different corners.
fn irregular(cells: usize) -> SurfaceMesh {
    let mut mesh = rectangle_mesh([2.0, 1.0], cells, Pattern::Alternating).unwrap();
    let mut random = random(3);
    for x in &mut mesh.vertices {
        if x.x > 0.0 && x.x < 2.0 && x.y > 0.0 && x.y < 1.0 {
            *x += 0.2 / cells as f64 * Vector3::new(random(), random(), 0.0);
        }
    }
    mesh.elements.iter_mut().enumerate().for_each(|(i, element)| element.rotate_left(i % 3));
    mesh
}

fn quadratic(linear: SurfaceMesh) -> BodyMesh {
    BodyMesh::flat(linear, 1.0).of_order(2).unwrap()
}

fn triangles(mesh: &BodyMesh) -> Case<2, 5, 6> {
    let elements: Vec<[u32; 6]> = mesh.arrays().unwrap().iter().map(|nodes| nodes.map(|node| node as u32)).collect();
    let x = mesh.vertices();
    case_of(x, &elements, |pattern| Elements::at_points(mesh.element(), x, &elements, &[], pattern))
}

fn sample() -> Case<2, 5, 6> {
    triangles(&quadratic(irregular(2)))
}

#[test]
fn energy_gradient_and_stiffness_of_quadratic_triangles_belong_together() {
    converges(&Case { u: sample().u.iter().map(|u| u.map(|u| 0.3 * u)).collect(), ..sample() });
}

#[test]
fn products_and_blocks_of_quadratic_triangles_are_those_of_their_matrix() {
    product_without_a_matrix(&sample());
    blocks_of_both_kinds_are_alike(&sample(), law::<f64>());
}

/// Displacements at the nodes of u(x, y), and the displacement gradients that the elements find, with their places.
fn gradients(mesh: &BodyMesh, u: impl Fn(f64, f64) -> [f64; 2]) -> Vec<([f64; 2], Tensor<f64>)> {
    let at = |x: &Vector3<f64>| u(x.x, x.y);
    let u: Vec<[f64; 3]> = mesh.vertices().iter().map(|x| [at(x)[0], at(x)[1], 0.0]).collect();
    let mut found = Vec::new();
    triangles(mesh).elements.for_each_gradient(&u, |point, _, G| {
        let place = mesh.points(point / POINTS)[point % POINTS];
        found.push(([place.x, place.y], *G));
    });
    assert_eq!(found.len(), POINTS * mesh.elements());
    found
}

#[test]
fn a_quadratic_displacement_has_its_exact_gradient_at_every_quadrature_point() {
    let mesh = quadratic(irregular(2));
    let u = |x: f64, y: f64| [0.1 + 0.2 * x - y + x * x - 0.5 * x * y, 0.3 * y * y + x * y - 0.7 * x * x];
    for ([x, y], G) in gradients(&mesh, u) {
        let exact = [[0.2 + 2.0 * x - 0.5 * y, -1.0 - 0.5 * x], [y - 1.4 * x, 0.6 * y + x]];
        for i in 0..2 {
            (0..2).for_each(|j| assert!((G[i][j] - exact[i][j]).abs() < 1e-13, "{G:?} {exact:?}"));
        }
    }
    // A cubic one has not.
    let wrong =
        gradients(&mesh, |x, _| [x * x * x, 0.0]).into_iter().any(|([x, _], G)| (G[0][0] - 3.0 * x * x).abs() > 1e-3);
    assert!(wrong);
}

#[test]
fn a_rigid_motion_of_quadratic_triangles_has_no_forces() {
    let mesh = quadratic(irregular(2));
    let elements = triangles(&mesh).elements;
    let (sin, cos) = 2.1_f64.sin_cos();
    let turned = |x: &Vector3<f64>| [cos * x.x - sin * x.y - x.x + 5.0, sin * x.x + cos * x.y - x.y - 3.0, 0.0];
    let sheared = |x: &Vector3<f64>| [x.y, 0.0, 0.0];
    let [of_turned, of_sheared] = [&turned as &dyn Fn(&Vector3<f64>) -> [f64; 3], &sheared].map(|motion| {
        let u: Vec<[f64; 3]> = mesh.vertices().iter().map(motion).collect();
        let mut gradient = vec![[0.0; 3]; u.len()];
        elements.add_gradient(&law::<f64>(), &u, &mut gradient);
        largest(&gradient)
    });
    assert!(of_turned < 1e-12 * of_sheared, "{of_turned:e} {of_sheared:e}");
}

#[test]
fn the_rule_integrates_the_energy_of_a_linear_law_exactly() {
    let law = Linear { mu: 2.0, lambda: 3.0 };
    let u = |x: &Vector3<f64>| [x.x * x.y + 0.2 * x.x * x.x, x.y * x.y - 0.4 * x.x * x.y, 0.0];
    // Every mesh has the same displacement, so energies differ by errors of integration alone.
    let energy = |linear: SurfaceMesh| {
        let mesh = quadratic(linear);
        triangles(&mesh).elements.energy(&law, &mesh.vertices().iter().map(u).collect::<Vec<_>>())
    };
    let [coarse, fine] = [1, 4].map(|cells| energy(irregular(cells)));
    assert!((coarse - fine).abs() < 1e-13 * fine, "{coarse} {fine}");
    // By hand, ∫ over [0, 2] × [0, 1] of 3/2 (tr ε)² + 2 ε:ε by a product rule.
    let exact = by_gauss(|x, y| {
        let G = [[y + 0.4 * x, x, 0.0], [-0.4 * y, 2.0 * y - 0.4 * x, 0.0], [0.0; 3]];
        law.energy(&G)
    });
    assert!((fine - exact).abs() < 1e-12 * exact, "{fine} {exact}");
}

/// ∫ f over [0, 2] × [0, 1] by the Gauss–Legendre rule of three points.
fn by_gauss(f: impl Fn(f64, f64) -> f64) -> f64 {
    let points = [(-0.6_f64.sqrt(), 5.0 / 18.0), (0.0, 8.0 / 18.0), (0.6_f64.sqrt(), 5.0 / 18.0)];
    let at = |(x, of_x): (f64, f64), (y, of_y): (f64, f64)| 2.0 * of_x * of_y * f(1.0 + x, 0.5 + 0.5 * y);
    points.iter().flat_map(|&x| points.map(|y| at(x, y))).sum()
}

#[test]
fn an_affine_displacement_leaves_inner_nodes_of_an_irregular_mesh_without_force() {
    let mesh = quadratic(irregular(3));
    let u: Vec<[f64; 3]> =
        mesh.vertices().iter().map(|x| [0.3 * x.x - 0.2 * x.y, 0.1 * x.x + 0.25 * x.y, 0.0]).collect();
    let case = triangles(&mesh);
    let mut gradient = vec![[0.0; 3]; u.len()];
    case.elements.add_gradient(&law::<f64>(), &u, &mut gradient);
    let is_inner = |x: &Vector3<f64>| x.x > 1e-9 && x.x < 2.0 - 1e-9 && x.y > 1e-9 && x.y < 1.0 - 1e-9;
    let inner: Vec<[f64; 3]> =
        gradient.iter().zip(mesh.vertices()).filter(|(_, x)| is_inner(x)).map(|(force, _)| *force).collect();
    assert!(inner.len() > 20 && largest(&inner) < 1e-12 * largest(&gradient));
}

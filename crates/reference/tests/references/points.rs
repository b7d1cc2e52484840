//! Points of elements.

use fem_mesh::Mesh;
use fem_model::BodyMesh;
use fem_reference::space::points::points;
use nalgebra::Vector3;

fn factorial(n: i32) -> f64 {
    (1..=n).map(f64::from).product()
}

#[test]
fn polynomials_up_to_the_degree_are_integrated_exactly() {
    let corners = vec![Vector3::zeros(), Vector3::x(), Vector3::y(), Vector3::z()];
    let solid = points(&BodyMesh::solid(Mesh::new(corners.clone(), vec![[0, 1, 2, 3]])));
    let flat = points(&BodyMesh::flat(Mesh::new(corners[..3].to_vec(), vec![[0, 1, 2]]), 1.0));
    let powers =
        (0..512).map(|code| [code / 64, code / 8 % 8, code % 8]).filter(|powers| powers.iter().sum::<i32>() <= 7);
    for [a, b, c] in powers {
        // ∫ x^a y^b z^c over the unit tetrahedron, over its volume, is 6 a! b! c! / (a + b + c + 3)!.
        let monomial = |x: &[f64]| x[0].powi(a) * x[1].powi(b) * x[2].powi(c);
        let found: f64 = solid.iter().map(|point| point.weight * monomial(&point.barycentric)).sum();
        let exact = 6.0 * factorial(a) * factorial(b) * factorial(c) / factorial(a + b + c + 3);
        assert!((found - exact).abs() < 1e-13, "{a} {b} {c}: {found} {exact}");
        // Over a triangle, x^a y^(b + c) of its mean is 2 a! (b + c)! / (a + b + c + 2)!.
        let monomial = |x: &[f64]| x[0].powi(a) * x[1].powi(b + c);
        let found: f64 = flat.iter().map(|point| point.weight * monomial(&point.barycentric)).sum();
        let exact = 2.0 * factorial(a) * factorial(b + c) / factorial(a + b + c + 2);
        assert!((found - exact).abs() < 1e-13, "{a} {b} {c}: {found} {exact}");
    }
}

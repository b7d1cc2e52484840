//! Richardson extrapolation.

use fem_mesh::{Pattern, box_mesh};
use fem_model::element::Element;
use fem_reference::space::manufactured::{self, Exact};
use fem_reference::space::nested::{Level, compare};
use nalgebra::DVector;

/// Interpolant of a known displacement, with an error of second order at the nodes.
fn level(cells: usize) -> Level {
    let mesh = box_mesh([1.0; 3], cells, Pattern::Alternating).unwrap();
    let h = 1.0 / cells as f64;
    let q = mesh.vertices.iter().flat_map(|X| {
        let u = Exact { dimensions: 3 }.displacement(X);
        (0..3).map(move |i| X[i] + u[i] * (1.0 + h * h)).collect::<Vec<_>>()
    });
    Level { cells, q: DVector::from_iterator(3 * mesh.vertices.len(), q), mesh: mesh.into() }
}

#[test]
fn three_levels_give_the_limit_and_the_order() {
    let levels = [4, 8, 16].map(level);
    let estimate = compare(&levels).unwrap();
    assert!((estimate.orders.0 - 2.0).abs() < 1e-9, "{:?}", estimate.orders);
    assert!((estimate.orders.1 - 1.0).abs() < 0.05, "{:?}", estimate.orders);
    for (node, X) in levels[0].mesh.vertices().iter().enumerate() {
        let exact = Exact { dimensions: 3 }.displacement(X);
        assert!((0..3).all(|i| (estimate.limit[3 * node + i] - exact[i]).abs() < 1e-12));
    }
    assert!((estimate.errors[0].1 / estimate.errors[1].1 - 4.0).abs() < 1e-9);
}

#[test]
fn errors_of_gradients_match_the_exact_ones() {
    let levels = [4, 8, 16].map(level);
    let estimate = compare(&levels).unwrap();
    // An interpolant of sin πx sin πy sin πz on this mesh: integrated against the exact gradient.
    let exact = manufactured::solve("linear", Element::ALL[0], 8).unwrap().h1;
    let found = estimate.errors[1].2;
    assert!((found / exact - 1.0).abs() < 0.1, "{found} {exact}");
}

#[test]
fn meshes_that_are_not_nested_have_no_estimate() {
    assert_eq!(compare(&[level(2), level(3), level(4)]), None);
}

//! Manufactured solutions: their body forces, the orders of the elements, estimated errors of stresses.

use fem_engine::materials::AnyLaw;
use fem_engine::simulator::double;
use fem_engine::tensor::{Tensor, from_fn};
use fem_model::element::Element;
use fem_reference::space::manufactured::{Exact, Solved, orders, solve};
use fem_reference::space::points::points;
use nalgebra::{Matrix3, Vector3};

#[test]
fn the_body_force_is_minus_the_divergence_of_the_stress() {
    let all = ["linear", "neo_hookean"].into_iter().flat_map(|model| Element::ALL.map(|element| (model, element)));
    for (model, element) in all {
        let law = AnyLaw::<f64>::new(&solve(model, element, 2).unwrap().material).unwrap();
        let exact = Exact { dimensions: element.dimension };
        let X = Vector3::new(0.31, 0.62, 0.27);
        let stress = |X: &Vector3<f64>| double::law(&law).stress(&exact.gradient(X));
        let h = 1e-5;
        for (i, force) in exact.body_force(&law, &X).into_iter().enumerate() {
            let slope = |j: usize| {
                let step = Vector3::ith(j, h);
                (stress(&(X + step))[i][j] - stress(&(X - step))[i][j]) / (2.0 * h)
            };
            let divergence: f64 = (0..3).map(slope).sum();
            assert!((force + divergence).abs() <= 1e-6 * force.abs(), "{model:?}: {force} {divergence}");
        }
    }
}

#[test]
fn errors_converge_under_refinement() {
    for model in ["linear", "neo_hookean"] {
        let tetrahedra = Element::ALL.into_iter().find(|element| element.dimension == 3).unwrap();
        let [coarse, fine] = [4, 8].map(|cells| solve(model, tetrahedra, cells).unwrap());
        assert!(coarse.l2 / fine.l2 > 3.0 && coarse.h1 / fine.h1 > 1.75, "{} {}", coarse.l2, fine.l2);
    }
}

#[test]
fn elements_have_the_orders_of_their_polynomials() {
    for element in Element::ALL.into_iter().filter(|element| (element.dimension, element.order) != (3, 1)) {
        let models = if element.dimension == 2 { &["neo_hookean"][..] } else { &["linear", "neo_hookean"] };
        for model in models {
            let cells = if element.dimension == 2 { [8, 16] } else { [4, 8] };
            let [coarse, fine] = cells.map(|cells| solve(model, element, cells).unwrap());
            let [l2, h1] = [coarse.l2 / fine.l2, coarse.h1 / fine.h1].map(f64::log2);
            let [in_l2, in_h1] = orders(element);
            assert!((l2 - in_l2).abs() < 0.1 && (h1 - in_h1).abs() < 0.1, "{} {model}: {l2} {h1}", element.name);
        }
    }
}

/// The error of the stresses of a linear law in its energy norm, as a part of the norm of the stresses.
fn true_error(solved: &Solved, exact: Exact) -> f64 {
    let law = AnyLaw::<f64>::new(&solved.material).unwrap();
    let energy = |G: &Tensor<f64>| double::law(&law).energy(G);
    let (mesh, points) = (&solved.mesh, points(&solved.mesh));
    let places = solved.q.as_slice().as_chunks::<3>().0.iter().zip(mesh.vertices());
    let u: Vec<Vector3<f64>> = places.map(|(x, rest)| Vector3::from(*x) - rest).collect();
    let [mut error, mut size] = [0.0; 2];
    for (element, (nodes, volume)) in mesh.corners().zip(mesh.volumes()).enumerate() {
        // The gradient is linear in an element.
        let at_corners: Vec<Matrix3<f64>> = (0..exact.dimensions + 1)
            .map(|corner| {
                let L: [f64; 4] = std::array::from_fn(|i| f64::from(u8::from(i == corner)));
                mesh.displacement_gradient_at(element, &L[..exact.dimensions + 1], |node| u[node])
            })
            .collect();
        for point in &points {
            let is = exact.gradient(&point.place(mesh, nodes));
            let found: Matrix3<f64> = at_corners.iter().zip(&point.barycentric).map(|(G, L)| G * *L).sum();
            error += volume * point.weight * energy(&from_fn(|i, j| found[(i, j)] - is[i][j]));
            size += volume * point.weight * energy(&is);
        }
    }
    (error / size).sqrt()
}

#[test]
fn the_estimated_error_of_the_stresses_approaches_the_true_one() {
    for element in Element::ALL {
        let exact = Exact { dimensions: element.dimension };
        let cells = if element.dimension == 2 { [8, 16] } else { [5, 10] };
        let [coarse, fine] = cells.map(|cells| {
            let solved = solve("linear", element, cells).unwrap();
            solved.stress_error.as_ref().unwrap().relative / true_error(&solved, exact)
        });
        let is_near = (0.8..1.2).contains(&coarse) && (0.95..1.05).contains(&fine);
        assert!(is_near, "{}: {coarse} {fine}", element.name);
    }
}

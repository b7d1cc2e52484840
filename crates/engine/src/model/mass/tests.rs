//! Masses of simplices and of quadratic triangles.

use super::{ElementMass, Mass};
use fem_elements::sparse::{Pattern, Stored};

fn masses() -> [Mass<f64>; 4] {
    let (simplices, triangles) = ([[0, 1, 2, 3], [1, 2, 3, 4]], [[0, 1, 2, 3, 4, 5], [1, 6, 2, 7, 8, 4]]);
    let shares = [16.0 / 57.0, 1.0 / 19.0].map(|share| [share; 3]);
    [
        Mass::lumped(9, &simplices, &[4.0, 2.0], &[0.25; 4]),
        Mass::consistent(9, &simplices, &[4.0, 2.0], &ElementMass::simplex()),
        Mass::lumped(9, &triangles, &[4.0, 2.0], [shares[1], shares[0]].as_flattened()),
        Mass::consistent(9, &triangles, &[4.0, 2.0], &ElementMass::quadratic_triangle()),
    ]
}

#[test]
fn all_masses_weigh_the_same_and_move_alike_in_translation() {
    let v = [[1.0, -2.0, 0.5]; 9];
    for mass in masses() {
        assert!((mass.row_sums().iter().sum::<f64>() - 6.0).abs() < 1e-14);
        assert!((mass.kinetic_energy(&v) - 0.5 * 6.0 * 5.25).abs() < 1e-13);
    }
}

/// ∫ φ_i φ_j over a triangle of unit area by a rule of degree 4 (Strang and Fix, 1973, six points).
fn by_quadrature() -> [[f64; 6]; 6] {
    let (a, b) = (0.445_948_490_915_965, 0.091_576_213_509_771);
    let (of_a, of_b) = (0.223_381_589_678_011, 0.109_951_743_655_322);
    let points = [(a, of_a), (b, of_b)]
        .map(|(x, weight)| [[1.0 - 2.0 * x, x, x], [x, 1.0 - 2.0 * x, x], [x, x, 1.0 - 2.0 * x]].map(|L| (L, weight)));
    let mut sums = [[0.0; 6]; 6];
    for (L, weight) in points.into_iter().flatten() {
        let corner = |i: usize| L[i] * (2.0 * L[i] - 1.0);
        let phi = [corner(0), corner(1), corner(2), 4.0 * L[0] * L[1], 4.0 * L[1] * L[2], 4.0 * L[2] * L[0]];
        for i in 0..6 {
            (0..6).for_each(|j| sums[i][j] += weight * phi[i] * phi[j]);
        }
    }
    sums
}

#[test]
fn the_mass_of_a_quadratic_triangle_is_the_integral_of_products_of_its_shape_functions() {
    let ElementMass(shares) = ElementMass::quadratic_triangle();
    let expected = by_quadrature();
    for (share, expected) in shares.as_flattened().iter().zip(expected.as_flattened()) {
        assert!((share - expected).abs() < 1e-13, "{share} {expected}");
    }
}

#[test]
fn the_lumped_mass_of_a_quadratic_triangle_is_its_scaled_diagonal() {
    let ElementMass(shares) = ElementMass::quadratic_triangle();
    let trace: f64 = (0..6).map(|i| shares[i][i]).sum();
    let mesh = fem_mesh::quadratic(fem_mesh::rectangle_mesh([1.0, 1.0], 1, fem_mesh::Pattern::Alternating).unwrap());
    let lumped = fem_model::BodyMesh::Quadratic { triangles: mesh, thickness: 1.0 }.lumped_mass_shares();
    for i in 0..6 {
        assert!((lumped[i] - shares[i][i] / trace).abs() < 1e-15);
    }
}

#[test]
fn a_matrix_gets_the_mass_of_its_rows() {
    let elements = [[0, 1, 2, 3], [1, 2, 3, 4]];
    let mass = Mass::<f64>::consistent(5, &elements, &[20.0, 40.0], &ElementMass::simplex());
    let pattern = Pattern::new(3, &elements, Stored::Lower);
    let mut values = vec![[[0.0; 3]; 3]; pattern.blocks()];
    mass.add_to(10.0, &pattern, &mut values);
    assert_eq!(values[pattern.find(0, 0).unwrap()][1][1], 20.0);
    assert_eq!(values[pattern.find(2, 1).unwrap()], [[30.0, 0.0, 0.0], [0.0, 30.0, 0.0], [0.0, 0.0, 30.0]]);
}

#[test]
fn the_products_and_the_matrix_of_many_rows_are_those_of_each_row() {
    let nodes = 7000;
    let elements: Vec<[u32; 4]> = (0..nodes as u32 - 3).map(|i| [i, i + 1, i + 2, i + 3]).collect();
    let masses: Vec<f64> = (0..elements.len()).map(|i| 1.0 + (i % 7) as f64).collect();
    let mass = Mass::<f64>::consistent(nodes, &elements, &masses, &ElementMass::simplex());
    let mut product = vec![[0.0; 3]; nodes];
    mass.add_times(2.0, &vec![[1.0, 0.0, -1.0]; nodes], &mut product);
    for (product, sum) in product.iter().zip(mass.row_sums()) {
        assert!((product[0] - 2.0 * sum).abs() < 1e-12 && (product[2] + 2.0 * sum).abs() < 1e-12);
    }
    let pattern = Pattern::new(nodes - 5, &elements, Stored::Lower);
    let mut values = vec![[[0.0; 3]; 3]; pattern.blocks()];
    mass.add_to(2.0, &pattern, &mut values);
    for (block, entry) in pattern.diagonal().zip(mass.diagonal()) {
        assert_eq!(values[block][2][2], 2.0 * entry);
    }
}

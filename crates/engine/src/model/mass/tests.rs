//! Masses of simplices and of quadratic triangles.

use super::Mass;
use fem_elements::sparse::{Pattern, Stored};
use fem_model::element::Element;
use fem_model::element::shares::mass_shares;

/// The mass matrix of the element with `N` nodes.
fn shares<const N: usize>() -> [[f64; N]; N] {
    mass_shares(Element::ALL.into_iter().find(|element| element.nodes() == N).unwrap())
}

fn masses() -> [Mass<f64>; 4] {
    let (simplices, triangles) = ([[0, 1, 2, 3], [1, 2, 3, 4]], [[0, 1, 2, 3, 4, 5], [1, 6, 2, 7, 8, 4]]);
    let lumped = [16.0 / 57.0, 1.0 / 19.0].map(|share| [share; 3]);
    [
        Mass::lumped(9, &simplices, &[4.0, 2.0], &[0.25; 4]),
        Mass::consistent(9, &simplices, &[4.0, 2.0], &shares()),
        Mass::lumped(9, &triangles, &[4.0, 2.0], [lumped[1], lumped[0]].as_flattened()),
        Mass::consistent(9, &triangles, &[4.0, 2.0], &shares()),
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

#[test]
fn a_matrix_gets_the_mass_of_its_rows() {
    let elements = [[0, 1, 2, 3], [1, 2, 3, 4]];
    let mass = Mass::<f64>::consistent(5, &elements, &[20.0, 40.0], &shares());
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
    let mass = Mass::<f64>::consistent(nodes, &elements, &masses, &shares());
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

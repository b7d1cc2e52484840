mod quadratic;
mod quadratic_solids;
mod registers;
mod shares;

use nalgebra::Vector3;

use fem_elements::elements::Elements;
use fem_elements::materials::{Law, NeoHookean, StableNeoHookean};
use fem_elements::number::{Float, Number};
use fem_elements::sparse::{Block, Pattern, Stored};
use fem_elements::tensor::{Tensor, Tensor4};
use fem_mesh::box_mesh;

const C: f64 = 2e5;
const D: f64 = 1e6;

/// A body of elements of `N` nodes with a random, small deformation.
struct Case<const D: usize, const E: usize, const N: usize> {
    pattern: Pattern,
    elements: Elements<f64, D, E, N>,
    u: Vec<[f64; 3]>,
    d: Vec<[f64; 3]>,
}

/// Numbers between −1 and 1, the same in every run: Knuth's linear congruential generator.
fn random(seed: u64) -> impl FnMut() -> f64 {
    let mut state = seed;
    move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }
}

fn case<const D: usize, const E: usize, const N: usize>(
    positions: &[Vector3<f64>],
    elements: &[[u32; N]],
) -> Case<D, E, N> {
    case_of(positions, elements, |pattern| Elements::new(positions, elements, pattern))
}

fn case_of<const D: usize, const E: usize, const N: usize>(
    positions: &[Vector3<f64>],
    elements: &[[u32; N]],
    make: impl Fn(&Pattern) -> Elements<f64, D, E, N>,
) -> Case<D, E, N> {
    let pattern = Pattern::new(positions.len(), elements, Stored::Full);
    let mut random = random(7);
    let mut vector = |size: f64| {
        let entry = |i: usize, x: f64| if i < D { size * x } else { 0.0 };
        (0..positions.len()).map(|_| std::array::from_fn(|i| entry(i, random()))).collect()
    };
    Case { elements: make(&pattern), pattern, u: vector(0.05), d: vector(1.0) }
}

fn tetrahedra(cells: usize) -> Case<3, 3, 4> {
    let mesh = box_mesh([2.0, 1.0, 1.0], cells, fem_mesh::Pattern::Alternating).unwrap();
    case(&mesh.vertices, &mesh.elements.iter().map(|element| element.map(|node| node as u32)).collect::<Vec<_>>())
}

fn triangles() -> Case<2, 2, 3> {
    let positions: Vec<_> = (0..16).map(|i| Vector3::new(f64::from(i % 4), f64::from(i / 4), 0.0)).collect();
    let cell = |i: u32| [[i, i + 1, i + 5], [i, i + 5, i + 4]];
    let cells = (0..12).filter(|i| i % 4 != 3);
    case(&positions, &cells.flat_map(cell).collect::<Vec<_>>())
}

fn law<T: Float>() -> NeoHookean<T::Single> {
    NeoHookean { C: T::Single::splat(T::of(C)), D: T::Single::splat(T::of(D)) }
}

fn moved(u: &[[f64; 3]], d: &[[f64; 3]], h: f64) -> Vec<[f64; 3]> {
    u.iter().zip(d).map(|(u, d)| std::array::from_fn(|i| u[i] + h * d[i])).collect()
}

/// y = A x for a pattern that stores all blocks.
fn multiply(pattern: &Pattern, values: &[Block<f64, 3>], x: &[[f64; 3]], y: &mut [[f64; 3]]) {
    for (row, y) in y.iter_mut().enumerate().take(pattern.rows()) {
        *y = [0.0; 3];
        for block in pattern.row(row) {
            let x = &x[pattern.columns[block] as usize];
            (0..3).for_each(|i| y[i] += (0..3).map(|j| values[block][i][j] * x[j]).sum::<f64>());
        }
    }
}

fn dot(a: &[[f64; 3]], b: &[[f64; 3]]) -> f64 {
    a.as_flattened().iter().zip(b.as_flattened()).map(|(a, b)| a * b).sum()
}

fn largest(a: &[[f64; 3]]) -> f64 {
    a.as_flattened().iter().fold(0.0, |most: f64, x| most.max(x.abs()))
}

/// Errors of the central differences along d of energy and gradient, relative, with steps h and h/2.
fn differences<const D: usize, const E: usize, const N: usize>(case: &Case<D, E, N>, h: f64) -> (f64, f64) {
    let Case { pattern, elements, u, d } = case;
    let gradient = |u: &[[f64; 3]]| {
        let mut sums = vec![[0.0; 3]; u.len()];
        elements.add_gradient(&law::<f64>(), u, &mut sums);
        sums
    };
    let (plus, minus) = (moved(u, d, h), moved(u, d, -h));
    let slope = (elements.energy(&law::<f64>(), &plus) - elements.energy(&law::<f64>(), &minus)) / (2.0 * h);
    let exact = dot(&gradient(u), d);

    let mut values = vec![[[0.0; 3]; 3]; pattern.blocks()];
    elements.add_stiffness(&law::<f64>(), 1.0, u, &mut values);
    let mut product = vec![[0.0; 3]; u.len()];
    multiply(pattern, &values, d, &mut product);
    let change = moved(&gradient(&plus), &gradient(&minus), -1.0);
    let error = moved(&product, &change, -1.0 / (2.0 * h));
    ((slope - exact).abs() / exact.abs(), largest(&error) / largest(&product))
}

fn converges<const D: usize, const E: usize, const N: usize>(case: &Case<D, E, N>) {
    let (coarse, fine) = (differences(case, 2e-3), differences(case, 1e-3));
    for (coarse, fine) in [(coarse.0, fine.0), (coarse.1, fine.1)] {
        let order = (coarse / fine).log2();
        assert!((1.8..2.2).contains(&order) && fine < 1e-2, "{coarse:e} {fine:e}");
    }
}

#[test]
fn energy_gradient_and_stiffness_of_tetrahedra_belong_together() {
    converges(&tetrahedra(3));
}

#[test]
fn energy_gradient_and_stiffness_of_triangles_in_the_plane_belong_together() {
    converges(&triangles());
}

fn product_without_a_matrix<const D: usize, const E: usize, const N: usize>(case: &Case<D, E, N>) {
    let mut values = vec![[[0.0; 3]; 3]; case.pattern.blocks()];
    case.elements.add_stiffness(&law::<f64>(), 2.0, &case.u, &mut values);
    let (mut with, mut without) = (vec![[0.0; 3]; case.u.len()], vec![[0.0; 3]; case.u.len()]);
    multiply(&case.pattern, &values, &case.d, &mut with);
    case.elements.add_stiffness_times(&law::<f64>(), 2.0, &case.u, &case.d, &mut without);
    assert!(largest(&moved(&with, &without, -1.0)) < 1e-12 * largest(&with));
}

#[test]
fn a_product_with_the_stiffness_needs_no_matrix() {
    product_without_a_matrix(&tetrahedra(2));
    product_without_a_matrix(&triangles());
}

#[test]
fn one_pass_gives_the_same_energy_and_gradient_as_two() {
    let Case { elements, u, .. } = tetrahedra(3);
    let (mut one, mut other) = (vec![[0.0; 3]; u.len()], vec![[0.0; 3]; u.len()]);
    let energy = elements.add_energy_and_gradient(&law::<f64>(), &u, &mut one);
    elements.add_gradient(&law::<f64>(), &u, &mut other);
    assert_eq!(one, other);
    assert_eq!(energy, elements.energy(&law::<f64>(), &u));
}

#[test]
fn chunks_sum_up_to_what_one_chunk_does() {
    // 17 × 9 × 9 nodes a unit: two chunks and more at 14 cells.
    let mesh = box_mesh([4.0, 1.0, 1.0], 14, fem_mesh::Pattern::Alternating).unwrap();
    let elements: Vec<[u32; 4]> = mesh.elements.iter().map(|element| element.map(|node| node as u32)).collect();
    let case: Case<3, 3, 4> = case(&mesh.vertices, &elements);
    assert!(case.elements.chunks() > 2);
    let mut sums = vec![[0.0; 3]; case.u.len()];
    let u: Vec<_> = case.u.iter().map(|u| u.map(|u| 0.1 * u)).collect();
    let energy = case.elements.add_energy_and_gradient(&law::<f64>(), &u, &mut sums);

    // The same by hand, element by element.
    let scalar = NeoHookean { C, D };
    let (mut by_hand, mut total) = (vec![[0.0; 3]; u.len()], 0.0);
    for element in &mesh.elements {
        let [a, b, c, d] = element.map(|node| mesh.vertices[node]);
        let inverse = nalgebra::Matrix3::from_columns(&[b - a, c - a, d - a]).try_inverse().unwrap();
        let volume = (b - a).cross(&(c - a)).dot(&(d - a)) / 6.0;
        let moved = element.map(|node| Vector3::from(u[node]));
        let G =
            nalgebra::Matrix3::from_columns(&[moved[1] - moved[0], moved[2] - moved[0], moved[3] - moved[0]]) * inverse;
        let G = fem_elements::tensor::from_fn(|i, j| G[(i, j)]);
        let P = scalar.stress(&G);
        total += volume * scalar.energy(&G);
        for e in 0..3 {
            for i in 0..3 {
                let f: f64 = (0..3).map(|j| volume * P[i][j] * inverse[(e, j)]).sum();
                by_hand[element[e + 1]][i] += f;
                by_hand[element[0]][i] -= f;
            }
        }
    }
    assert!((energy - total).abs() < 1e-12 * total);
    assert!(largest(&moved(&sums, &by_hand, -1.0)) < 1e-12 * largest(&by_hand));
}

#[test]
fn an_inverted_element_has_infinite_energy_and_is_named() {
    let Case { elements, mut u, .. } = tetrahedra(2);
    u[0] = [1.5, 0.0, 0.0];
    assert_eq!(elements.energy(&law::<f64>(), &u), f64::INFINITY);
    let (J, element) = elements.min_det_F(&u);
    assert!(J < 0.0 && element < elements.count);
}

#[test]
fn a_displacement_that_is_not_a_number_is_not_hidden_by_elements_after_it() {
    let Case { elements, mut u, .. } = tetrahedra(12);
    assert!(elements.chunks() > 1);
    for node in [0, u.len() / 2, u.len() - 1] {
        let before = std::mem::replace(&mut u[node], [f64::NAN; 3]);
        assert!(elements.min_det_F(&u).0.is_nan(), "node {node}");
        u[node] = before;
    }
    assert!(elements.min_det_F(&u).0.is_finite());
}

#[test]
fn rows_beyond_the_pattern_have_forces_but_no_stiffness() {
    let mesh = box_mesh([1.0, 1.0, 1.0], 1, fem_mesh::Pattern::Alternating).unwrap();
    let elements: Vec<[u32; 4]> = mesh.elements.iter().map(|element| element.map(|node| node as u32)).collect();
    let pattern = Pattern::new(3, &elements, Stored::Lower);
    let few = Elements::<f64, 3, 3, 4>::new(&mesh.vertices, &elements, &pattern);
    let mut values = vec![[[0.0; 3]; 3]; pattern.blocks()];
    let u = vec![[0.0; 3]; 8];
    few.add_stiffness(&law::<f64>(), 1.0, &u, &mut values);
    assert!(values.iter().all(|block| block.as_flattened().iter().any(|&x| x != 0.0)));
}

/// A law that gives the entries of its derivative only.
#[derive(Clone, Copy)]
struct Entries<L>(L);

impl<T: Number, L: Law<T>> Law<T> for Entries<L> {
    fn energy(&self, G: &Tensor<T>) -> T {
        self.0.energy(G)
    }

    fn stress(&self, G: &Tensor<T>) -> Tensor<T> {
        self.0.stress(G)
    }

    fn derivative(&self, G: &Tensor<T>) -> Tensor4<T> {
        self.0.derivative(G)
    }

    fn projected_derivative(&self, G: &Tensor<T>) -> Tensor4<T> {
        self.0.projected_derivative(G)
    }
}

fn blocks_of_both_kinds_are_alike<const D: usize, const E: usize, const N: usize>(
    case: &Case<D, E, N>,
    law: impl Law<f64> + Copy,
) {
    let mut values = [vec![[[0.0; 3]; 3]; case.pattern.blocks()], vec![[[0.0; 3]; 3]; case.pattern.blocks()]];
    case.elements.add_stiffness(&law, 2.0, &case.u, &mut values[0]);
    case.elements.add_stiffness(&Entries(law), 2.0, &case.u, &mut values[1]);
    let [short, long] = values.map(|values| values.as_flattened().as_flattened().to_vec());
    let size = long.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    for (short, long) in short.iter().zip(&long) {
        assert!((short - long).abs() <= 1e-13 * size, "{short} {long}");
    }
}

#[test]
fn blocks_from_invariants_and_from_a_rotation_are_those_from_all_entries_of_the_derivative() {
    let stable = StableNeoHookean { mu: C, lambda: D };
    blocks_of_both_kinds_are_alike(&tetrahedra(2), law::<f64>());
    blocks_of_both_kinds_are_alike(&tetrahedra(2), stable);
    blocks_of_both_kinds_are_alike(&tetrahedra(2), fem_elements::materials::Corotated { mu: C, lambda: D });
    blocks_of_both_kinds_are_alike(&triangles(), law::<f64>());
    blocks_of_both_kinds_are_alike(&triangles(), stable);
}

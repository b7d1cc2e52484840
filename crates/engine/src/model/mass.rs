//! Mass of the nodes: M = m ⊗ 1, one number for each pair of nodes, the same in all directions.

use fem_scene::Body;
use rayon::prelude::*;

use crate::number::Real;
use crate::sparse::{Block, Pattern, Stored};

/// From this many rows on several threads share the rows of a product, so many at a time.
const ROWS_FOR_THREADS: usize = 3000;
const CHUNK: usize = 1024;

/// Mass of a body, kg.
#[derive(Clone, Debug)]
pub enum Mass<T> {
    /// Each node carries its share of its elements.
    Lumped(Vec<T>),
    /// ∫ ρ φ_i φ_j.
    Consistent(Consistent<T>),
}

/// A mass for each pair of nodes, all nodes included.
#[derive(Clone, Debug)]
pub struct Consistent<T> {
    pattern: Pattern,
    values: Vec<T>,
}

/// The consistent mass matrix of an element of `N` nodes and unit mass: ∫ φ_i φ_j over its volume. Rows and columns are in the order of
/// the mesh's nodes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ElementMass<const N: usize>([[f64; N]; N]);

impl<const N: usize> ElementMass<N> {
    /// A linear simplex of `N` corners: (1 + δ_ij) / (N (N + 1)).
    pub fn simplex() -> Self {
        let share = 1.0 / (N * (N + 1)) as f64;
        Self(std::array::from_fn(|i| std::array::from_fn(|j| if i == j { 2.0 * share } else { share })))
    }
}

impl ElementMass<6> {
    /// A straight-sided quadratic triangle: Zienkiewicz and Taylor, The Finite Element Method 1, section 17.2.
    pub fn quadratic_triangle() -> Self {
        let entries = [
            [6.0, -1.0, -1.0, 0.0, -4.0, 0.0],
            [-1.0, 6.0, -1.0, 0.0, 0.0, -4.0],
            [-1.0, -1.0, 6.0, -4.0, 0.0, 0.0],
            [0.0, 0.0, -4.0, 32.0, 16.0, 16.0],
            [-4.0, 0.0, 0.0, 16.0, 32.0, 16.0],
            [0.0, -4.0, 0.0, 16.0, 16.0, 32.0],
        ];
        Self(entries.map(|row| row.map(|entry| entry / 180.0)))
    }
}

/// Mass of each element of a body, kg.
pub fn element_masses(body: &Body) -> Vec<f64> {
    let relative_density = |element: usize| body.density_factors.get(element).copied().unwrap_or(1.0);
    let mass = |(element, volume)| body.material.density * (relative_density(element) * volume);
    body.shape.mesh.volumes().into_iter().enumerate().map(mass).collect()
}

impl<T: Real> Mass<T> {
    /// The lumped mass of `nodes` nodes. `masses` are those of the elements, kg, and `shares` the parts of them that the nodes of an
    /// element carry.
    pub fn lumped<const N: usize>(nodes: usize, elements: &[[u32; N]], masses: &[f64], shares: &[f64]) -> Self {
        let mut lumped = vec![0.0; nodes];
        for (element, mass) in elements.iter().zip(masses) {
            for (&node, share) in element.iter().zip(shares) {
                lumped[node as usize] += mass * share;
            }
        }
        Self::Lumped(lumped.into_iter().map(T::of).collect())
    }

    /// The consistent mass of `nodes` nodes. `masses` are those of the elements, kg.
    pub fn consistent<const N: usize>(
        nodes: usize,
        elements: &[[u32; N]],
        masses: &[f64],
        ElementMass(shares): &ElementMass<N>,
    ) -> Self {
        let pattern = Pattern::new(nodes, elements, Stored::Full);
        let mut values = vec![0.0; pattern.blocks()];
        for (element, mass) in elements.iter().zip(masses) {
            for (&row, shares) in element.iter().zip(shares) {
                for (&column, share) in element.iter().zip(shares) {
                    if let Some(pair) = pattern.find(row as usize, column as usize) {
                        values[pair] += mass * share;
                    }
                }
            }
        }
        Self::Consistent(Consistent { pattern, values: values.into_iter().map(T::of).collect() })
    }

    /// Adds `factor` M x.
    pub fn add_times<const D: usize>(&self, factor: T, x: &[[T; D]], product: &mut [[T; D]]) {
        match self {
            Self::Lumped(masses) => {
                for ((sum, x), &mass) in product.iter_mut().zip(x).zip(masses) {
                    for i in 0..D {
                        sum[i] += factor * mass * x[i];
                    }
                }
            }
            Self::Consistent(mass) if product.len() < ROWS_FOR_THREADS => mass.add_rows_times(0, factor, x, product),
            Self::Consistent(mass) => product
                .par_chunks_mut(CHUNK)
                .enumerate()
                .for_each(|(chunk, product)| mass.add_rows_times(chunk * CHUNK, factor, x, product)),
        }
    }

    /// ½ vᵀ M v, J.
    pub fn kinetic_energy<const D: usize>(&self, v: &[[T; D]]) -> f64 {
        let dot = |x: &[T; D], y: [T; D]| x.iter().zip(y).map(|(&x, y)| x.as_f64() * y.as_f64()).sum::<f64>();
        let twice: f64 = match self {
            Self::Lumped(masses) => v.iter().zip(masses).map(|(x, &mass)| dot(x, x.map(|x| x * mass))).sum(),
            Self::Consistent(mass) => v.iter().enumerate().map(|(row, x)| dot(x, mass.row_times(row, v))).sum(),
        };
        0.5 * twice
    }

    /// Adds `factor` M to the blocks of a matrix of the first rows.
    pub fn add_to<const D: usize>(&self, factor: T, pattern: &Pattern, values: &mut [Block<T, D>]) {
        let mut add = |block: usize, mass: T| {
            for i in 0..D {
                values[block][i][i] += factor * mass;
            }
        };
        match self {
            Self::Lumped(masses) => {
                for (block, &mass) in pattern.diagonal().zip(masses) {
                    add(block, mass);
                }
            }
            Self::Consistent(mass) => {
                // Both rows ascend, and every pair of free nodes is in both.
                for row in 0..pattern.rows() {
                    let mut blocks = pattern.row(row).peekable();
                    for pair in mass.pattern.row(row) {
                        let column = mass.pattern.columns[pair];
                        while blocks.next_if(|&block| pattern.columns[block] < column).is_some() {}
                        if let Some(block) = blocks.next_if(|&block| pattern.columns[block] == column) {
                            add(block, mass.values[pair]);
                        }
                    }
                }
            }
        }
    }

    /// Whether the mass is lumped.
    pub fn is_lumped(&self) -> bool {
        matches!(self, Self::Lumped(_))
    }

    /// The diagonal, kg.
    pub fn diagonal(&self) -> Vec<T> {
        match self {
            Self::Lumped(masses) => masses.clone(),
            Self::Consistent(mass) => mass.pattern.diagonal().map(|pair| mass.values[pair]).collect(),
        }
    }

    /// Row sums, kg: the momentum of the body is their sum over the nodes, each times its velocity. Those of a lumped mass are the masses
    /// of the nodes, those of a consistent one are too if the elements are linear.
    pub fn row_sums(&self) -> Vec<T> {
        match self {
            Self::Lumped(masses) => masses.clone(),
            Self::Consistent(mass) => (0..mass.pattern.rows())
                .map(|row| mass.values[mass.pattern.row(row)].iter().copied().fold(T::default(), |sum, x| sum + x))
                .collect(),
        }
    }

    /// Memory, bytes.
    pub fn bytes(&self) -> usize {
        match self {
            Self::Lumped(masses) => size_of_val(&masses[..]),
            Self::Consistent(mass) => mass.pattern.bytes() + size_of_val(&mass.values[..]),
        }
    }
}

impl<T: Real> Consistent<T> {
    /// Adds the rows of `factor` M x from `first` on.
    fn add_rows_times<const D: usize>(&self, first: usize, factor: T, x: &[[T; D]], product: &mut [[T; D]]) {
        for (row, sum) in product.iter_mut().enumerate() {
            let of_row = self.row_times(first + row, x);
            for i in 0..D {
                sum[i] += factor * of_row[i];
            }
        }
    }

    fn row_times<const D: usize>(&self, row: usize, x: &[[T; D]]) -> [T; D] {
        let mut sum = [T::default(); D];
        for pair in self.pattern.row(row) {
            let x = &x[self.pattern.columns[pair] as usize];
            for i in 0..D {
                sum[i] += self.values[pair] * x[i];
            }
        }
        sum
    }
}

#[cfg(test)]
mod tests {
    use super::{ElementMass, Mass};
    use crate::sparse::{Pattern, Stored};

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
        let points = [(a, of_a), (b, of_b)].map(|(x, weight)| {
            [[1.0 - 2.0 * x, x, x], [x, 1.0 - 2.0 * x, x], [x, x, 1.0 - 2.0 * x]].map(|L| (L, weight))
        });
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
        let mesh = fem_mesh::quadratic(fem_mesh::rectangle_mesh([1.0, 1.0], 1).unwrap());
        let lumped = fem_scene::BodyMesh::Quadratic { triangles: mesh, thickness: 1.0 }.lumped_mass_shares();
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
}

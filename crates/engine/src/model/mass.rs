//! Mass of the nodes: M = m ⊗ 1, one number for each pair of nodes, the same in all directions.

use crate::number::Real;
use crate::sparse::{Block, Pattern, Stored};

/// Mass of a body of simplices, kg.
#[derive(Clone, Debug)]
pub enum Mass<T> {
    /// Row sums of the consistent mass: each node carries its share of its elements.
    Lumped(Vec<T>),
    /// ∫ ρ φ_i φ_j: ρV/20 for each pair of corners of a tetrahedron, twice that on the diagonal.
    Consistent(Consistent<T>),
}

/// A mass for each pair of nodes, all nodes included.
#[derive(Clone, Debug)]
pub struct Consistent<T> {
    pattern: Pattern,
    values: Vec<T>,
}

impl<T: Real> Mass<T> {
    /// The mass of `nodes` nodes; `volumes` are those of the elements, m³ (area in the plane).
    pub fn new<const N: usize>(
        nodes: usize,
        elements: &[[u32; N]],
        volumes: &[f64],
        density: f64,
        lumped: bool,
    ) -> Self {
        if lumped {
            let mut masses = vec![0.0; nodes];
            for (element, volume) in elements.iter().zip(volumes) {
                for &node in element {
                    masses[node as usize] += density * volume / N as f64;
                }
            }
            return Self::Lumped(masses.into_iter().map(T::of).collect());
        }
        let pattern = Pattern::new(nodes, elements, Stored::Full);
        let mut values = vec![0.0; pattern.blocks()];
        for (element, volume) in elements.iter().zip(volumes) {
            // ∫ φ_i φ_j over a simplex of N corners is V (1 + δ_ij) / (N (N + 1)).
            let share = density * volume / (N * (N + 1)) as f64;
            for &row in element {
                for &column in element {
                    if let Some(pair) = pattern.find(row as usize, column as usize) {
                        values[pair] += if row == column { 2.0 * share } else { share };
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
            Self::Consistent(mass) => {
                for (row, sum) in product.iter_mut().enumerate() {
                    let of_row = mass.row_times(row, x);
                    for i in 0..D {
                        sum[i] += factor * of_row[i];
                    }
                }
            }
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

    /// Row sums: the lumped mass of each node, kg.
    pub fn lumped(&self) -> Vec<T> {
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
    use super::Mass;
    use crate::sparse::{Pattern, Stored};

    #[test]
    fn both_masses_weigh_the_same_and_move_alike_in_translation() {
        let elements = [[0, 1, 2, 3], [1, 2, 3, 4]];
        let v = [[1.0, -2.0, 0.5]; 5];
        for lumped in [false, true] {
            let mass = Mass::<f64>::new(5, &elements, &[0.5, 0.25], 8.0, lumped);
            assert!((mass.lumped().iter().sum::<f64>() - 6.0).abs() < 1e-14);
            assert!((mass.kinetic_energy(&v) - 0.5 * 6.0 * 5.25).abs() < 1e-13);
        }
    }

    #[test]
    fn a_matrix_gets_the_mass_of_its_rows() {
        let elements = [[0, 1, 2, 3], [1, 2, 3, 4]];
        let mass = Mass::<f64>::new(5, &elements, &[20.0, 40.0], 1.0, false);
        let pattern = Pattern::new(3, &elements, Stored::Lower);
        let mut values = vec![[[0.0; 3]; 3]; pattern.blocks()];
        mass.add_to(10.0, &pattern, &mut values);
        assert_eq!(values[pattern.find(0, 0).unwrap()][1][1], 20.0);
        assert_eq!(values[pattern.find(2, 1).unwrap()], [[30.0, 0.0, 0.0], [0.0, 30.0, 0.0], [0.0, 0.0, 30.0]]);
    }
}

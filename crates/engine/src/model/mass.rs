//! Mass of the nodes: M = m ⊗ 1, one number for each pair of nodes, the same in all directions.

use std::ops::Range;

use fem_model::Body;

use fem_elements::sparse::{Block, Pattern, Stored};
use fem_elements::threads::{join, over_parts};
use fem_elements::vector::dot3;
use fem_solvers::Real;

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
    /// Row sums of the magnitudes, kg.
    magnitudes: Vec<T>,
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

    /// The consistent mass of `nodes` nodes. `masses` are those of the elements, kg, and `shares` is the mass matrix of an element of unit mass,
    /// whose rows and columns are in the order of its nodes.
    pub fn consistent<const N: usize>(
        nodes: usize,
        elements: &[[u32; N]],
        masses: &[f64],
        shares: &[[f64; N]; N],
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
        let magnitude = |row| T::of(values[pattern.row(row)].iter().map(|mass| mass.abs()).sum());
        let magnitudes = (0..nodes).map(magnitude).collect();
        Self::Consistent(Consistent { pattern, values: values.into_iter().map(T::of).collect(), magnitudes })
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
            Self::Consistent(mass) => {
                over_parts(product, CHUNK, &|first, product| mass.add_rows_times(first, factor, x, product));
            }
        }
    }

    /// ½ vᵀ M v, J.
    pub fn kinetic_energy<const D: usize>(&self, v: &[[T; D]]) -> f64 {
        0.5 * self.product(v, v)
    }

    /// An upper bound of ½ vᵀ M v in one pass over the nodes, J: 2 |mᵢⱼ vᵢ·vⱼ| ≤ |mᵢⱼ| (vᵢ² + vⱼ²). It is the energy itself if the mass is
    /// lumped.
    pub fn kinetic_energy_bound(&self, v: &[[T; 3]]) -> f64 {
        let masses = match self {
            Self::Lumped(masses) => masses,
            Self::Consistent(mass) => &mass.magnitudes,
        };
        let of_node = |v: &[T; 3], mass: &T| mass.as_f64() * dot3(v, v);
        let ((chunks, v), (of_chunks, masses)) = (v.as_chunks::<4>(), masses.as_chunks::<4>());
        // An addition does not wait for the one before it.
        let mut sums = [0.0; 4];
        for (v, masses) in chunks.iter().zip(of_chunks) {
            for lane in 0..sums.len() {
                sums[lane] += of_node(&v[lane], &masses[lane]);
            }
        }
        let rest: f64 = v.iter().zip(masses).map(|(v, mass)| of_node(v, mass)).sum();
        0.5 * (sums.iter().sum::<f64>() + rest)
    }

    /// vᵀ M w
    pub fn product<const D: usize>(&self, v: &[[T; D]], w: &[[T; D]]) -> f64 {
        let dot = |x: &[T; D], y: [T; D]| x.iter().zip(y).map(|(&x, y)| x.as_f64() * y.as_f64()).sum::<f64>();
        match self {
            Self::Lumped(masses) => {
                v.iter().zip(w).zip(masses).map(|((v, w), &mass)| dot(v, w.map(|w| w * mass))).sum()
            }
            Self::Consistent(mass) => v.iter().enumerate().map(|(row, x)| dot(x, mass.row_times(row, w))).sum(),
        }
    }

    /// Adds `factor` M to the blocks of a matrix of the first rows.
    pub fn add_to<const D: usize>(&self, factor: T, pattern: &Pattern, values: &mut [Block<T, D>]) {
        match self {
            Self::Lumped(masses) => {
                for (block, &mass) in pattern.diagonal().zip(masses) {
                    add_to_diagonal(factor * mass, &mut values[block]);
                }
            }
            Self::Consistent(mass) => mass.add_rows_to(factor, pattern, 0..pattern.rows(), values),
        }
    }

    /// Returns true if the mass is lumped.
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
            Self::Consistent(mass) => {
                mass.pattern.bytes() + size_of_val(&mass.values[..]) + size_of_val(&mass.magnitudes[..])
            }
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

    /// Adds `factor` M to the blocks of some rows of a matrix. Threads share many rows.
    fn add_rows_to<const D: usize>(
        &self,
        factor: T,
        pattern: &Pattern,
        rows: Range<usize>,
        values: &mut [Block<T, D>],
    ) {
        let first = pattern.starts[rows.start];
        if rows.len() > ROWS_FOR_THREADS {
            let middle = rows.start.midpoint(rows.end);
            let (left, right) = values.split_at_mut(pattern.starts[middle] - first);
            join(
                || self.add_rows_to(factor, pattern, rows.start..middle, left),
                || self.add_rows_to(factor, pattern, middle..rows.end, right),
            );
            return;
        }
        // Both rows ascend, and every pair of free nodes is in both.
        for row in rows {
            let mut blocks = pattern.row(row).peekable();
            for pair in self.pattern.row(row) {
                let column = self.pattern.columns[pair];
                while blocks.next_if(|&block| pattern.columns[block] < column).is_some() {}
                if let Some(block) = blocks.next_if(|&block| pattern.columns[block] == column) {
                    add_to_diagonal(factor * self.values[pair], &mut values[block - first]);
                }
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

fn add_to_diagonal<T: Real, const D: usize>(mass: T, block: &mut Block<T, D>) {
    for i in 0..D {
        block[i][i] += mass;
    }
}

#[cfg(test)]
mod tests;

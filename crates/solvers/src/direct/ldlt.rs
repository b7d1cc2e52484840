//! Sparse factorisation A = L S Lᵀ of a symmetric matrix of scalars without pivoting, S having entries 1 and −1: it exists for every positive
//! definite and every quasi-definite matrix, Vanderbei, Symmetric Quasidefinite Matrices (1995). The signs of S are those of the eigenvalues.

use super::supernodal::Supernodal;
use fem_elements::sparse::{Block, Pattern, Stored};
use fem_model::simulation::Breakdown;

/// A symmetric matrix that is a sum of entries at fixed places, and a factor.
pub struct Ldlt {
    /// The lower half.
    pattern: Pattern,
    values: Vec<Block<f64, 1>>,
    /// Place in `values` of each entry.
    targets: Vec<u32>,
    factor: Supernodal<f64, 1, true>,
    /// Vectors of an iteration: an orthonormal basis, and the solutions by the factor with its vectors.
    basis: Vec<f64>,
    solutions: Vec<f64>,
}

/// Largest number of iterations: about as many as a factor of a large matrix is worth.
const ITERATIONS: usize = 20;

impl Ldlt {
    /// Analyses a matrix of `rows` rows, to be factored in their order, whose entries are at these rows and columns; of each pair of places
    /// that mirror each other one is given.
    pub fn new(rows: usize, entries: &[[u32; 2]]) -> Self {
        let pattern = Pattern::new(rows, entries, Stored::Lower);
        let place = |&[a, b]: &[u32; 2]| match pattern.find(a.max(b) as usize, a.min(b) as usize) {
            Some(place) => place as u32,
            None => unreachable!("the pattern is made of the entries"),
        };
        Self {
            values: vec![[[0.0]]; pattern.blocks()],
            targets: entries.iter().map(place).collect(),
            factor: Supernodal::new(&pattern),
            pattern,
            basis: Vec::new(),
            solutions: Vec::new(),
        }
    }

    /// Sets the entries of the matrix, those of one place added up. The factor stays that of the matrix before.
    pub fn set(&mut self, entries: impl Iterator<Item = f64>) {
        self.values.fill([[0.0]]);
        self.targets.iter().zip(entries).for_each(|(&target, entry)| self.values[target as usize][0][0] += entry);
    }

    /// The values of the matrix that was set last, row by row.
    pub fn values(&self) -> &[f64] {
        self.values.as_flattened().as_flattened()
    }

    /// Values row by row, ordered column by column.
    pub fn to_columns(&self, values: &[f64]) -> Vec<f64> {
        self.by_columns().into_iter().map(|(_, _, place)| values[place]).collect()
    }

    /// Sets the values, given column by column.
    pub fn set_columns(&mut self, values: &[f64]) {
        for ((_, _, place), &value) in self.by_columns().into_iter().zip(values) {
            self.values[place] = [[value]];
        }
    }

    /// Column, row and place of each value, in the order of state files.
    fn by_columns(&self) -> Vec<(u32, usize, usize)> {
        let Pattern { columns, .. } = &self.pattern;
        let rows = 0..self.pattern.rows();
        let places = rows.flat_map(|row| self.pattern.row(row).map(move |place| (columns[place], row, place)));
        let mut places: Vec<_> = places.collect();
        places.sort_unstable();
        places
    }

    /// Factors the matrix, and returns the number of its positive eigenvalues.
    pub fn factor(&mut self) -> Result<usize, Breakdown> {
        self.factor.factor(&self.values)?;
        Ok(self.factor.signs().iter().filter(|&&sign| sign > 0.0).count())
    }

    /// Overwrites the right-hand side with the solution, to this relative residual, by GMRES with the factor, of this matrix or of a similar one, as
    /// its preconditioner: Saad and Schultz, GMRES (1986), in the flexible form of Saad (1993). Returns the relative residual.
    pub fn solve(&mut self, x: &mut [f64], tolerance: f64) -> f64 {
        let size = norm(x);
        if size == 0.0 {
            return 0.0;
        }
        let rows = x.len();
        self.basis.clear();
        self.basis.extend(x.iter().map(|x| x / size));
        self.solutions.clear();
        // The least squares problem of the coefficients, brought to triangular form by rotations.
        let (mut R, mut rotations, mut right) = (Vec::new(), Vec::<[f64; 2]>::new(), vec![size]);
        let mut left = 1.0;
        while left > tolerance && rotations.len() < ITERATIONS {
            let step = rotations.len();
            self.apply(step);
            self.multiply(step);
            let mut column: Vec<f64> = Vec::with_capacity(step + 2);
            let (basis, product) = self.basis.split_at_mut(rows * (step + 1));
            for v in basis.chunks_exact(rows) {
                let part = v.iter().zip(&*product).map(|(v, p)| v * p).sum::<f64>();
                product.iter_mut().zip(v).for_each(|(p, v)| *p -= part * v);
                column.push(part);
            }
            let rest = norm(product);
            product.iter_mut().for_each(|p| *p /= rest);
            for (k, [cosine, sine]) in rotations.iter().enumerate() {
                let [a, b] = [column[k], column[k + 1..].first().copied().unwrap_or(0.0)];
                column[k] = cosine * a + sine * b;
                if let Some(next) = column.get_mut(k + 1) {
                    *next = cosine * b - sine * a;
                }
            }
            let last = column[step];
            let length = last.hypot(rest);
            let [cosine, sine] = [last / length, rest / length];
            column[step] = length;
            rotations.push([cosine, sine]);
            R.push(column);
            right.push(-sine * right[step]);
            right[step] *= cosine;
            let before = left;
            left = right[step + 1].abs() / size;
            // NaN fails the comparison.
            if !(left < before) || rest == 0.0 {
                break;
            }
        }
        for step in (0..R.len()).rev() {
            let known: f64 = (step + 1..R.len()).map(|k| R[k][step] * right[k]).sum();
            right[step] = (right[step] - known) / R[step][step];
        }
        x.fill(0.0);
        for (z, factor) in self.solutions.chunks_exact(rows).zip(&right) {
            x.iter_mut().zip(z).for_each(|(x, z)| *x += factor * z);
        }
        if x.iter().all(|x| x.is_finite()) { left } else { f64::NAN }
    }

    /// Adds the solution by the factor with a vector of the basis as its right-hand side.
    fn apply(&mut self, step: usize) {
        let rows = self.pattern.rows();
        self.solutions.extend_from_slice(&self.basis[step * rows..][..rows]);
        self.factor.solve(&mut self.solutions[step * rows..]);
    }

    /// Adds A times a solution to the basis.
    fn multiply(&mut self, step: usize) {
        let rows = self.pattern.rows();
        let first = self.basis.len();
        self.basis.resize(first + rows, 0.0);
        let (x, y) = (&self.solutions[step * rows..], &mut self.basis[first..]);
        for row in 0..rows {
            let mut of_row = 0.0;
            for place in self.pattern.row(row) {
                let (column, [[value]]) = (self.pattern.columns[place] as usize, self.values[place]);
                of_row += value * x[column];
                if column != row {
                    y[column] += value * x[row];
                }
            }
            y[row] += of_row;
        }
    }

    /// Allocated bytes.
    pub fn bytes(&self) -> usize {
        self.pattern.bytes()
            + size_of_val(&self.values[..])
            + size_of_val(&self.targets[..])
            + self.factor.bytes()
            + size_of_val(&self.basis[..])
            + size_of_val(&self.solutions[..])
    }
}

fn norm(x: &[f64]) -> f64 {
    x.iter().map(|x| x * x).sum::<f64>().sqrt()
}

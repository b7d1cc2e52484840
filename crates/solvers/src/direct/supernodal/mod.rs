//! Sparse factorisation A = L S Lᵀ by the multifrontal method with supernodes, in parallel over subtrees and within large fronts: Duff and Reid,
//! The Multifrontal Solution of Indefinite Sparse Symmetric Linear Equations (1983); Amestoy and Duff, Vectorization of a Multiprocessor
//! Multifrontal Code (1989). S = 1 if A is positive definite, as in Cholesky's method; else its entries are 1 or −1, without pivoting. And the
//! factorisation A = P L U of matrices that are not symmetric, or need pivots.

mod dense;
mod factorisation;
mod fronts;
mod lu;
mod products;
mod substitute;
mod symbolic;
mod tasks;
mod updates;

pub(crate) use lu::Lu;

use factorisation::Factorisation;
use substitute::Substitute;
use symbolic::SymbolicFactor;
use tasks::Task;

use crate::memory::available_memory;
use crate::{ApproximateInverse, Memoryless};
use fem_elements::Real;
use fem_elements::number::{Float, vectorized};
use fem_elements::sparse::{Block, Pattern};
use fem_model::simulation::Breakdown;

/// The Cholesky factor of a matrix with three rows for each node.
pub(crate) type SupernodalCholesky<T> = Supernodal<T, 3, false>;

/// The factor of a matrix of D×D blocks, with its workspace. `SIGNED`: the matrix may be indefinite.
pub(crate) struct Supernodal<T, const D: usize, const SIGNED: bool> {
    symbolic: SymbolicFactor,
    task: Task,
    /// False if the factor does not fit into memory.
    fits: bool,
    L: Vec<T>,
    /// 1 / diagonal of L, in postorder.
    inverse: Vec<T>,
    /// The diagonal of S, in postorder; empty unless `SIGNED`.
    signs: Vec<T>,
    /// Update matrices that have not been assembled into a parent yet.
    updates: Vec<T>,
    /// One entry for each row of the largest front.
    front: Vec<T>,
}

impl<T: Real, const D: usize, const SIGNED: bool> Supernodal<T, D, SIGNED> {
    /// Symbolic factorisation in the order of the rows; `pattern` stores the lower half. Where the factor and its workspace would not fit into
    /// memory, every factorisation returns [`Breakdown::TooLarge`].
    pub(crate) fn new(pattern: &Pattern) -> Self {
        Self::within(pattern, available_memory())
    }

    /// The same with a limit of so many bytes.
    pub(crate) fn within(pattern: &Pattern, limit: Option<usize>) -> Self {
        let symbolic = SymbolicFactor::new(pattern, D, <T as Float>::MAX_WIDTH);
        let task = Task::new(&symbolic);
        let rows = D * pattern.rows();
        let largest = symbolic.supernodes.iter().map(|supernode| supernode.stride).max().unwrap_or(0);
        let sizes = [symbolic.len_L, rows, if SIGNED { rows } else { 0 }, task.len_updates, largest];
        let memory = zeros(sizes, limit);
        let fits = memory.is_some();
        let [L, inverse, signs, updates, front] = memory.unwrap_or_default();
        Self { symbolic, task, fits, L, inverse, signs, updates, front }
    }

    /// Factors the matrix with these values.
    pub(crate) fn factor(&mut self, values: &[Block<T, D>]) -> Result<(), Breakdown> {
        let Self { symbolic, task, L, inverse, signs, updates, .. } = self;
        if !self.fits {
            return Err(Breakdown::TooLarge);
        }
        let (values, columns, updates) = ([values], [&mut L[..]], [&mut updates[..]]);
        let swaps = &mut [];
        vectorized(Factorisation::<T, D, 1, SIGNED> { symbolic, task, values, columns, inverse, signs, swaps, updates })
    }

    /// z = A⁻¹ z, where there is a factor.
    pub(crate) fn solve(&mut self, z: &mut [T]) {
        let Self { symbolic, L, inverse, signs, front, .. } = self;
        if self.fits {
            let columns = (&L[..], &inverse[..]);
            vectorized(Substitute::<T, D> {
                symbolic,
                forward: columns,
                backward: columns,
                signs,
                swaps: &[],
                z,
                front,
            });
        }
    }

    /// The diagonal of S, in another order than the rows; empty unless `SIGNED`.
    pub(crate) fn signs(&self) -> &[T] {
        &self.signs
    }

    pub(crate) fn bytes(&self) -> usize {
        let scalars = [&self.L, &self.inverse, &self.signs, &self.updates, &self.front].map(Vec::len);
        scalars.into_iter().sum::<usize>() * size_of::<T>() + self.symbolic.bytes()
    }
}

/// Zeros of these sizes; `None` if there is no memory for them, or they would take more than so many bytes.
fn zeros<T: Real, const N: usize>(sizes: [usize; N], limit: Option<usize>) -> Option<[Vec<T>; N]> {
    if limit.is_some_and(|limit| sizes.iter().sum::<usize>() > limit / size_of::<T>()) {
        return None;
    }
    let mut zeros = [const { Vec::new() }; N];
    for (zeros, size) in zeros.iter_mut().zip(sizes) {
        zeros.try_reserve_exact(size).ok()?;
        zeros.resize(size, T::default());
    }
    Some(zeros)
}

impl<T: Real> Memoryless for SupernodalCholesky<T> {}

impl<T: Real> ApproximateInverse<T> for SupernodalCholesky<T> {
    fn prepare(&mut self, values: &[Block<T, 3>]) -> Result<(), Breakdown> {
        self.factor(values)
    }

    fn apply(&mut self, r: &[[T; 3]], z: &mut [[T; 3]]) {
        z.copy_from_slice(r);
        self.solve(z.as_flattened_mut());
    }

    fn bytes(&self) -> usize {
        self.bytes()
    }
}

//! Counters and timers of a simulation.

use std::cell::Cell;

use fem_model::Timer;
use fem_model::simulation::Counters;
use nalgebra_sparse::CsrMatrix;

/// Counters, and timers of the parts. Closures that share the simulation write to them, hence the cells.
#[derive(Default)]
pub(super) struct Profile {
    counters: Cell<Counters>,
    /// Energies evaluated since the last linear solve: all but the first of them are backtracking.
    trials: Cell<Option<usize>>,
    pub(super) energy: Timer,
    pub(super) forces: Timer,
    pub(super) stiffness: Timer,
    pub(super) solve: Timer,
    pub(super) skinning: Timer,
}

impl Profile {
    pub(super) fn counters(&self) -> Counters {
        self.counters.get()
    }

    fn count(&self, change: impl FnOnce(&mut Counters)) {
        let mut counters = self.counters.get();
        change(&mut counters);
        self.counters.set(counters);
    }

    /// Begins a step: energies are not trials of a line search before the first linear solve.
    pub(super) fn begin_step(&self) {
        self.trials.set(None);
    }

    pub(super) fn count_step(&self) {
        self.count(|counters| counters.steps += 1);
    }

    pub(super) fn count_unconverged_step(&self) {
        self.count(|counters| counters.unconverged_steps += 1);
    }

    pub(super) fn count_energy_evaluation(&self) {
        let is_backtrack = self.trials.get().is_some_and(|trials| trials > 0);
        self.trials.set(self.trials.get().map(|trials| trials + 1));
        self.count(|counters| {
            counters.energy_evaluations += 1;
            counters.line_search_backtracks += usize::from(is_backtrack);
        });
    }

    pub(super) fn count_force_assembly(&self) {
        self.count(|counters| counters.force_assemblies += 1);
    }

    pub(super) fn count_stiffness_assembly(&self, elements: usize) {
        self.count(|counters| {
            counters.stiffness_assemblies += 1;
            counters.projections += elements;
        });
    }

    /// Counts a linear solve: in Newton's method it gives a new direction, along which the next energies are trials.
    pub(super) fn count_solve(&self, of_newton: bool) {
        self.trials.set(Some(0));
        self.count(|counters| counters.newton_iterations += usize::from(of_newton));
    }

    pub(super) fn count_skinning_rows(&self, rows: usize) {
        self.count(|counters| counters.skinning_rows += rows);
    }
}

/// Memory of a sparse matrix, bytes.
pub(super) fn bytes(matrix: &CsrMatrix<f64>) -> usize {
    16 * matrix.nnz() + 8 * (matrix.nrows() + 1)
}

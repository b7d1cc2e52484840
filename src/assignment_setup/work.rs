//! Counts and clocks of the work that a simulation does.

use std::cell::Cell;
use std::time::Instant;

use fem_scene::simulation::Counters;
use nalgebra_sparse::CsrMatrix;

/// Counters and stop watches. Closures that share the simulation write to them, hence the cells.
#[derive(Default)]
pub(super) struct Work {
    counters: Cell<Counters>,
    /// Energies asked for since the last linear solve: all but the first of them are backtracking.
    trials: Cell<Option<usize>>,
    pub(super) energy: Clock,
    pub(super) forces: Clock,
    pub(super) stiffness: Clock,
    pub(super) solve: Clock,
    pub(super) skinning: Clock,
}

impl Work {
    pub(super) fn counters(&self) -> Counters {
        self.counters.get()
    }

    fn count(&self, change: impl FnOnce(&mut Counters)) {
        let mut counters = self.counters.get();
        change(&mut counters);
        self.counters.set(counters);
    }

    /// A step begins: an energy is not the trial of a line search until a direction has been solved for.
    pub(super) fn begin_step(&self) {
        self.trials.set(None);
    }

    pub(super) fn count_step(&self) {
        self.count(|counters| counters.steps += 1);
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

    /// A linear solve: in Newton's method a new direction, along which the next energies are trials.
    pub(super) fn count_solve(&self, of_newton: bool) {
        self.trials.set(Some(0));
        self.count(|counters| counters.newton_iterations += usize::from(of_newton));
    }

    pub(super) fn count_skinning_rows(&self, rows: usize) {
        self.count(|counters| counters.skinning_rows += rows);
    }
}

/// Uses of one part, and seconds of wall-clock time spent in it.
#[derive(Default)]
pub(super) struct Clock(Cell<(usize, f64)>);

impl Clock {
    pub(super) fn time<R>(&self, work: impl FnOnce() -> R) -> R {
        let start = Instant::now();
        let result = work();
        let (uses, seconds) = self.0.get();
        self.0.set((uses + 1, seconds + start.elapsed().as_secs_f64()));
        result
    }

    pub(super) fn read(&self) -> (usize, f64) {
        self.0.get()
    }
}

/// Memory of a sparse matrix, bytes.
pub(super) fn bytes(matrix: &CsrMatrix<f64>) -> usize {
    16 * matrix.nnz() + 8 * (matrix.nrows() + 1)
}

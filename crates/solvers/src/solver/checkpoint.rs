//! The data of a solver in a checkpoint.

use super::{Real, Solver};
use fem_elements::history::{put_flag, take_flag};
use fem_elements::sparse::Block;
use fem_model::simulation::History;

impl<T: Real> Solver<T> {
    /// Adds the data of earlier matrices that the next preparation needs, and, if the factor or preconditioner `is_kept`, those that it
    /// depends on.
    pub fn save(&self, is_kept: bool, history: &mut History) {
        if self.inverse.assembles() {
            put_flag(history, "solver.has_own_matrix", self.has_own_matrix);
        }
        self.inverse.save(is_kept, history);
    }

    /// Restores the data that [`save`](Self::save) has added.
    pub fn restore(&mut self, is_kept: bool, history: &History) -> Result<(), String> {
        self.has_own_matrix = self.inverse.assembles() && take_flag(history, "solver.has_own_matrix")?;
        self.inverse.restore(is_kept, history)
    }

    /// Computes the kept factor or preconditioner after [`restore`](Self::restore), bit for bit as it was. `values` is the matrix that
    /// is still in use.
    pub fn prepare_again(&mut self, values: &[Block<T, 3>]) -> Result<(), String> {
        let again = self.inverse.prepare_again(values);
        again.map_err(|breakdown| format!("its matrix cannot be factored again: {breakdown}"))
    }
}

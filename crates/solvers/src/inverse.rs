//! The trait behind which every method of the solver stands.

use super::assembly::Assembly;
#[cfg(feature = "gpu")]
use super::assembly::DeviceElements;
use fem_elements::Real;
use fem_elements::sparse::Block;
use fem_model::simulation::{Breakdown, History};

/// The data of earlier matrices on which an approximate inverse P⁻¹ depends; without such data it is [`Memoryless`].
pub(crate) trait Memory<T: Real> {
    /// Adds the data of earlier matrices that the next [`prepare`](ApproximateInverse::prepare) needs, and, if P `is_kept`, those that P
    /// depends on.
    fn save(&self, is_kept: bool, history: &mut History);

    /// Restores the data that [`save`](Self::save) has added.
    fn restore(&mut self, is_kept: bool, history: &History) -> Result<(), String>;

    /// Computes P after [`restore`](Self::restore), with the matrix that is still in use: P becomes what it was, bit for bit.
    fn prepare_again(&mut self, values: &[Block<T, 3>]) -> Result<(), Breakdown>;
}

/// An approximate inverse that depends on the values of its matrix alone, as a factor does.
pub(crate) trait Memoryless {}

impl<T: Real, P: Memoryless + ApproximateInverse<T>> Memory<T> for P {
    fn save(&self, _: bool, _: &mut History) {}

    fn restore(&mut self, _: bool, _: &History) -> Result<(), String> {
        Ok(())
    }

    fn prepare_again(&mut self, values: &[Block<T, 3>]) -> Result<(), Breakdown> {
        self.prepare(values)
    }
}

/// An approximate inverse P⁻¹ of a matrix A: a factor, which is exact up to round-off, or a preconditioner. It is created for
/// one sparsity pattern and prepared for the values of a matrix. Neither `prepare` nor `apply` allocates after the first time.
pub(crate) trait ApproximateInverse<T: Real>: Memory<T> + Send + Sync {
    /// Computes P for the values of a matrix. After an error P must be prepared again before it is applied.
    fn prepare(&mut self, values: &[Block<T, 3>]) -> Result<(), Breakdown>;

    /// Receives the elements whose matrices it assembles itself from then on.
    #[cfg(feature = "gpu")]
    fn set_elements(&mut self, _elements: &DeviceElements) {}

    /// Returns true if the inverse [assembles](Self::assemble) matrices.
    fn assembles(&self) -> bool {
        false
    }

    /// Assembles a matrix and computes P for it. The matrix stays on the solver's device, and only [`correct`](Self::correct)
    /// uses it.
    fn assemble(&mut self, _matrix: &Assembly<T>) -> Result<(), Breakdown> {
        Err(Breakdown::Singular)
    }

    /// The assembled matrix.
    fn assembled(&self) -> Result<Vec<Block<T, 3>>, Breakdown> {
        Err(Breakdown::Singular)
    }

    /// z = P⁻¹ r
    fn apply(&mut self, r: &[[T; 3]], z: &mut [[T; 3]]);

    /// Solves A d = r to a relative residual `tolerance` by an iteration of its own, and adds d to x. Returns the number of
    /// iterations. Only methods that [copy the matrix](super::SolverChoice::copies_matrix) have such an iteration.
    fn correct(&mut self, _r: &[[T; 3]], _x: &mut [[T; 3]], _tolerance: f64) -> Result<usize, Breakdown> {
        Err(Breakdown::NotConverged { residual: 1.0 })
    }

    /// Smallest relative residual that a correction is asked for: the next one begins with an exact residual.
    fn smallest_tolerance(&self) -> f64 {
        1e-4
    }

    /// Allocated bytes.
    fn bytes(&self) -> usize;
}

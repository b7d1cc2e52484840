//! Conjugate gradients on a graphics device, as a solver of the engine.

use std::sync::{Arc, OnceLock};

use fem_gpu::{BlockPattern, CoarseGrid, ConjugateGradients, Device, DeviceError, Number, Outcome};
use fem_scene::Precision;
use fem_scene::simulation::{Breakdown, History};

use crate::number::Real;
use crate::solvers::ApproximateInverse;
use crate::solvers::block::invert;
use crate::solvers::preconditioners::{Coarse, LowerHalf, single_precision_scale};
use crate::sparse::{Block, Pattern};
use crate::vector::norm;

/// The largest number of iterations of one correction.
const MAX_ITERATIONS: usize = 2000;

/// Most corners of the coarse grid, whose matrix is inverted.
const MOST_CORNERS: usize = 400;

/// The device of this process, opened when a scene first asks for it.
pub fn device() -> Result<&'static Arc<Device>, &'static DeviceError> {
    static DEVICE: OnceLock<Result<Arc<Device>, DeviceError>> = OnceLock::new();
    DEVICE.get_or_init(Device::open).as_ref()
}

/// Name of the graphics device, or why there is none.
pub fn name() -> Result<String, String> {
    device().map(|device| device.adapter().to_owned()).map_err(|error| error.to_string())
}

/// Why no system can be solved on a device in this precision.
pub fn unusable(precision: Precision) -> Option<String> {
    match device() {
        Err(error) => Some(error.to_string()),
        Ok(device) if precision == Precision::F64 && !device.has_double_precision() => {
            Some(DeviceError::NoDoublePrecision(device.adapter().to_owned()).to_string())
        }
        Ok(_) => None,
    }
}

/// The solver on the device for a pattern that stores all blocks, and the undeformed positions of its nodes, m.
pub fn solver<T: Real>(precision: Precision, pattern: &Pattern, rest: &[[f64; 3]]) -> Box<dyn ApproximateInverse<T>> {
    match precision {
        Precision::F32 => Box::new(OnDevice::<f32>::new(pattern, rest)),
        Precision::F64 => Box::new(OnDevice::<f64>::new(pattern, rest)),
    }
}

/// A matrix on the device.
struct OnDevice<N: Number> {
    /// An error of the device appears when a matrix is prepared.
    solver: Result<ConjugateGradients<N>, DeviceError>,
    lower: LowerHalf,
    coarse: Coarse,
    /// The number that the matrix is multiplied by.
    scale: f64,
    /// Inverses of the diagonal blocks of the scaled matrix.
    inverses: Vec<Block<f64, 3>>,
}

impl<N: Number> OnDevice<N> {
    fn new(pattern: &Pattern, rest: &[[f64; 3]]) -> Self {
        let lower = LowerHalf::new(pattern);
        let coarse = Coarse::new(&lower, rest, MOST_CORNERS);
        let starts = (0..pattern.rows()).map(|row| pattern.row(row).start as u32);
        let blocks = BlockPattern {
            starts: starts.chain([pattern.blocks() as u32]).collect(),
            columns: pattern.columns.clone(),
        };
        let grid = CoarseGrid {
            corners: coarse.residual.len(),
            corners_of: coarse.grid.nodes.iter().map(|point| coarse.grid.cells[point.cell as usize]).collect(),
            weights: coarse.grid.nodes.iter().map(|point| point.weights()).collect(),
        };
        let solver = device().map_err(Clone::clone);
        let solver = solver.and_then(|device| ConjugateGradients::new(device, &blocks, Some(&grid)));
        Self { solver, lower, coarse, scale: 1.0, inverses: vec![[[0.0; 3]; 3]; pattern.rows()] }
    }

    /// Scales the matrix into the range of single precision, and inverts its diagonal blocks.
    fn set_scale<T: Real>(&mut self, values: &[Block<T, 3>]) -> Result<(), Breakdown> {
        self.scale = single_precision_scale(values, &self.lower.diagonal)?;
        for (inverse, &block) in self.inverses.iter_mut().zip(&self.lower.diagonal) {
            *inverse = invert(&values[block as usize].map(|row| row.map(|entry| entry.as_f64() * self.scale)))?;
        }
        Ok(())
    }

    fn send<T: Real>(&mut self, values: &[Block<T, 3>], has_new_coarse: bool) -> Result<(), DeviceError> {
        let Self { solver, coarse, scale, inverses, .. } = self;
        let solver = solver.as_mut().map_err(|error| error.clone())?;
        let scaled = |block: usize| values[block].map(|row| row.map(|entry| entry.as_f64() * *scale));
        solver.set_matrix(scaled, |row| inverses[row])?;
        if has_new_coarse {
            let inverse: Vec<N> = coarse.inverse().iter().map(|entry| N::of(f64::from(*entry))).collect();
            solver.set_coarse(&inverse, &coarse.free)?;
        }
        solver.set_coarse_weight(f64::from(coarse.weight));
        Ok(())
    }
}

impl<T: Real, N: Number> ApproximateInverse<T> for OnDevice<N> {
    fn prepare(&mut self, values: &[Block<T, 3>]) -> Result<(), Breakdown> {
        self.set_scale(values)?;
        let has_new_coarse = self.coarse.prepare(&self.lower, values, self.scale);
        self.send(values, has_new_coarse).map_err(|error| breakdown(&error))
    }

    fn correct(&mut self, r: &[[T; 3]], x: &mut [[T; 3]], tolerance: f64) -> Result<usize, Breakdown> {
        let size = norm(r);
        if !(size > 0.0 && size.is_finite()) {
            return if size == 0.0 { Ok(0) } else { Err(Breakdown::Singular) };
        }
        let solver = self.solver.as_mut().map_err(|error| breakdown(error))?;
        let b = r.as_flattened().iter().map(|entry| entry.as_f64() / size);
        let (solved, d) = solver.solve(b, tolerance, MAX_ITERATIONS).map_err(|error| breakdown(&error))?;
        let has_converged = solved.outcome == Outcome::Converged;
        self.coarse.record_effort(has_converged.then_some(solved.iterations), tolerance);
        match solved.outcome {
            Outcome::Converged | Outcome::Stagnated => {}
            Outcome::NegativeCurvature => return Err(Breakdown::NotPositiveDefinite),
            Outcome::NotFinite => return Err(Breakdown::Singular),
        }
        for (x, d) in x.as_flattened_mut().iter_mut().zip(&d) {
            *x += T::of(d.as_f64() * size * self.scale);
        }
        if has_converged { Ok(solved.iterations) } else { Err(Breakdown::NotConverged { residual: solved.residual }) }
    }

    fn smallest_tolerance(&self) -> f64 {
        if N::IS_DOUBLE { 1e-14 } else { 1e-4 }
    }

    /// Block Jacobi, for conjugate gradients on the processor where single precision is exhausted.
    fn apply(&mut self, r: &[[T; 3]], z: &mut [[T; 3]]) {
        for ((z, r), inverse) in z.iter_mut().zip(r).zip(&self.inverses) {
            let r = r.map(T::as_f64);
            *z = inverse.map(|row| T::of(self.scale * (row[0] * r[0] + row[1] * r[1] + row[2] * r[2])));
        }
    }

    fn save(&self, _is_kept: bool, history: &mut History) {
        self.coarse.save(history);
    }

    fn restore(&mut self, _is_kept: bool, history: &History) -> Result<(), String> {
        self.coarse.restore(history)
    }

    /// The coarse matrix may be that of an earlier matrix; it is restored.
    fn prepare_again(&mut self, values: &[Block<T, 3>]) -> Result<(), Breakdown> {
        self.set_scale(values)?;
        self.send(values, true).map_err(|error| breakdown(&error))
    }

    /// Bytes on the device, and of the coarse grid here.
    fn bytes(&self) -> usize {
        let on_device = self.solver.as_ref().map_or(0, |solver| solver.bytes());
        on_device + self.coarse.bytes() + self.lower.bytes() + size_of_val(&self.inverses[..])
    }
}

fn breakdown(error: &DeviceError) -> Breakdown {
    match error {
        DeviceError::TooLarge { .. } => Breakdown::DeviceTooSmall,
        DeviceError::NoAdapter(_) | DeviceError::NoDoublePrecision(_) | DeviceError::Failed { .. } => {
            Breakdown::DeviceFailed
        }
    }
}

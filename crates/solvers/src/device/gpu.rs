//! Conjugate gradients on a graphics device, as a solver of the engine.

use std::sync::{Arc, OnceLock};

use fem_gpu::{BlockPattern, CoarseGrid, ConjugateGradients, Device, DeviceError, Matrix, Number, Outcome, Stiffness};
use fem_model::Precision;
use fem_model::simulation::{Breakdown, History};

use crate::assembly::{Assembly, DeviceElements};
use crate::block::invert;
use crate::preconditioners::{Coarse, LowerHalf, single_precision_scale};
use crate::{ApproximateInverse, Memory};
use fem_elements::Real;
use fem_elements::history::{put_option, take_option};
use fem_elements::sparse::{Block, Pattern};
use fem_elements::vector::norm;

/// The largest number of iterations of one correction.
const MAX_ITERATIONS: usize = 2000;

/// Largest number of corners of the coarse grid, whose matrix is inverted.
const MOST_CORNERS: usize = 400;

/// The device of this process, opened when a scene first asks for it.
pub fn device() -> Result<&'static Arc<Device>, &'static DeviceError> {
    static DEVICE: OnceLock<Result<Arc<Device>, DeviceError>> = OnceLock::new();
    DEVICE.get_or_init(Device::open).as_ref()
}

/// Name of the graphics device, or the reason why there is none.
pub fn name() -> Result<String, String> {
    device().map(|device| device.adapter().to_owned()).map_err(|error| error.to_string())
}

/// Returns true if the device is a program on the processor, such as Mesa's llvmpipe.
pub fn is_software() -> bool {
    device().is_ok_and(|device| device.is_software())
}

/// Returns the reason why no system can be solved on a device in this precision.
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
    /// The assembly of the elements, where the device does it; an error appears when a matrix is assembled.
    elements: Option<Result<Elements<N>, DeviceError>>,
    blocks: BlockPattern,
    lower: LowerHalf,
    coarse: Coarse,
    /// The number that the matrix is multiplied by.
    scale: f64,
    /// Inverses of the diagonal blocks of a matrix that the processor has assembled, scaled.
    inverses: Vec<Block<f64, 3>>,
}

/// The assembly on the device.
struct Elements<N: Number> {
    stiffness: Stiffness<N>,
    /// Bounds of a diagonal entry, see [`DeviceElements`].
    largest: [f64; 2],
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
        let inverses = vec![[[0.0; 3]; 3]; pattern.rows()];
        Self { solver, elements: None, blocks, lower, coarse, scale: 1.0, inverses }
    }

    /// Inverts the diagonal blocks of the scaled matrix.
    fn invert_diagonal<T: Real>(&mut self, values: &[Block<T, 3>]) -> Result<(), Breakdown> {
        for (inverse, &block) in self.inverses.iter_mut().zip(&self.lower.diagonal) {
            *inverse = invert(&values[block as usize].map(|row| row.map(|entry| entry.as_f64() * self.scale)))?;
        }
        Ok(())
    }

    fn send<T: Real>(&mut self, values: &[Block<T, 3>]) -> Result<(), DeviceError> {
        let Self { solver, scale, .. } = self;
        let solver = solver.as_mut().map_err(|error| error.clone())?;
        solver.set_matrix(|block| values[block].map(|row| row.map(|entry| entry.as_f64() * *scale)))
    }

    /// Sends the coarse grid, whose factor may have changed.
    fn send_coarse(&mut self, is_new: bool) -> Result<(), DeviceError> {
        let Self { solver, coarse, .. } = self;
        let solver = solver.as_mut().map_err(|error| error.clone())?;
        if is_new {
            let inverse: Vec<N> = coarse.inverse().iter().map(|entry| N::of(f64::from(*entry))).collect();
            solver.set_coarse(&inverse, &coarse.free)?;
        }
        solver.set_coarse_weight(f64::from(coarse.weight));
        Ok(())
    }

    /// Builds the data that the device needs to assemble matrices.
    fn build_elements(&self, elements: &DeviceElements) -> Result<Elements<N>, DeviceError> {
        let solver = self.solver.as_ref().map_err(|error| error.clone())?;
        let DeviceElements { nodes, tetrahedra, law, moduli, masses, largest } = elements;
        let stiffness = Stiffness::new(solver, &self.blocks, *nodes, tetrahedra, *law, moduli, masses)?;
        Ok(Elements { stiffness, largest: *largest })
    }

    fn assemble_on_device<T: Real>(&mut self, matrix: &Assembly<T>) -> Result<(), DeviceError> {
        let Self { solver, elements, scale, .. } = self;
        let solver = solver.as_mut().map_err(|error| error.clone())?;
        let elements = elements.as_ref().expect("a solver without elements does not assemble");
        let Elements { stiffness, largest: [of_stiffness, of_mass] } =
            elements.as_ref().map_err(|error| error.clone())?;
        let factors: f64 = matrix.stiffness.iter().map(|(factor, _)| factor.as_f64()).sum();
        *scale = power_of_two(1.0 / (factors * *of_stiffness + matrix.mass.as_f64() * *of_mass));
        let vectors = |of: &[[T; 3]]| -> Vec<[f64; 3]> { of.iter().map(|of| of.map(|x| x.as_f64())).collect() };
        let stiffness_at: Vec<_> = matrix.stiffness.iter().map(|&(factor, u)| (factor.as_f64(), vectors(u))).collect();
        let block =
            |(number, block): &(usize, Block<T, 3>)| (*number, block.map(|row| row.map(|entry| entry.as_f64())));
        let others: Vec<_> = matrix.others.iter().map(block).collect();
        let sum = Matrix {
            stiffness: &stiffness_at,
            mass: matrix.mass.as_f64(),
            others: &others,
            free: &vectors(matrix.free),
            scale: *scale,
        };
        stiffness.assemble(solver, &sum)?;
        let is_new = self.coarse.needs_factor();
        let values = if is_new { self.read()? } else { Vec::new() };
        self.coarse.prepare(&self.lower, &values, self.scale);
        self.send_coarse(is_new)
    }

    /// The matrix on the device.
    fn read(&self) -> Result<Vec<Block<f64, 3>>, DeviceError> {
        let solver = self.solver.as_ref().map_err(|error| error.clone())?;
        let blocks = solver.matrix()?;
        Ok(blocks.into_iter().map(|block| block.map(|row| row.map(|entry| entry / self.scale))).collect())
    }
}

/// The nearest power of two below, with which no product has a rounding error.
fn power_of_two(scale: f64) -> f64 {
    scale.log2().floor().exp2()
}

impl<T: Real, N: Number> Memory<T> for OnDevice<N> {
    fn save(&self, _is_kept: bool, history: &mut History) {
        self.coarse.save(history);
        put_option(history, "device.scale", Some(self.scale));
    }

    fn restore(&mut self, _is_kept: bool, history: &History) -> Result<(), String> {
        self.scale = take_option(history, "device.scale")?.unwrap_or(1.0);
        self.coarse.restore(history)
    }

    /// The scale is that of the time, and the coarse matrix may be that of an earlier matrix: both are restored.
    fn prepare_again(&mut self, values: &[Block<T, 3>]) -> Result<(), Breakdown> {
        self.invert_diagonal(values)?;
        self.send(values).and_then(|()| self.send_coarse(true)).map_err(|error| breakdown(&error))
    }
}

impl<T: Real, N: Number> ApproximateInverse<T> for OnDevice<N> {
    fn prepare(&mut self, values: &[Block<T, 3>]) -> Result<(), Breakdown> {
        self.scale = power_of_two(single_precision_scale(values, &self.lower.diagonal)?);
        self.invert_diagonal(values)?;
        let is_new = self.coarse.prepare(&self.lower, values, self.scale);
        self.send(values).and_then(|()| self.send_coarse(is_new)).map_err(|error| breakdown(&error))
    }

    fn set_elements(&mut self, elements: &DeviceElements) {
        self.elements = Some(self.build_elements(elements));
    }

    fn assembles(&self) -> bool {
        self.elements.is_some()
    }

    fn assemble(&mut self, matrix: &Assembly<T>) -> Result<(), Breakdown> {
        self.assemble_on_device(matrix).map_err(|error| breakdown(&error))
    }

    fn assembled(&self) -> Result<Vec<Block<T, 3>>, Breakdown> {
        let blocks = self.read().map_err(|error| breakdown(&error))?;
        Ok(blocks.into_iter().map(|block| block.map(|row| row.map(T::of))).collect())
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

    /// Bytes on the device, and of the coarse grid here.
    fn bytes(&self) -> usize {
        let on_device = self.solver.as_ref().map_or(0, |solver| solver.bytes());
        let on_device =
            on_device + self.elements.iter().flatten().map(|elements| elements.stiffness.bytes()).sum::<usize>();
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

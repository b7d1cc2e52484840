//! Conjugate gradients on a device: Hestenes and Stiefel, Methods of conjugate gradients for solving linear systems (1952), preconditioned
//! by a Chebyshev polynomial (Saad, Iterative methods for sparse linear systems (2003), algorithm 12.1) and a coarse grid.
//!
//! An iteration is a list of kernels. Its scalars stay on the device, and are looked at after every sixteen iterations.

mod blocks;
mod kernels;

use std::sync::Arc;

use wgpu::Buffer;

use crate::matrix::{BlockPattern, SLICE, Slices};
use crate::program::{GROUP, Kernel};
use crate::{Device, DeviceError, Number};

/// Most iterations between two looks at the residual. The first look comes where the last solve has ended.
const LOOK: usize = 16;

/// Looks without a smaller residual after which the number type is exhausted.
const STAGNATION: usize = 4;

/// Words of `numbers` and `counts` in the shader.
const NUMBERS: usize = 8;
const COUNTS: usize = 4;

/// Functions of a coarse grid: each node has a share in eight corners.
#[derive(Clone, Debug)]
pub struct CoarseGrid {
    /// Number of corners.
    pub corners: usize,
    /// Corners of each node.
    pub corners_of: Vec<[u32; 8]>,
    /// Its shares in them.
    pub weights: Vec<[f32; 8]>,
}

/// Outcome of a solve.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// The residual is small enough.
    Converged,
    /// The residual falls no further.
    Stagnated,
    /// The curvature along a direction is negative: the matrix is not positive definite.
    NegativeCurvature,
    /// A number is not finite.
    NotFinite,
}

/// The end of a solve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Solved {
    /// Outcome of the solve.
    pub outcome: Outcome,
    /// Iterations.
    pub iterations: usize,
    /// Residual over that at the start.
    pub residual: f64,
}

/// A solver for matrices of one pattern.
pub struct ConjugateGradients<T: Number> {
    device: Arc<Device>,
    rows: usize,
    pub(crate) slices: Slices,
    arrays: Arrays,
    landing: Buffer,
    landing_x: Buffer,
    /// The inverses of the diagonal blocks.
    invert: Kernel,
    /// One iteration, from a step along the direction of the last one to the length of the next.
    iteration: Vec<Kernel>,
    /// Numbers of the matrix in their slices.
    values: Vec<T>,
    coarse_weight: f64,
    /// Iterations of the last solve.
    expected: usize,
    bytes: u64,
}

/// The arrays that the processor writes or reads.
struct Arrays {
    values: Buffer,
    inverses: Buffer,
    x: Buffer,
    r: Buffer,
    p: Buffer,
    q: Buffer,
    numbers: Buffer,
    counts: Buffer,
    /// Flag: a diagonal block is not positive definite.
    is_indefinite: Buffer,
    free: Buffer,
    coarse_inverse: Buffer,
}

impl<T: Number> ConjugateGradients<T> {
    /// Builds arrays and kernels on a device.
    pub fn new(device: &Arc<Device>, pattern: &BlockPattern, coarse: Option<&CoarseGrid>) -> Result<Self, DeviceError> {
        let (rows, slices) = (pattern.rows(), Slices::new(pattern));
        let corners = coarse.map_or(0, |coarse| coarse.corners);
        let (groups, padded) = (rows.div_ceil(GROUP), rows.next_multiple_of(SLICE));
        let vector = |what| device.array::<T>(what, 3 * rows);
        let arrays = Arrays {
            values: device.array::<T>("the blocks of the matrix", slices.numbers())?,
            inverses: device.array::<T>("the diagonal blocks", 9 * padded)?,
            x: vector("the solution")?,
            r: vector("the residual")?,
            p: vector("the direction")?,
            q: vector("the product")?,
            numbers: device.array::<T>("numbers", NUMBERS)?,
            counts: device.array::<u32>("counts", COUNTS)?,
            is_indefinite: device.array::<u32>("a flag", 1)?,
            free: vector("the free directions")?,
            coarse_inverse: device.array::<T>("the inverse of the coarse matrix", 9 * corners * corners)?,
        };
        let diagonal = device.array_of("the diagonal", &slices.diagonal(pattern))?;
        let program = &kernels::program::<T>(device)?;
        let invert = kernels::invert(program, device, &arrays, (rows, groups), &diagonal)?;
        let iteration = kernels::of_iteration::<T>(program, device, &slices, &arrays, coarse, (rows, groups))?;
        Ok(Self {
            landing: device.landing((NUMBERS * size_of::<T>() + COUNTS * size_of::<u32>()) as u64)?,
            landing_x: device.landing((3 * rows * size_of::<T>()) as u64)?,
            bytes: ((slices.numbers() + 9 * padded + 27 * rows + 9 * corners * corners) * size_of::<T>()) as u64,
            values: vec![T::zeroed(); slices.numbers()],
            device: Arc::clone(device),
            rows,
            slices,
            arrays,
            invert,
            iteration,
            coarse_weight: 0.0,
            expected: LOOK,
        })
    }

    /// Its device.
    pub(crate) fn device(&self) -> &Arc<Device> {
        &self.device
    }

    /// The numbers of the matrix on it.
    pub(crate) fn values(&self) -> &Buffer {
        &self.arrays.values
    }

    /// Sends the inverse of the coarse matrix, row by row, and the free directions of the rows: 1, or 0 for a constrained one.
    pub fn set_coarse(&mut self, inverse: &[T], free: &[[f32; 3]]) -> Result<(), DeviceError> {
        let free: Vec<T> = free.as_flattened().iter().map(|free| T::of(f64::from(*free))).collect();
        self.device.write(&self.arrays.coarse_inverse, inverse);
        self.device.write(&self.arrays.free, &free);
        self.device.check()
    }

    /// Weight of the coarse correction in the preconditioner.
    pub fn set_coarse_weight(&mut self, weight: f64) {
        self.coarse_weight = weight;
    }

    /// Solves A x = b from x = 0 until ‖b − A x‖ ≤ `tolerance` ‖b‖, within `most` iterations. ‖b‖ = 1, so that no number leaves the range of
    /// its type. The solution is read whatever the outcome.
    pub fn solve(
        &mut self,
        b: impl Iterator<Item = f64>,
        tolerance: f64,
        most: usize,
    ) -> Result<(Solved, Vec<T>), DeviceError> {
        self.start(b, tolerance);
        let (mut solved, mut best, mut looks) = (None, f64::INFINITY, 0);
        let mut batch = self.expected.clamp(1, LOOK);
        while solved.is_none() {
            let (numbers, counts) = self.iterate(batch)?;
            batch = LOOK;
            let [_, pq, _, _, rr, _, pp, _] = numbers;
            let (iterations, residual) = (counts[0] as usize, rr.sqrt());
            looks = if rr < best { 0 } else { looks + 1 };
            best = best.min(rr);
            let outcome = match counts[1] {
                _ if !rr.is_finite() || !pq.is_finite() => Some(Outcome::NotFinite),
                1 => Some(Outcome::Converged),
                // The largest eigenvalue is about 1: beside it this curvature is rounding error.
                2 if pq.abs() <= 1e-5 * pp => Some(Outcome::Stagnated),
                2 => Some(Outcome::NegativeCurvature),
                _ if looks >= STAGNATION || iterations >= most => Some(Outcome::Stagnated),
                _ => None,
            };
            solved = outcome.map(|outcome| Solved { outcome, iterations, residual });
        }
        let solved = solved.expect("the loop ends with an outcome");
        self.expected = solved.iterations + 1;
        let mut commands = self.device.commands();
        commands.copy_buffer_to_buffer(&self.arrays.x, 0, &self.landing_x, 0, self.landing_x.size());
        self.device.submit(commands)?;
        let x = self.device.read(&self.landing_x, 3 * self.rows)?;
        Ok((solved, x))
    }

    fn start(&mut self, b: impl Iterator<Item = f64>, tolerance: f64) {
        let Self { arrays, device, .. } = self;
        let zero = vec![T::zeroed(); 3 * self.rows];
        let b: Vec<T> = b.map(T::of).collect();
        device.write(&arrays.r, &b);
        for vector in [&arrays.x, &arrays.p, &arrays.q] {
            device.write(vector, &zero);
        }
        let mut numbers = [T::zeroed(); NUMBERS];
        numbers[5] = T::of(tolerance * tolerance);
        numbers[7] = T::of(self.coarse_weight);
        device.write(&arrays.numbers, &numbers);
        device.write(&arrays.counts, &[0u32; COUNTS]);
    }

    /// Some iterations, and the scalars after them.
    fn iterate(&mut self, count: usize) -> Result<([f64; NUMBERS], Vec<u32>), DeviceError> {
        let Self { device, arrays, landing, iteration, .. } = self;
        let mut commands = device.commands();
        {
            let mut pass = commands.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
            for _ in 0..count {
                iteration.iter().for_each(|kernel| kernel.run(&mut pass));
            }
        }
        let of_numbers = (NUMBERS * size_of::<T>()) as u64;
        commands.copy_buffer_to_buffer(&arrays.numbers, 0, landing, 0, of_numbers);
        commands.copy_buffer_to_buffer(&arrays.counts, 0, landing, of_numbers, (COUNTS * size_of::<u32>()) as u64);
        device.submit(commands)?;
        let words: Vec<u32> = device.read(landing, landing.size() as usize / size_of::<u32>())?;
        let (numbers, counts) = words.split_at(of_numbers as usize / size_of::<u32>());
        let numbers: Vec<T> = bytemuck::pod_collect_to_vec(numbers);
        Ok((std::array::from_fn(|i| numbers[i].as_f64()), counts.to_vec()))
    }

    /// Memory on the device, bytes.
    pub fn bytes(&self) -> usize {
        self.bytes as usize
    }
}

//! Properties of solvers and of their parts, most on matrices of beams. They are not in the package: it would be compiled once more.

#![allow(non_snake_case)] // A, L and P are the names that the mathematics uses
#![allow(clippy::needless_range_loop)] // indices of matrices are the notation of the field

mod all;
mod beam;
mod blocks;
mod coarse;
mod direct;
mod orders;
mod parts;
mod slender;
mod sweeps;

use fem_elements::sparse::Block;
use fem_elements::vector::{norm, subtract_from};
use fem_solvers::{Real, Solver, SolverChoice};

use beam::Beam;

/// A beam, and the solver of its matrices.
fn beam<T: Real>(choice: SolverChoice, cells: usize) -> (Beam, Solver<T>) {
    let beam = Beam::new(cells, choice.stored());
    let solver = Solver::new(choice, &beam.pattern, &beam.rest);
    (beam, solver)
}

/// ‖b − A x‖ / ‖b‖
fn residual<T: Real>(beam: &Beam, values: &[Block<T, 3>], b: &[[T; 3]], x: &[[T; 3]]) -> f64 {
    let mut r = beam.times(values, x);
    subtract_from(b, &mut r);
    norm(&r) / norm(b)
}

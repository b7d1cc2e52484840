//! The number types for which solvers are compiled.
//!
//! A generic function is compiled anew in each crate that calls it, and a solver holds all methods. Its large functions are therefore
//! called through a trait with an implementation for each type, which is compiled once, here.

use std::sync::Arc;

use super::{Solver, SolverChoice};
use fem_elements::sparse::{Block, Pattern};
use fem_model::simulation::Breakdown;

/// The float that a whole simulation runs in. [`fem_elements::Real`] has its loops over elements; this trait adds its linear solvers, under
/// the same name, since code above both packages uses this one alone. Its functions are the bodies of [`Solver`]'s of the same names.
pub trait Real: fem_elements::Real {
    #[doc(hidden)]
    fn new(choice: SolverChoice, pattern: &Arc<Pattern>, rest: &[[f64; 3]]) -> Solver<Self>;
    #[doc(hidden)]
    fn for_directions(choice: SolverChoice, pattern: &Arc<Pattern>, rest: &[[f64; 3]]) -> Solver<Self>;
    #[doc(hidden)]
    fn prepare(solver: &mut Solver<Self>, values: &[Block<Self, 3>]) -> Result<(), Breakdown>;
    #[doc(hidden)]
    fn solve(
        solver: &mut Solver<Self>,
        values: &[Block<Self, 3>],
        b: &[[Self; 3]],
        x: &mut [[Self; 3]],
        tolerance: f64,
    ) -> Result<usize, Breakdown>;
    #[doc(hidden)]
    fn apply(solver: &mut Solver<Self>, r: &[[Self; 3]], z: &mut [[Self; 3]]);
}

macro_rules! compiled_for {
    ($($T:ty),*) => { $(
        impl Real for $T {
            fn new(choice: SolverChoice, pattern: &Arc<Pattern>, rest: &[[f64; 3]]) -> Solver<Self> {
                Solver::analysed(choice, pattern, rest)
            }

            fn for_directions(choice: SolverChoice, pattern: &Arc<Pattern>, rest: &[[f64; 3]]) -> Solver<Self> {
                Solver::analysed_for_directions(choice, pattern, rest)
            }

            fn prepare(solver: &mut Solver<Self>, values: &[Block<Self, 3>]) -> Result<(), Breakdown> {
                solver.prepare_or_fall_back(values)
            }

            fn solve(
                solver: &mut Solver<Self>,
                values: &[Block<Self, 3>],
                b: &[[Self; 3]],
                x: &mut [[Self; 3]],
                tolerance: f64,
            ) -> Result<usize, Breakdown> {
                solver.solve_or_fall_back(values, b, x, tolerance)
            }

            fn apply(solver: &mut Solver<Self>, r: &[[Self; 3]], z: &mut [[Self; 3]]) {
                solver.apply_inverse(r, z);
            }
        }
    )* };
}
compiled_for!(f32, f64);

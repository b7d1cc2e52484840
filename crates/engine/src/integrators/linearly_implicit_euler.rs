//! Linearly implicit Euler: one Newton step of implicit Euler from the old positions, (M + dt² K) v⁺ = M v + dt f(u); Baraff and
//! Witkin, Large Steps in Cloth Simulation (1998). First order; no energy, no line search. Pressure is that on the surface at the
//! start of the step.

use super::follower::Loads;
use super::momentum;
use crate::forces::acting::Acting;
use crate::forces::pulls::AnchorSpring;
use crate::model::state::State;
use crate::model::system::System;
use crate::newton::incremental_potential::{IncrementalPotential, Motion, Scratch};
use crate::number::Real;
use crate::solvers::Solver;
use crate::sparse::Block;
use fem_scene::simulation::{Cause, Counters};

/// Linearly implicit Euler with its solver and vectors.
pub struct LinearlyImplicitEuler<T: Real> {
    solver: Solver<T>,
    /// Largest relative residual of an iterative solver.
    tolerance: f64,
    values: Vec<Block<T, 3>>,
    loads: Loads<T>,
    scratch: Scratch<T>,
    inertial: Vec<[T; 3]>,
    right: Vec<[T; 3]>,
    step: Vec<[T; 3]>,
    led: Vec<[T; 3]>,
}

impl<T: Real> LinearlyImplicitEuler<T> {
    /// For a body, and matrices of so many blocks.
    pub fn new(solver: Solver<T>, tolerance: f64, system: &System<T>) -> Self {
        let zero = || vec![[T::default(); 3]; system.nodes()];
        Self {
            solver,
            tolerance,
            values: vec![[[T::default(); 3]; 3]; system.pattern.blocks()],
            loads: Loads::new(system, false),
            scratch: Scratch::new(system.nodes()),
            inertial: zero(),
            right: zero(),
            step: zero(),
            led: zero(),
        }
    }

    /// The linear solver.
    pub fn solver(&self) -> &Solver<T> {
        &self.solver
    }

    /// One step. After an error the state is what it was.
    pub fn step(
        &mut self,
        system: &System<T>,
        state: &mut State<T>,
        springs: &[AnchorSpring<T>],
        dt: f64,
        counters: &mut Counters,
    ) -> Result<(), Cause> {
        let Self { solver, values, loads, scratch, inertial, right, step, led, .. } = self;
        for (inertial, v) in inertial.iter_mut().zip(&state.v) {
            *inertial = v.map(|v| T::of(dt) * v);
        }
        led.fill([T::default(); 3]);
        loads.gather(system, 1.0, &state.u, led);
        system.lead(|motion| motion.fraction(state.time + dt), &state.u, led);
        let (motion, acting) = (Some(Motion::new(system, inertial, dt)), Acting { pulls: springs, load: None });
        let objective = loads.on(IncrementalPotential { system, acting, start: &state.u, motion });
        counters.force_assemblies += 1;
        objective.linear_slope(led, right, scratch);
        for right in right.as_flattened_mut() {
            *right = -*right;
        }
        step.fill([T::default(); 3]);
        prepare(&objective, step, solver, values, scratch, counters)?;
        step.copy_from_slice(inertial);
        solver.solve(values, right, step, self.tolerance).map_err(Cause::Solver)?;
        system.held.clear(step);
        for (step, led) in step.as_flattened_mut().iter_mut().zip(led.as_flattened()) {
            *step += *led;
        }
        momentum::restore(&objective, dt, step);
        let over_dt = T::of(1.0 / dt);
        for (node, step) in step.iter().enumerate() {
            for i in 0..3 {
                state.v[node][i] = step[i] * over_dt;
                state.u[node][i] += step[i];
            }
        }
        Ok(())
    }
}

/// The matrix is the Hessian where the step starts, at w = 0; projected where that is not positive definite.
fn prepare<T: Real>(
    objective: &IncrementalPotential<T>,
    w: &[[T; 3]],
    solver: &mut Solver<T>,
    values: &mut [Block<T, 3>],
    scratch: &mut Scratch<T>,
    counters: &mut Counters,
) -> Result<(), Cause> {
    let mut attempt = |projected: bool| {
        counters.stiffness_assemblies += 1;
        counters.factorizations += 1;
        counters.projections += if projected { objective.system.elements.count } else { 0 };
        objective.hessian(w, projected, values, scratch);
        solver.prepare(values)
    };
    attempt(false).or_else(|_| attempt(true)).map_err(Cause::Solver)
}

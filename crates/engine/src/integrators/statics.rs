//! Equilibrium: ∇V(u) = 0 at loads and prescribed motions that grow in equal parts, one in each step.

use super::follower::Loads;
use super::initial_guess::no_start;
use crate::forces::acting::Acting;
use crate::forces::pulls::AnchorSpring;
use crate::model::state::State;
use crate::model::system::System;
use crate::newton::Newton;
use crate::newton::incremental_potential::{IncrementalPotential, Scratch};
use crate::number::Real;
use crate::solvers::Solver;
use crate::sparse::Block;
use fem_scene::simulation::{Cause, Counters};

/// The search for equilibrium, with its vectors.
pub struct Statics<T: Real> {
    method: Method<T>,
    loads: Loads<T>,
    load_steps: usize,
    led: Vec<[T; 3]>,
    step: Vec<[T; 3]>,
}

enum Method<T: Real> {
    Linear(Box<Linear<T>>),
    Newton(Box<Newton<T>>),
}

/// K u = f is the whole problem.
struct Linear<T: Real> {
    solver: Solver<T>,
    tolerance: f64,
    values: Vec<Block<T, 3>>,
    scratch: Scratch<T>,
    rest: Vec<[T; 3]>,
    right: Vec<[T; 3]>,
    free: Vec<[T; 3]>,
}

/// A load step is halved this often before it is given up.
const HALVINGS: i32 = 10;

impl<T: Real> Statics<T> {
    /// For a body; a linear one keeps no more of `newton` than its solver.
    pub fn new(newton: Newton<T>, system: &System<T>, load_steps: usize) -> Self {
        let zero = || vec![[T::default(); 3]; system.nodes()];
        let is_linear = system.law.is_linear() && system.springs.is_empty() && system.pressures.is_empty();
        let method = if is_linear {
            Method::Linear(Box::new(Linear {
                tolerance: newton.limits().solver_tolerance,
                solver: newton.into_solver(),
                values: vec![[[T::default(); 3]; 3]; system.pattern.blocks()],
                scratch: Scratch::new(system.nodes()),
                rest: zero(),
                right: zero(),
                free: zero(),
            }))
        } else {
            Method::Newton(Box::new(newton))
        };
        Self { method, loads: Loads::new(system, true), load_steps, led: zero(), step: zero() }
    }

    /// The linear solver.
    pub fn solver(&self) -> &Solver<T> {
        match &self.method {
            Method::Linear(linear) => &linear.solver,
            Method::Newton(newton) => newton.solver(),
        }
    }

    /// Whether one solve is the whole of it.
    pub fn is_linear(&self) -> bool {
        matches!(self.method, Method::Linear(_))
    }

    /// Part of the loads that is applied after so many steps.
    pub fn fraction(&self, steps: usize) -> f64 {
        steps.min(self.load_steps) as f64 / self.load_steps as f64
    }

    /// What is known from earlier steps is of no use any more.
    pub fn forget(&mut self) {
        if let Method::Newton(newton) = &mut self.method {
            newton.forget();
        }
    }

    /// One load step. After an error the state is of no use. Says whether Newton's method has converged.
    pub fn step(
        &mut self,
        system: &System<T>,
        state: &mut State<T>,
        pulls: &[AnchorSpring<T>],
        counters: &mut Counters,
    ) -> Result<bool, Cause> {
        let (from, to) = (self.fraction(state.steps), self.fraction(state.steps + 1));
        let acting = Acting { pulls, load: None };
        let Self { method, loads, led, step, .. } = self;
        match method {
            Method::Linear(linear) => {
                linear.solve(system, acting, loads, to, led, counters)?;
                state.u.copy_from_slice(led);
                Ok(true)
            }
            Method::Newton(newton) => {
                let mut work = Work { newton, system, acting, loads, led, step };
                work.advance(&mut state.u, (from, to), counters)
            }
        }
    }
}

impl<T: Real> Linear<T> {
    /// Writes u into `u`: K u = f, where what is prescribed of u moves to the right-hand side.
    fn solve(
        &mut self,
        system: &System<T>,
        acting: Acting<T>,
        loads: &mut Loads<T>,
        fraction: f64,
        u: &mut [[T; 3]],
        counters: &mut Counters,
    ) -> Result<(), Cause> {
        let Self { solver, tolerance, values, scratch, rest, right, free } = self;
        loads.gather(system, fraction, rest, rest);
        let objective = loads.on(IncrementalPotential { system, acting, start: rest, motion: None });
        system.lead(|_| fraction, rest, u);
        counters.force_assemblies += 1;
        objective.linear_slope(u, right, scratch);
        for right in right.as_flattened_mut() {
            *right = -*right;
        }
        counters.stiffness_assemblies += 1;
        counters.factorizations += 1;
        objective.hessian(rest, false, values, scratch);
        solver.prepare(values).map_err(Cause::Solver)?;
        solver.solve(values, right, free, *tolerance).map_err(Cause::Solver)?;
        system.held.clear(free);
        for (u, free) in u.as_flattened_mut().iter_mut().zip(free.as_flattened()) {
            *u += *free;
        }
        Ok(())
    }
}

/// What a load step works on.
struct Work<'a, T: Real> {
    newton: &'a mut Newton<T>,
    system: &'a System<T>,
    acting: Acting<'a, T>,
    loads: &'a mut Loads<T>,
    led: &'a mut Vec<[T; 3]>,
    step: &'a mut Vec<[T; 3]>,
}

impl<T: Real> Work<'_, T> {
    /// From one part of the loads to another, in pieces where that is too far at once.
    fn advance(&mut self, u: &mut [[T; 3]], (from, to): (f64, f64), counters: &mut Counters) -> Result<bool, Cause> {
        let whole = to - from;
        let (mut at, mut piece) = (from, whole);
        let mut converged = true;
        loop {
            let next = if at + piece >= to - 1e-9 * whole { to } else { at + piece };
            let outcome = self.equilibrate(u, next, counters);
            let is_least = piece <= whole * 0.5f64.powi(HALVINGS);
            match outcome {
                Ok(reached) if reached || is_least => {
                    for (u, step) in u.as_flattened_mut().iter_mut().zip(self.step.as_flattened()) {
                        *u += *step;
                    }
                    converged &= reached;
                    at = next;
                    piece *= 2.0;
                }
                Err(cause) if is_least => return Err(cause),
                _ => piece *= 0.5,
            }
            if at >= to {
                return Ok(converged);
            }
        }
    }

    /// Writes into `step` what leads from u to equilibrium at a part of the loads.
    fn equilibrate(&mut self, u: &[[T; 3]], fraction: f64, counters: &mut Counters) -> Result<bool, Cause> {
        let Self { newton, system, acting, loads, led, step } = self;
        step.fill([T::default(); 3]);
        loads.gather(system, fraction, u, step);
        let objective = IncrementalPotential { system, acting: *acting, start: u, motion: None };
        system.lead(|_| fraction, u, led);
        newton.predict(&loads.on(objective), led, step, counters)?;
        if !newton.can_start(&loads.on(objective), step, counters) {
            step.copy_from_slice(led);
            if !newton.can_start(&loads.on(objective), step, counters) {
                return Err(no_start(system, u, led));
            }
        }
        loads.minimize(newton, objective, fraction, step, counters)
    }
}

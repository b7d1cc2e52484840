//! Static equilibrium along its path through limit points, where the load falls before it grows again: the arc-length method. Riks, An
//! Incremental Approach to the Solution of Snapping and Buckling Problems (1979); Crisfield, A Fast Incremental/Iterative Solution
//! Procedure That Handles "Snap-Through" (1981).
//!
//! The load factor λ is an unknown beside the displacements. A step starts along the tangent, and is corrected by Newton's method in
//! the plane normal to its increment: Ramm, Strategies for Tracing the Nonlinear Response Near Limit Points (1981).

use fem_model::simulation::{Cause, Counters, History};

use super::Convergence;
use crate::forces::{HessianKind, Moment};
use crate::model::system::System;
use crate::newton::NewtonLimits;
use crate::newton::incremental_potential::{Increment, IncrementalPotential, Workspace};
use fem_elements::history::{put, put_option, take, take_option};
use fem_elements::sparse::Block;
use fem_elements::vector::{axpy, dot, max_norm, norm};
use fem_solvers::{Real, Solver};

/// Largest number of iterations of a step, and the number with which the arc length is kept.
const ITERATIONS: (usize, usize) = (16, 4);

/// Largest arc length, in arc lengths of the first step.
const LARGEST: f64 = 4.0;

/// Largest number of times that an arc length is halved in a step.
const HALVINGS: usize = 12;

/// The method with its vectors and its solver, which must be able to solve indefinite systems.
pub struct ArcLength<T: Real> {
    pub solver: Solver<T>,
    limits: NewtonLimits,
    /// Number of steps in which the undeformed body's stiffness would take up the loads.
    load_steps: usize,
    load_factor: f64,
    /// Length of the next increment and of the first, m; `None` before the first step.
    lengths: Option<[f64; 2]>,
    /// The last increment, m.
    last: Vec<[T; 3]>,
    values: Vec<Block<T, 3>>,
    workspace: Workspace<T>,
    vectors: Vectors<T>,
}

/// Vectors of a step.
struct Vectors<T> {
    /// Displacements at the iterate, m.
    u: Vec<[T; 3]>,
    /// Increment of the step, m.
    increment: Vec<[T; 3]>,
    /// The loads at λ = 1, and minus the gradient of the energy, N.
    load: Vec<[T; 3]>,
    unbalanced: Vec<[T; 3]>,
    /// K⁻¹ times each of them, m, and the first one at the start of the step.
    of_load: Vec<[T; 3]>,
    of_unbalanced: Vec<[T; 3]>,
    tangent: Vec<[T; 3]>,
}

/// The quantities that the correction of a step keeps fixed.
#[derive(Clone, Copy, PartialEq)]
enum Constraint {
    ArcLength,
    LoadFactor,
}

impl<T: Real> ArcLength<T> {
    /// Allocates its vectors for a body.
    pub fn new(solver: Solver<T>, limits: NewtonLimits, system: &System<T>, load_steps: usize) -> Self {
        let zero = || vec![[T::default(); 3]; system.nodes()];
        let vectors = Vectors {
            u: zero(),
            increment: zero(),
            load: zero(),
            unbalanced: zero(),
            of_load: zero(),
            of_unbalanced: zero(),
            tangent: zero(),
        };
        let (values, workspace) =
            (vec![[[T::default(); 3]; 3]; system.pattern.blocks()], Workspace::new(system.nodes()));
        Self { solver, limits, load_steps, load_factor: 0.0, lengths: None, last: zero(), values, workspace, vectors }
    }

    /// The load factor of a state after so many steps.
    pub fn load_factor(&self, steps: usize) -> f64 {
        if steps == 0 { 0.0 } else { self.load_factor }
    }

    /// One step along the path. It ends at the full load where it would pass it, and stays there.
    pub fn step(
        &mut self,
        system: &System<T>,
        u: &mut [[T; 3]],
        (time, steps): (f64, usize),
        counters: &mut Counters,
    ) -> Result<Convergence, Cause> {
        if steps == 0 {
            (self.load_factor, self.lengths) = (0.0, None);
            self.last.fill([T::default(); 3]);
        }
        if self.load_factor == 1.0 {
            return Ok(Convergence::Converged);
        }
        self.find_tangent(system, u, time, counters)?;
        let tangent = norm(&self.vectors.tangent);
        if !(tangent > 0.0 && tangent.is_finite()) {
            return Err(self.stuck());
        }
        let [mut length, first] = self.lengths.unwrap_or([tangent / self.load_steps as f64; 2]);
        let forward = if dot(&self.last, &self.vectors.tangent) < 0.0 { -1.0 } else { 1.0 };
        for _ in 0..=HALVINGS {
            if let Some((load_factor, iterations)) = self.attempt(system, u, time, forward * length / tangent, counters)
            {
                axpy(1.0, &self.vectors.increment, u);
                self.last.copy_from_slice(&self.vectors.increment);
                self.load_factor = load_factor;
                let change = (ITERATIONS.1 as f64 / iterations as f64).sqrt().clamp(0.5, 2.0);
                self.lengths = Some([(length * change).min(LARGEST * first), first]);
                return Ok(Convergence::Converged);
            }
            length *= 0.5;
        }
        Err(self.stuck())
    }

    fn stuck(&self) -> Cause {
        Cause::Stuck { unbalanced: max_norm(&self.vectors.unbalanced) }
    }

    /// Writes K⁻¹ times the loads at u into the tangent.
    fn find_tangent(
        &mut self,
        system: &System<T>,
        u: &[[T; 3]],
        time: f64,
        counters: &mut Counters,
    ) -> Result<(), Cause> {
        self.vectors.u.copy_from_slice(u);
        self.evaluate(system, time, self.load_factor, counters);
        self.factorize(system, time, self.load_factor, counters).map_err(Cause::Solver)?;
        let Self { solver, vectors: Vectors { load, tangent, .. }, .. } = self;
        solver.apply(load, tangent);
        system.dirichlet.clear_constrained(tangent);
        Ok(())
    }

    /// Tries the step whose predictor changes the load factor by `change`; writes the increment, and returns the load factor
    /// and the number of iterations. Returns `None` if Newton's method does not converge.
    fn attempt(
        &mut self,
        system: &System<T>,
        u: &[[T; 3]],
        time: f64,
        change: f64,
        counters: &mut Counters,
    ) -> Option<(f64, usize)> {
        let Vectors { increment, tangent, .. } = &mut self.vectors;
        increment.fill([T::default(); 3]);
        axpy(change, tangent, increment);
        let mut load_factor = self.load_factor + change;
        let iterations = self.correct(system, u, time, &mut load_factor, Constraint::ArcLength, counters)?;
        if load_factor < 1.0 {
            return Some((load_factor, iterations));
        }
        let part = (1.0 - self.load_factor) / (load_factor - self.load_factor);
        self.vectors.increment.as_flattened_mut().iter_mut().for_each(|x| *x *= T::of(part));
        self.correct(system, u, time, &mut 1.0, Constraint::LoadFactor, counters).map(|iterations| (1.0, iterations))
    }

    /// Newton's method for the increment and the load factor; returns the number of iterations if it converges.
    fn correct(
        &mut self,
        system: &System<T>,
        u: &[[T; 3]],
        time: f64,
        load_factor: &mut f64,
        constraint: Constraint,
        counters: &mut Counters,
    ) -> Option<usize> {
        let tolerance = self.limits.tolerance * system.length;
        for iteration in 1..=ITERATIONS.0 {
            self.vectors.u.copy_from_slice(u);
            axpy(1.0, &self.vectors.increment, &mut self.vectors.u);
            if !(system.elements.min_det_F_of_barriers(&self.vectors.u).0.as_f64() > 0.0) {
                return None;
            }
            counters.newton_iterations += 1;
            self.evaluate(system, time, *load_factor, counters);
            self.factorize(system, time, *load_factor, counters).ok()?;
            let update = self.update(system, load_factor, constraint);
            if !(update.is_finite() && load_factor.is_finite()) {
                return None;
            }
            if update <= tolerance {
                return Some(iteration);
            }
        }
        None
    }

    /// Adds the correction to the increment and the load factor; returns its largest entry, m.
    fn update(&mut self, system: &System<T>, load_factor: &mut f64, constraint: Constraint) -> f64 {
        let Self { solver, vectors, .. } = self;
        let Vectors { increment, load, unbalanced, of_load, of_unbalanced, .. } = vectors;
        solver.apply(unbalanced, of_unbalanced);
        system.dirichlet.clear_constrained(of_unbalanced);
        if constraint == Constraint::ArcLength {
            solver.apply(load, of_load);
            system.dirichlet.clear_constrained(of_load);
            let change = -dot(increment, of_unbalanced) / dot(increment, of_load);
            axpy(change, of_load, of_unbalanced);
            *load_factor += change;
        }
        axpy(1.0, of_unbalanced, increment);
        max_norm(of_unbalanced)
    }

    /// Evaluates the loads and the residual at the iterate. Loads are proportional to the load factor.
    fn evaluate(&mut self, system: &System<T>, time: f64, load_factor: f64, counters: &mut Counters) {
        let Vectors { u, load, unbalanced, .. } = &mut self.vectors;
        let moment = |load_factor: f64| Moment { time, load_factor: Some(load_factor) };
        counters.force_assemblies += 2;
        system.gradient(u, moment(0.0), load);
        system.gradient(u, moment(1.0), unbalanced);
        for (load, unbalanced) in load.as_flattened_mut().iter_mut().zip(unbalanced.as_flattened_mut()) {
            let without = *load;
            *load = without - *unbalanced;
            *unbalanced = T::of(load_factor) * *load - without;
        }
        system.dirichlet.clear_constrained(load);
        system.dirichlet.clear_constrained(unbalanced);
    }

    /// Assembles and factors the Hessian at the iterate.
    fn factorize(
        &mut self,
        system: &System<T>,
        time: f64,
        load_factor: f64,
        counters: &mut Counters,
    ) -> Result<(), fem_model::simulation::Breakdown> {
        let Self { solver, values, workspace, vectors: Vectors { u, of_load, .. }, .. } = self;
        let increment = Increment { start: u, end: Moment { time, load_factor: Some(load_factor) }, inertia: None };
        let potential = IncrementalPotential { system, increment, followers: &[] };
        of_load.fill([T::default(); 3]);
        counters.stiffness_assemblies += 1;
        counters.factorizations += 1;
        potential.hessian(of_load, HessianKind::Exact, values, workspace);
        solver.prepare(values)
    }

    /// Adds the position on the path and its direction.
    pub fn save(&self, history: &mut History) {
        put(history, "arc_length.last", self.last.as_flattened());
        put_option(history, "arc_length.load_factor", Some(self.load_factor));
        put_option(history, "arc_length.length", self.lengths.map(|lengths| lengths[0]));
        put_option(history, "arc_length.first", self.lengths.map(|lengths| lengths[1]));
    }

    /// Restores the quantities that [`save`](Self::save) has added.
    pub fn restore(&mut self, history: &History) -> Result<(), String> {
        take(history, "arc_length.last", self.last.as_flattened_mut())?;
        self.load_factor = take_option(history, "arc_length.load_factor")?.unwrap_or(0.0);
        let length = take_option(history, "arc_length.length")?;
        let first = take_option(history, "arc_length.first")?;
        self.lengths = length.zip(first).map(|(length, first)| [length, first]);
        Ok(())
    }
}

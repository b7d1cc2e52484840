//! Projective dynamics: Bouaziz, Martin, Liu, Kavan and Pauly, Projective dynamics: fusing constraint projections for fast simulation
//! (2014), in the form of Liu, Bouaziz and Kavan, Quasi-Newton methods for real-time simulation of hyperelastic materials (2017).
//!
//! A round is w ← w − A⁻¹ ∇E(w) with the incremental potential E of the body's own law and the constant A = M/dt² + Σ V k ∇φ·∇φ,
//! k = 2μ + λ, which is factored once. For the corotated law with λ = 0 this is a local step (the rotation nearest to F) and a global step
//! of the method of 2014, equations 8 to 10. For other laws a line search decreases E in every round (2017, section 4), and rounds
//! converge to the same step of implicit Euler.

use fem_model::IterationSettings;
use fem_model::simulation::{Breakdown, Cause, Counters, History};

use super::initial_guess::infeasible;
use super::{Convergence, Integrator, Memory, momentum};
use crate::forces::{Energy, HessianKind, Moment};
use crate::model::state::State;
use crate::model::system::System;
use crate::newton::incremental_potential::{Increment, IncrementalPotential, Inertia, Workspace};
use fem_elements::sparse::Block;
use fem_elements::vector::{axpy, dot, max_norm};
use fem_solvers::{Real, Solver};

/// Sufficient decrease, Armijo (1966); part of the energy's terms that is rounding error, in units of the machine epsilon; and the
/// smallest step length that is tried.
const DECREASE: f64 = 1e-4;
const ROUND_OFF: f64 = 32.0;
const SHORTEST: f64 = 1e-8;

/// Projective dynamics with the factor for all rounds of all steps.
pub struct ProjectiveDynamics<T: Real> {
    settings: IterationSettings,
    solver: Solver<T>,
    values: Vec<Block<T, 3>>,
    workspace: Workspace<T>,
    inertial: Vec<[T; 3]>,
    increment: Vec<[T; 3]>,
    next: Vec<[T; 3]>,
    gradient: Vec<[T; 3]>,
    next_gradient: Vec<[T; 3]>,
    direction: Vec<[T; 3]>,
    /// The step that the factor is for, s; `None` if there is no factor.
    factored_for: Option<f64>,
}

impl<T: Real> ProjectiveDynamics<T> {
    /// Allocates its vectors for a body.
    pub fn new(settings: IterationSettings, solver: Solver<T>, system: &System<T>) -> Self {
        let zero = || vec![[T::default(); 3]; system.nodes()];
        Self {
            settings,
            solver,
            values: vec![[[T::default(); 3]; 3]; system.pattern.blocks()],
            workspace: Workspace::new(system.nodes()),
            inertial: zero(),
            increment: zero(),
            next: zero(),
            gradient: zero(),
            next_gradient: zero(),
            direction: zero(),
            factored_for: None,
        }
    }

    /// Assembles and factors the matrix of the global step, that of the undeformed body.
    fn factor(&mut self, system: &System<T>, inertia: &Inertia<T>, dt: f64) -> Result<(), Breakdown> {
        let values = &mut self.values;
        values.fill([[T::default(); 3]; 3]);
        system.profile.stiffness.time(|| system.elements.add_metric(values));
        for spring in system.forces.all().flat_map(|(force, _)| force.springs()) {
            spring.add_metric(&system.pattern, values);
        }
        let undeformed = vec![[T::default(); 3]; system.nodes()];
        system.add_external_hessian(&undeformed, Moment::at(0.0), HessianKind::Projected, values);
        let mass = inertia.over_dt2 + inertia.damping.map_or(T::default(), |rates| rates.mass);
        system.mass.add_to(mass, &system.pattern, values);
        system.dirichlet.eliminate(&system.pattern, values);
        self.factored_for = None;
        self.solver.prepare(&self.values)?;
        self.factored_for = Some(dt);
        Ok(())
    }

    /// One round. Returns the size of the change, m; zero where rounding error allows no further decrease.
    fn round(&mut self, potential: &IncrementalPotential<T>, energy: &mut Energy, counters: &mut Counters) -> f64 {
        self.direction.fill([T::default(); 3]);
        self.solver.apply(&self.gradient, &mut self.direction);
        for entry in self.direction.as_flattened_mut() {
            *entry = -*entry;
        }
        counters.solver_iterations += 1;
        let derivative = dot(&self.gradient, &self.direction);
        let mut length = 1.0;
        // NaN ends the search.
        while derivative < 0.0 && length >= SHORTEST {
            self.next.copy_from_slice(&self.increment);
            axpy(length, &self.direction, &mut self.next);
            counters.energy_evaluations += 1;
            counters.force_assemblies += 1;
            let found = potential.energy_and_gradient(&self.next, &mut self.next_gradient, &mut self.workspace);
            if self.is_lower(potential, (*energy, found), (length, derivative)) {
                *energy = found;
                std::mem::swap(&mut self.increment, &mut self.next);
                std::mem::swap(&mut self.gradient, &mut self.next_gradient);
                return length * max_norm(&self.direction);
            }
            counters.line_search_backtracks += 1;
            length *= 0.5;
        }
        0.0
    }

    /// Returns true if the energy decreases enough; where its change is rounding error, the directional derivative decides.
    fn is_lower(
        &mut self,
        potential: &IncrementalPotential<T>,
        (before, after): (Energy, Energy),
        (length, derivative): (f64, f64),
    ) -> bool {
        let change = after.value - before.value;
        if change <= DECREASE * length * derivative {
            return true;
        }
        let cancelled = potential.cancelled(&self.increment, &mut self.workspace);
        let round_off = ROUND_OFF * T::EPSILON.as_f64() * (before.terms + after.terms + cancelled);
        let is_flatter = dot(&self.next_gradient, &self.direction).abs() <= 0.9 * derivative.abs();
        change.is_finite() && change.abs() <= round_off && is_flatter
    }

    /// The rounds of a step. Returns whether they have reached the tolerance, if there is one.
    fn rounds(
        &mut self,
        potential: &IncrementalPotential<T>,
        dt: f64,
        counters: &mut Counters,
    ) -> Result<Convergence, Cause> {
        let IncrementalPotential { system, increment: Increment { end, inertia, .. }, .. } = *potential;
        let Some(inertia) = inertia else { return Ok(Convergence::Converged) };
        if self.factored_for != Some(dt) {
            counters.stiffness_assemblies += 1;
            counters.factorizations += 1;
            self.factor(system, &inertia, dt).map_err(Cause::Solver)?;
        }
        let mut energy = self.start(potential, (inertia.inertial, end), counters)?;
        let tolerance = self.settings.tolerance.unwrap_or(0.0);
        let mut has_settled = self.settings.tolerance.is_none();
        for _ in 0..self.settings.count {
            let change = self.round(potential, &mut energy, counters);
            if change <= tolerance * max_norm(&self.increment) {
                has_settled = true;
                break;
            }
        }
        momentum::restore(potential, dt, 1.0, &mut self.increment);
        Ok(if has_settled { Convergence::Converged } else { Convergence::NotConverged })
    }

    /// Sets the initial guess of the rounds: the inertial displacements, or the prescribed motion alone if its incremental potential is
    /// lower. Otherwise a small number of rounds could give a stiff body more energy in each step.
    fn start(
        &mut self,
        potential: &IncrementalPotential<T>,
        (inertial, end): (&[[T; 3]], Moment),
        counters: &mut Counters,
    ) -> Result<Energy, Cause> {
        let IncrementalPotential { system, increment: Increment { start, .. }, .. } = *potential;
        counters.energy_evaluations += 2;
        counters.force_assemblies += 2;
        self.next.fill([T::default(); 3]);
        system.prescribe(start, end, &mut self.next);
        let still = potential.energy_and_gradient(&self.next, &mut self.next_gradient, &mut self.workspace);
        self.increment.copy_from_slice(inertial);
        system.prescribe(start, end, &mut self.increment);
        let moving = potential.energy_and_gradient(&self.increment, &mut self.gradient, &mut self.workspace);
        if moving.value.is_finite() && !(still.value < moving.value) {
            return Ok(moving);
        }
        std::mem::swap(&mut self.increment, &mut self.next);
        std::mem::swap(&mut self.gradient, &mut self.next_gradient);
        if still.value.is_finite() { Ok(still) } else { Err(infeasible(system, start, &self.increment)) }
    }
}

impl<T: Real> Memory for ProjectiveDynamics<T> {
    fn accept(&mut self) {}

    fn forget(&mut self) {
        self.factored_for = None;
    }

    fn forget_forces(&mut self) {
        self.factored_for = None;
    }

    /// The factor is that of the undeformed body, and computed again.
    fn save(&self, _: &mut History) {}

    fn restore(&mut self, _: &History) -> Result<(), String> {
        Ok(())
    }
}

impl<T: Real> Integrator<T> for ProjectiveDynamics<T> {
    fn step(
        &mut self,
        system: &System<T>,
        state: &mut State<T>,
        dt: f64,
        counters: &mut Counters,
    ) -> Result<Convergence, Cause> {
        for (inertial, v) in self.inertial.iter_mut().zip(&state.v) {
            *inertial = v.map(|v| T::of(dt) * v);
        }
        let inertial = std::mem::take(&mut self.inertial);
        let (inertia, end) = (Inertia::new(system, &inertial, dt), Moment::at(state.time + dt));
        let increment = Increment { start: &state.u, end, inertia: Some(inertia) };
        let potential = IncrementalPotential { system, increment, followers: &[] };
        let outcome = self.rounds(&potential, dt, counters);
        self.inertial = inertial;
        let convergence = outcome?;
        for ((u, v), w) in state.u.iter_mut().zip(&mut state.v).zip(&self.increment) {
            for i in 0..3 {
                u[i] += w[i];
                v[i] = w[i] * T::of(1.0 / dt);
            }
        }
        Ok(convergence)
    }

    fn solver(&self) -> Option<&Solver<T>> {
        Some(&self.solver)
    }

    fn may_stop_early(&self) -> bool {
        self.settings.tolerance.is_none()
    }
}

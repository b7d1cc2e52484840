//! Reactions: the forces of the constraints on the body, M a − f over the constrained degrees of freedom. The reaction of a free node
//! is zero.

use fem_model::DirichletCondition;
use fem_model::simulation::Reaction;

use crate::forces::Moment;
use crate::model::state::State;
use crate::model::system::System;
use fem_elements::vector::{scale, set_zero, subtract_from, triple};
use fem_solvers::Real;

/// One for each Dirichlet condition, zero if its nodes have been released. The acceleration is the mean of the last step, which began at
/// `before`, as does the damping matrix.
pub fn reactions<T: Real>(system: &System<T>, before: &State<T>, state: &State<T>, moment: Moment) -> Vec<Reaction> {
    let mut unbalanced = Unbalanced::default();
    unbalanced.at_end(system, before, End::of(state), moment);
    of_unbalanced(system, &unbalanced.force)
}

/// Reactions at the stage after the fraction `part` of the last step, with the accelerations there (m/s²).
pub fn reactions_at<T: Real>(
    system: &System<T>,
    before: &State<T>,
    state: &State<T>,
    stage: (f64, &[[T; 3]]),
) -> Vec<Reaction> {
    let mut unbalanced = Unbalanced::default();
    unbalanced.at_stage(system, before, End::of(state), stage);
    of_unbalanced(system, &unbalanced.force)
}

/// The end of a step.
#[derive(Clone, Copy)]
pub struct End<'a, T> {
    /// Displacements, m.
    pub u: &'a [[T; 3]],
    /// Velocities, m/s.
    pub v: &'a [[T; 3]],
    /// s
    pub time: f64,
}

impl<'a, T: Real> End<'a, T> {
    /// The state as it is.
    pub fn of(state: &'a State<T>) -> Self {
        Self { u: &state.u, v: &state.v, time: state.time }
    }
}

/// M a − f, and the memory that it takes to evaluate it.
#[derive(Clone, Debug, Default)]
pub struct Unbalanced<T> {
    /// N
    pub force: Vec<[T; 3]>,
    u: Vec<[T; 3]>,
    v: Vec<[T; 3]>,
}

impl<T: Real> Unbalanced<T> {
    /// Evaluates it at the stage after the fraction `part` of a step from `before`, with the accelerations there (m/s²).
    pub fn at_stage(
        &mut self,
        system: &System<T>,
        before: &State<T>,
        end: End<T>,
        (part, acceleration): (f64, &[[T; 3]]),
    ) {
        write_between(&before.u, end.u, part, &mut self.u);
        write_between(&before.v, end.v, part, &mut self.v);
        let time = (1.0 - part) * before.time + part * end.time;
        set_zero(&mut self.force, system.nodes());
        system.force(&self.u, &self.v, &self.u, Moment::at(time), &mut self.force);
        scale(-1.0, &mut self.force);
        system.mass.add_times(T::one(), acceleration, &mut self.force);
    }

    /// Evaluates it at a moment, with the mean acceleration of a step from `before`.
    pub fn at_end(&mut self, system: &System<T>, before: &State<T>, end: End<T>, moment: Moment) {
        let damping_at = &mut self.u;
        system.damping_displacements(before, end.time - before.time, damping_at);
        set_zero(&mut self.force, system.nodes());
        system.force(end.u, end.v, damping_at, moment, &mut self.force);
        scale(-1.0, &mut self.force);
        // There is no acceleration at the start, nor in equilibrium.
        if end.time > before.time {
            self.v.clone_from(&before.v);
            subtract_from(end.v, &mut self.v);
            system.mass.add_times(T::of(1.0 / (end.time - before.time)), &self.v, &mut self.force);
        }
    }
}

/// Writes (1 − part) x + part y.
pub fn write_between<T: Real>(x: &[[T; 3]], y: &[[T; 3]], part: f64, between: &mut Vec<[T; 3]>) {
    let mean = |x: T, y: T| T::of(1.0 - part) * x + T::of(part) * y;
    between.clear();
    between.extend(x.iter().zip(y).map(|(x, y)| triple(|i| mean(x[i], y[i]))));
}

fn of_unbalanced<T: Real>(system: &System<T>, force: &[[T; 3]]) -> Vec<Reaction> {
    let sum = |nodes: &[usize], components: [bool; 3]| {
        let along = |i: usize| nodes.iter().map(|&node| force[node][i].as_f64()).sum();
        triple(|i| if components[i] { along(i) } else { 0.0 })
    };
    let reaction = |(condition, applies): (&DirichletCondition, bool)| Reaction {
        name: condition.name.clone(),
        force: if applies { sum(&condition.nodes, condition.components) } else { [0.0; 3] },
    };
    system.dirichlet.conditions().map(reaction).collect()
}

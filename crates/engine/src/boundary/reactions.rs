//! Reactions: the forces of the constraints on the body, M a − f over the constrained degrees of freedom. The reaction of a free node
//! is zero.

use fem_scene::DirichletCondition;
use fem_scene::simulation::Reaction;

use crate::forces::Moment;
use crate::model::state::State;
use crate::model::system::System;
use fem_elements::Real;
use fem_elements::vector::triple;

/// One for each Dirichlet condition, zero if its nodes have been released. The acceleration is the mean of the last step, which began at
/// `before`, as does the damping matrix.
pub fn reactions<T: Real>(system: &System<T>, before: &State<T>, state: &State<T>, moment: Moment) -> Vec<Reaction> {
    of_unbalanced(system, &unbalanced(system, before, state, moment))
}

/// Reactions at the stage after the fraction `part` of the last step, with the accelerations there (m/s²).
pub fn reactions_at<T: Real>(
    system: &System<T>,
    before: &State<T>,
    state: &State<T>,
    stage: (f64, &[[T; 3]]),
) -> Vec<Reaction> {
    of_unbalanced(system, &unbalanced_at(system, before, state, stage))
}

/// M a − f at that stage, N.
pub fn unbalanced_at<T: Real>(
    system: &System<T>,
    before: &State<T>,
    state: &State<T>,
    (part, acceleration): (f64, &[[T; 3]]),
) -> Vec<[T; 3]> {
    let between = |before: &[[T; 3]], end: &[[T; 3]]| -> Vec<[T; 3]> {
        let mean = |a: T, b: T| T::of(1.0 - part) * a + T::of(part) * b;
        before.iter().zip(end).map(|(a, b)| triple(|i| mean(a[i], b[i]))).collect()
    };
    let (u, v) = (between(&before.u, &state.u), between(&before.v, &state.v));
    let time = (1.0 - part) * before.time + part * state.time;
    let mut unbalanced = vec![[T::default(); 3]; system.nodes()];
    system.force(&u, &v, &u, Moment::at(time), &mut unbalanced);
    for force in unbalanced.as_flattened_mut() {
        *force = -*force;
    }
    system.mass.add_times(T::one(), acceleration, &mut unbalanced);
    unbalanced
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

/// M a − f at a moment, with the mean acceleration of the last step, N.
pub fn unbalanced<T: Real>(system: &System<T>, before: &State<T>, state: &State<T>, moment: Moment) -> Vec<[T; 3]> {
    let mut unbalanced = vec![[T::default(); 3]; system.nodes()];
    let damping_at = system.damping_displacements(before, state.time - before.time);
    system.force(&state.u, &state.v, &damping_at, moment, &mut unbalanced);
    for force in unbalanced.as_flattened_mut() {
        *force = -*force;
    }
    // There is no acceleration at the start, nor in equilibrium.
    if state.time > before.time {
        let over_dt = T::of(1.0 / (state.time - before.time));
        let change = |(v, before): (&[T; 3], &[T; 3])| triple(|i| v[i] - before[i]);
        let change: Vec<[T; 3]> = state.v.iter().zip(&before.v).map(change).collect();
        system.mass.add_times(over_dt, &change, &mut unbalanced);
    }
    unbalanced
}

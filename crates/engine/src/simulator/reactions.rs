//! Forces where the body is held: M a + ∇V + C v, of which a free node has none.

use super::Simulator;
use crate::forces::acting::Acting;
use crate::number::Real;
use fem_scene::simulation::Reaction;

/// One for each table that holds nodes. The acceleration is the mean of the last step; K of the damping is that at its start.
pub(super) fn reactions<T: Real>(engine: &Simulator<T>) -> Vec<Reaction> {
    let force = nodal_forces(engine);
    let sum = |nodes: &[usize], holds: [bool; 3]| {
        let along = |i: usize| nodes.iter().map(|&node| force[node][i].as_f64()).sum();
        std::array::from_fn(|i| if holds[i] { along(i) } else { 0.0 })
    };
    let conditions = engine.system.held.conditions().iter();
    conditions.map(|c| Reaction { name: c.name.clone(), force: sum(&c.nodes, c.components) }).collect()
}

fn nodal_forces<T: Real>(engine: &Simulator<T>) -> Vec<[T; 3]> {
    let Simulator { system, state, last_good: before, .. } = engine;
    let mut force = vec![[T::default(); 3]; system.nodes()];
    let part = T::of(engine.stepper.load_fraction(state.steps));
    let pulls = engine.springs_now();
    system.gradient(&state.u, Acting { pulls: &pulls, load: None }, &mut force);
    system.add_pressures(-part, &state.u, &mut force);
    for (force, load) in force.iter_mut().zip(system.dead_load.iter().flatten()) {
        *force = std::array::from_fn(|i| force[i] - part * load[i]);
    }
    // At the start, and at equilibrium, nothing moves.
    if state.time > before.time {
        let over_dt = T::of(1.0 / (state.time - before.time));
        let change = |(v, before): (&[T; 3], &[T; 3])| std::array::from_fn(|i| v[i] - before[i]);
        let change: Vec<[T; 3]> = state.v.iter().zip(&before.v).map(change).collect();
        system.mass.add_times(over_dt, &change, &mut force);
    }
    if let Some(damping) = &system.damping {
        system.mass.add_times(T::of(damping.alpha), &state.v, &mut force);
        system.add_stiffness_times(T::of(damping.beta), &before.u, &state.v, &mut force);
    }
    force
}

//! Checkpoints of a simulator: its state, and the data that its integrator keeps from step to step.

use fem_model::simulation::{Checkpoint, History, Simulation};

use super::{Compiled, Simulator};
use crate::forces::Moment;
use fem_elements::history::{put, take};

/// The checkpoint of a simulator, in the mesh's numbering; the history is in the engine's.
pub(super) fn of<T: Compiled>(simulator: &Simulator<T>) -> Checkpoint {
    let u = simulator.system.numbering.to_mesh(&simulator.state.u);
    let mut history = History::default();
    // Reactions take their accelerations from the state before the last step, and its time shows a release.
    put(&mut history, "before.time", &[simulator.last_good.time]);
    put(&mut history, "before.u", simulator.last_good.u.as_flattened());
    put(&mut history, "before.v", simulator.last_good.v.as_flattened());
    history.put("numbering", [fingerprint(&simulator.system.numbering.mesh_node)]);
    history.put("unconverged_steps", [simulator.counters.unconverged_steps as f64]);
    if let Some(plasticity) = simulator.system.elements.plasticity() {
        plasticity.save(&mut history);
    }
    simulator.system.forces.save(&mut history);
    simulator.ledger.save(&mut history);
    simulator.last_forces.save(&mut history);
    if let Some(contact) = &simulator.contact {
        contact.save(&mut history);
    }
    if let Some(control) = &simulator.control {
        control.save(&mut history);
    }
    simulator.integrator.save(&mut history);
    Checkpoint {
        time: simulator.state.time,
        steps: simulator.state.steps,
        positions: simulator.positions().as_slice().to_vec(),
        velocities: simulator.velocities().as_slice().to_vec(),
        displacements: u.as_flattened().iter().map(|u| u.as_f64()).collect(),
        history,
    }
}

/// Restores a checkpoint of the same scene. After an error the simulator must be reset.
pub(super) fn restore<T: Compiled>(simulator: &mut Simulator<T>, checkpoint: &Checkpoint) -> Result<(), String> {
    let Checkpoint { displacements, velocities, .. } = checkpoint;
    let coordinates = 3 * simulator.system.nodes();
    for (name, list) in [("displacements", displacements), ("qdot", velocities)] {
        if list.len() != coordinates {
            return Err(format!("its `{name}` has {} numbers and not {coordinates}", list.len()));
        }
    }
    let (u, _) = displacements.as_chunks::<3>();
    let (v, _) = velocities.as_chunks::<3>();
    let mut numbering = [0.0];
    take(&checkpoint.history, "numbering", &mut numbering)?;
    if numbering != [fingerprint(&simulator.system.numbering.mesh_node)] {
        return Err("its history has another numbering of the nodes: another version has written it".to_owned());
    }
    simulator.set_state(u, v);
    (simulator.state.time, simulator.state.steps) = (checkpoint.time, checkpoint.steps);
    let (history, before) = (&checkpoint.history, &mut simulator.last_good);
    if let Some(plasticity) = simulator.system.elements.plasticity_mut() {
        plasticity.restore(history)?;
    }
    take(history, "before.time", std::slice::from_mut(&mut before.time))?;
    take(history, "before.u", before.u.as_flattened_mut())?;
    take(history, "before.v", before.v.as_flattened_mut())?;
    // Conditions are still those of the last step, so that the next one notices a release.
    simulator.apply_conditions_at(simulator.last_good.time);
    // Steps that have not converged show at the end of the whole run.
    let mut unconverged_steps = [0.0];
    take(history, "unconverged_steps", &mut unconverged_steps)?;
    simulator.counters.unconverged_steps = (unconverged_steps[0] as usize).min(checkpoint.steps);
    simulator.ledger.restore(history)?;
    simulator.last_forces.restore(history, coordinates / 3)?;
    if let Some(control) = &mut simulator.control {
        control.restore(history)?;
        let last = simulator.state.time - simulator.last_good.time;
        simulator.substep_dt = if last > 0.0 { last } else { simulator.substep_dt };
    }
    if let Some(contact) = &mut simulator.contact {
        contact.restore(history, &mut simulator.system, simulator.substep_dt)?;
        contact.begin_step(&simulator.last_good.u);
    }
    simulator.system.forces.restore(history)?;
    // Forces of a step, such as friction, show in reports until the next one.
    let (before, forces) = (&simulator.last_good, &mut simulator.system.forces);
    forces.begin_step(&before.u, Moment::at(before.time), simulator.substep_dt);
    forces.update_lag(&simulator.state.u, 1.0);
    simulator.integrator.restore(history)
}

/// A hash of the order of the nodes, by Fowler, Noll and Vo, with the 53 bits that a float can store.
fn fingerprint(nodes: &[u32]) -> f64 {
    let step = |hash: u64, &node: &u32| (hash ^ u64::from(node)).wrapping_mul(0x0000_0100_0000_01b3);
    (nodes.iter().fold(0xcbf2_9ce4_8422_2325, step) >> 11) as f64
}

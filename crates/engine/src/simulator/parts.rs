//! The parts of a simulation with the memory and the time that each has taken.

use fem_model::simulation::Part;

use super::Simulator;
use crate::forces::drag;
use fem_solvers::Real;

/// Bytes, and uses with their seconds.
type Cost = (usize, (usize, f64));

/// The planned parts, with their costs so far.
pub(super) fn parts<T: Real>(simulator: &Simulator<T>) -> Vec<Part> {
    let Simulator { system, method, kind, solver, plan, .. } = simulator;
    let mut parts = plan.parts(*kind, method, *solver, system.may_be_linear());
    // The plan lists them in this order; several forces of one's own may have the same name.
    let mut forces = system.forces.all().filter(|(potential, _)| potential.name() != drag::NAME).peekable();
    for part in parts.iter_mut().filter(|part| part.built) {
        let (bytes, (uses, seconds)) = match forces.next_if(|(force, _)| force.name() == part.name) {
            Some((force, timer)) => (force.bytes(), timer.read()),
            None => cost(simulator, part.name),
        };
        (part.bytes, part.uses, part.seconds) = (bytes, uses, seconds);
    }
    parts
}

/// The cost of a part that is no force; zero for a part that takes neither memory nor time of its own.
fn cost<T: Real>(simulator: &Simulator<T>, name: &str) -> Cost {
    let Simulator { system, state, last_good, counters, .. } = simulator;
    let profile = &system.profile;
    let once = |bytes: usize| (bytes, (0, 0.0));
    match name {
        "mesh" => once(system.elements.bytes()),
        "state" => once(state.bytes() + last_good.bytes()),
        "mass" => (system.mass.bytes(), profile.mass.read()),
        "forces" => (0, profile.forces.read()),
        "fixed" => once(size_of::<usize>() * system.dirichlet.conditions().next().map_or(0, |(c, _)| c.nodes.len())),
        "prescribed" => (system.dirichlet.bytes(), profile.prescribed.read()),
        "damping" => (0, profile.damping.read()),
        "plasticity" => (system.elements.plasticity().map_or(0, |flow| flow.bytes()), profile.plasticity.read()),
        "drag" => (0, system.forces.drag_timer.read()),
        "stiffness" => {
            (system.pattern.bytes() + 9 * size_of::<T>() * system.pattern.blocks(), profile.stiffness.read())
        }
        "solver" | "preconditioner" => of_solver(simulator, name),
        "projection" => (0, (counters.projections, profile.projection.read().1)),
        "line_search" => (0, (counters.energy_evaluations, profile.energies.read().1)),
        "skinning" => {
            let bytes = simulator.skinning.as_ref().map_or(0, |skinning| skinning.bytes());
            (bytes, simulator.skinning_timer.read())
        }
        // In implicit methods it is a force.
        "contact" => {
            simulator.contact.as_ref().map_or((0, (0, 0.0)), |contact| (contact.bytes(), contact.timer.read()))
        }
        "reactions" => (0, simulator.reactions_timer.read()),
        _ => once(0),
    }
}

/// The linear solver with its factor, or without its preconditioner, which counts apart.
fn of_solver<T: Real>(simulator: &Simulator<T>, name: &str) -> Cost {
    let Some(solver) = simulator.integrator.solver() else { return (0, (0, 0.0)) };
    let (preparing, solving) = solver.timers();
    let (prepared, solved) = (preparing.read(), solving.read());
    match (name, solver.has_preconditioner()) {
        ("preconditioner", _) => (solver.prepared_bytes(), prepared),
        (_, true) => (solver.bytes() - solver.prepared_bytes(), solved),
        (_, false) => (solver.bytes(), (solved.0, solved.1 + prepared.1)),
    }
}

//! The parts of a scene: which are built and which are left out, and why.

use fem_scene::simulation::Part;
use fem_scene::{CONSISTENT_MASS, Integrator as IntegratorKind, Material, Projection};

use super::Simulator;
use crate::forces::{self, anchors};
use crate::number::Real;

/// Uses and seconds of a part that is made once.
const MADE_ONCE: (usize, f64) = (0, 0.0);

/// Every part that the engine can have.
pub(super) fn parts<T: Real>(simulator: &Simulator<T>) -> Vec<Part> {
    let mut parts = body(simulator);
    parts.extend(constraints(simulator));
    parts.extend(forces_on(simulator));
    parts.extend(method(simulator));
    parts.extend(outputs(simulator));
    parts
}

/// Parts of every scene.
fn body<T: Real>(simulator: &Simulator<T>) -> Vec<Part> {
    let Simulator { system, state, last_good, .. } = simulator;
    let profile = &system.profile;
    let number = std::any::type_name::<T>();
    // The pattern is found with the mesh, whether or not a matrix is assembled.
    let mesh = system.elements.bytes() + system.pattern.bytes();
    let mass = mass(system.mass.is_lumped(), simulator.kind.is_explicit());
    let state = state.bytes() + last_good.bytes();
    vec![
        Part::mesh(system.nodes(), system.elements.count, mesh),
        Part::built("material", materials(simulator), 0, MADE_ONCE),
        Part::built("state", format!("displacements and velocities in {number}"), state, MADE_ONCE),
        Part::built("mass", mass, system.mass.bytes(), profile.mass.read()),
        Part::built("forces", "elastic forces, where no energy is needed", 0, profile.forces.read()),
    ]
}

/// The laws of all materials, the body's own first.
fn materials<T: Real>(simulator: &Simulator<T>) -> String {
    let regions = simulator
        .regions
        .iter()
        .map(|(name, elements, table)| format!("; {name}: {elements} elements of {}", material(table)));
    std::iter::once(material(&simulator.material)).chain(regions).collect()
}

fn mass(is_lumped: bool, is_explicit: bool) -> String {
    if is_lumped {
        return format!("lumped at the nodes: [mass], or an explicit method and more than {CONSISTENT_MASS} nodes");
    }
    let cost = if is_explicit { "; each evaluation solves with it, where mass.lumped = true divides" } else { "" };
    format!("consistent: couples the nodes of each element{cost}")
}

/// The law and its parameters, with a warning where linear tetrahedra lock.
fn material(material: &Material) -> String {
    let note = if material.locks() {
        "; linear tetrahedra lock so close to ν = ½: displacements come out far too small"
    } else {
        ""
    };
    let parameter = |(name, value)| match name {
        "young" => format!(", E = {value:.4e} Pa"),
        "poisson" => format!(", ν = {value}"),
        _ => format!(", {name} = {value:.4e} Pa"),
    };
    let parameters: String = material.parameters().map(parameter).collect();
    format!("{}{parameters}{note}", material.model)
}

fn constraints<T: Real>(simulator: &Simulator<T>) -> Vec<Part> {
    let dirichlet = &simulator.system.dirichlet;
    let fixed = dirichlet.conditions().map(|(condition, _)| condition).find(|condition| condition.motion.is_none());
    let fixed = match fixed.map(|condition| (condition.nodes.len(), condition.until)) {
        Some((nodes, until)) => {
            let why = match until {
                Some(until) => format!("[fixed]: {nodes} nodes, free from {until} s on, keep their rows in the matrix"),
                None => format!("[fixed]: {nodes} nodes have no row in any matrix"),
            };
            Part::built("fixed", why, size_of::<usize>() * nodes, MADE_ONCE)
        }
        None => left_out_without("fixed", "[fixed]"),
    };
    let prescribed = if dirichlet.has_motion() {
        let why = "[[prescribed]]: nodes follow a given motion";
        Part::built("prescribed", why, dirichlet.bytes(), simulator.system.profile.prescribed.read())
    } else {
        left_out_without("prescribed", "[[prescribed]]")
    };
    vec![fixed, prescribed]
}

fn forces_on<T: Real>(simulator: &Simulator<T>) -> Vec<Part> {
    let Simulator { system, .. } = simulator;
    let forces = system.forces.all().filter(|(potential, _)| potential.name() != anchors::NAME);
    let built =
        forces.map(|(force, timer)| Part::built(force.name(), force.description(), force.bytes(), timer.read()));
    let mut parts: Vec<Part> = built.collect();
    for kind in forces::kinds::<T>() {
        if parts.iter().all(|part| part.name != kind.name) {
            parts.push(left_out_without(kind.name, kind.tables));
        }
    }
    parts.push(match system.damping {
        Some(_) => {
            Part::built("damping", "[damping]: α M + β K in force and stiffness", 0, system.profile.damping.read())
        }
        None => left_out_without("damping", "[damping]"),
    });
    parts.push(Part::drag(system.forces.anchors.interaction.has_drag(), system.forces.anchors_timer.read()));
    parts
}

/// Parts of the time integration method.
fn method<T: Real>(simulator: &Simulator<T>) -> Vec<Part> {
    let Simulator { method, system, kind, counters, integrator, .. } = simulator;
    let (name, profile) = (kind.name(), &system.profile);
    let mut parts = match integrator.solver() {
        Some(_) => solver(simulator),
        None => {
            ["stiffness", "solver", "preconditioner"].map(|part| Part::left_out(part, needs_no(name, "matrix"))).into()
        }
    };
    let has_matrix = integrator.solver().is_some();
    let never = method.newton.projection == Projection::Never;
    let is_linear = *kind == IntegratorKind::Static && !integrator.has_line_search();
    parts.push(if !has_matrix || is_linear {
        Part::left_out("projection", format!("{name} does without"))
    } else if never {
        Part::left_out("projection", "newton.projection is \"never\"")
    } else {
        let why = "elements, where the matrix would not be positive definite";
        Part::built("projection", why, 0, (counters.projections, profile.projection.read().1))
    });
    parts.push(if integrator.has_line_search() {
        let why = "Newton's method decreases an energy along each direction";
        Part::built("line_search", why, 0, (counters.energy_evaluations, profile.energies.read().1))
    } else {
        Part::left_out("line_search", needs_no(name, "energy"))
    });
    parts
}

/// Parts of the linear solver. A factor belongs to the solver; a preconditioner is a part of its own.
fn solver<T: Real>(simulator: &Simulator<T>) -> Vec<Part> {
    let Simulator { system, kind, integrator, .. } = simulator;
    let Some(solver) = integrator.solver() else { return Vec::new() };
    let matrix = 9 * size_of::<T>() * system.pattern.blocks();
    let why = format!("{} solves with it", kind.name());
    let stiffness = Part::built("stiffness", why, matrix, system.profile.stiffness.read());
    let (preparing, solving) = solver.timers();
    let (prepared, solved) = (preparing.read(), solving.read());
    let choice = simulator.solver.to_string();
    if solver.has_preconditioner() {
        let bytes = solver.prepared_bytes();
        let why = "[solver] with kind \"pcg\", or a body of many nodes";
        return vec![
            stiffness,
            Part::built("solver", choice, solver.bytes() - bytes, solved),
            Part::built("preconditioner", why, bytes, prepared),
        ];
    }
    vec![
        stiffness,
        Part::built("solver", choice, solver.bytes(), (solved.0, solved.1 + prepared.1)),
        Part::left_out("preconditioner", format!("the solver is {}", simulator.solver)),
    ]
}

/// Parts that are computed on request.
fn outputs<T: Real>(simulator: &Simulator<T>) -> Vec<Part> {
    let bytes = simulator.skinning.as_ref().map(|skinning| skinning.bytes());
    let reactions = if simulator.system.is_unconstrained() {
        Part::left_out("reactions", "the body is unconstrained")
    } else {
        Part::built("reactions", "forces of the constraints, on request", 0, simulator.reactions_timer.read())
    };
    vec![Part::skinning(bytes, simulator.skinning_timer.read()), reactions]
}

fn left_out_without(name: &'static str, table: &str) -> Part {
    Part::left_out(name, format!("the scene has no {table}"))
}

fn needs_no(method: &str, thing: &str) -> String {
    format!("{method} needs no {thing}")
}

//! What a scene builds, what it leaves out, and why.

use super::Simulator;
use crate::model::system::System;
use crate::number::Real;
use fem_scene::simulation::Part;
use fem_scene::{Integrator, Material, Projection};

/// What a part costs: bytes, uses, seconds.
type Cost = (usize, (usize, f64));

/// Nothing that changes: it is made once.
const NO_WORK: (usize, f64) = (0, 0.0);

/// Poisson's ratio above which displacements are far too small.
const LOCKS: f64 = 0.49;

/// Every part that the engine can have.
pub(super) fn parts<T: Real>(engine: &Simulator<T>) -> Vec<Part> {
    let mut parts = body(engine);
    parts.extend(acting(&engine.system));
    parts.extend(methods(engine));
    parts.extend(looks(engine));
    parts
}

/// What every scene has.
fn body<T: Real>(engine: &Simulator<T>) -> Vec<Part> {
    let Simulator { material: table, system, .. } = engine;
    let (nodes, elements, work) = (system.nodes(), system.elements.count, &system.work);
    let state = engine.state.bytes() + engine.last_good.bytes();
    let mesh = system.elements.bytes() + system.pattern.bytes();
    let mass = if engine.lumped_mass { "lumped: [mass]" } else { "consistent: every element joins its nodes" };
    vec![
        // Which nodes are neighbours is learnt with the mesh, whether or not a matrix is made of it.
        built("mesh", format!("[mesh]: {nodes} nodes, {elements} tetrahedra"), (mesh, NO_WORK)),
        built("material", material(table), (0, NO_WORK)),
        built("state", format!("displacements and velocities in {}", std::any::type_name::<T>()), (state, NO_WORK)),
        built("mass", mass.to_owned(), (system.mass.bytes(), work.mass.read())),
        built("forces", "stress of every element, where no energy is asked for".to_owned(), (0, work.forces.read())),
    ]
}

/// The law with its parameters, and the warning that linear tetrahedra need.
fn material(material: &Material) -> String {
    let locks = material.poisson.is_some_and(|poisson| poisson > LOCKS);
    let note = if locks { "; linear tetrahedra lock so near to ½: displacements come out far too small" } else { "" };
    let parameter = |(name, value)| match name {
        "young" => format!(", E = {value:.4e} Pa"),
        "poisson" => format!(", ν = {value}"),
        _ => format!(", {name} = {value:.4e} Pa"),
    };
    let parameters: String = material.parameters().map(parameter).collect();
    format!("{}{parameters}{note}", material.model)
}

/// What holds the body and acts on it.
fn acting<T: Real>(system: &System<T>) -> Vec<Part> {
    let work = &system.work;
    let load = 3 * size_of::<T>() * system.dead_load.as_ref().map_or(0, Vec::len);
    let fixed = system.held.fixed().map_or(0, <[usize]>::len);
    let springs = size_of_val(&system.springs[..]);
    let pressure = system.pressures.iter().map(|pressure| pressure.bytes()).sum();
    let has_potential = system.pressures.iter().all(|pressure| pressure.has_potential());
    let potential = if has_potential { "" } else { "; its surface has an edge that moves: its work is in no energy" };
    let no = |table: &str| format!("the scene has no {table}");
    vec![
        part("dead_load", system.dead_load.is_some(), (load, work.dead_load.read()), || {
            ("[gravity], [body_force] or [[traction]] with force_per_area".into(), no("dead load"))
        }),
        part("fixed", system.held.fixed().is_some(), (size_of::<usize>() * fixed, NO_WORK), || {
            (format!("[fixed]: {fixed} nodes have no row in any matrix"), no("[fixed]"))
        }),
        part("prescribed", system.held.leads(), (system.held.bytes(), work.prescribed.read()), || {
            ("[[prescribed]]: nodes go where it leads them".into(), no("[[prescribed]]"))
        }),
        part("springs", !system.springs.is_empty(), (springs, work.springs.read()), || {
            (format!("[[springs]]: {} of them", system.springs.len()), no("[[springs]]"))
        }),
        part("pressure", !system.pressures.is_empty(), (pressure, work.pressure.read()), || {
            (format!("[[traction]] with pressure{potential}"), no("[[traction]] with pressure"))
        }),
        part("damping", system.damping.is_some(), (0, work.damping.read()), || {
            ("[damping]: α M + β K in force and stiffness".into(), no("[damping]"))
        }),
        part("drag", system.drag.is_some(), (0, work.drag.read()), || {
            let hand = "; a hand in the window pulls all the same";
            ("[drag]: a spring in force and stiffness".into(), format!("{}{hand}", no("[drag]")))
        }),
    ]
}

/// What the integrator needs.
fn methods<T: Real>(engine: &Simulator<T>) -> Vec<Part> {
    let Simulator { method, system, integrator, counters, .. } = engine;
    let (name, work, solver) = (integrator.name(), &system.work, engine.stepper.solver());
    let matrix = 9 * size_of::<T>() * system.pattern.blocks();
    let searches = engine.stepper.searches();
    let never = method.newton.projection == Projection::Never;
    let no_matrix = || format!("{name} needs no matrix");
    let projects = solver.is_some() && !never && (searches || *integrator != Integrator::Static);
    let (prepared, solved, bytes) = solver.map_or((NO_WORK, NO_WORK, 0), |solver| {
        let (preparing, solving) = solver.timers();
        (preparing.read(), solving.read(), solver.bytes())
    });
    let preconditioned = solver.filter(|solver| solver.has_preconditioner());
    let preconditioner = preconditioned.map_or(0, |solver| solver.prepared_bytes());
    // A factor is half of the solver; a preconditioner is a part of its own.
    let (of_solver, of_preconditioner) = match preconditioned {
        Some(_) => (solved, prepared),
        None => ((solved.0, solved.1 + prepared.1), NO_WORK),
    };
    vec![
        part("stiffness", solver.is_some(), (matrix, work.stiffness.read()), || {
            (format!("{name} solves with it"), no_matrix())
        }),
        part("projection", projects, (0, (counters.projections, work.projection.read().1)), || {
            let why = if never { "newton.projection is \"never\"".into() } else { format!("{name} does without") };
            ("elements, where the matrix would not be positive definite".into(), why)
        }),
        part("solver", solver.is_some(), (bytes - preconditioner, of_solver), || {
            (engine.choice.to_string(), no_matrix())
        }),
        part("preconditioner", preconditioned.is_some(), (preconditioner, of_preconditioner), || {
            ("[solver] with kind \"pcg\", or a body of many nodes".into(), "no conjugate gradients to be led".into())
        }),
        part("line_search", searches, (0, (counters.energy_evaluations, work.energies.read().1)), || {
            ("Newton's method lowers an energy along each direction".into(), format!("{name} needs no energy"))
        }),
    ]
}

/// What is made only when somebody asks.
fn looks<T: Real>(engine: &Simulator<T>) -> Vec<Part> {
    let skinning = engine.skinning.as_ref();
    let bytes = skinning.map_or(0, |skinning| skinning.bytes());
    vec![
        part("skinning", skinning.is_some(), (bytes, engine.skinned.read()), || {
            let why = "mesh.display: four weights for each of its vertices, used when somebody looks";
            (why.into(), "the scene has no mesh.display, so the tetrahedra are shown".into())
        }),
        part("reactions", !engine.system.is_unheld(), (0, engine.reacted.read()), || {
            ("forces at what holds the body, when somebody asks".into(), "nothing holds the body".into())
        }),
    ]
}

/// `whys` are the reasons to build it and to leave it out. Without it there is nothing to count.
fn part(name: &'static str, is_built: bool, cost: Cost, whys: impl FnOnce() -> (String, String)) -> Part {
    let (why, why_not) = whys();
    if is_built {
        return built(name, why, cost);
    }
    let (uses, seconds) = cost.1;
    Part { name, built: false, why: why_not, bytes: 0, uses, seconds }
}

fn built(name: &'static str, why: String, (bytes, (uses, seconds)): Cost) -> Part {
    Part { name, built: true, why, bytes, uses, seconds }
}

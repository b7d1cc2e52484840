//! What a scene builds, what it leaves out, and why.

use fem_scene::Integrator;
use fem_scene::simulation::Part;

use super::AssignmentSetup;
use super::work::bytes;

/// Nothing that is timed.
const NO_WORK: (usize, f64) = (0, 0.0);

/// Every part that the course's pipeline can have.
pub(super) fn parts(setup: &AssignmentSetup) -> Vec<Part> {
    let mut parts = bodies(setup);
    parts.extend(methods(setup));
    parts
}

fn bodies(setup: &AssignmentSetup) -> Vec<Part> {
    let mesh = &setup.shape.mesh;
    let (nodes, elements) = (mesh.vertices.len(), mesh.elements.len());
    let held = nodes - setup.q.len() / 3;
    let skinning = setup.skinning.as_ref().map(bytes);
    vec![
        built("mesh", format!("[mesh]: {nodes} nodes, {elements} tetrahedra"), 24 * nodes + 40 * elements, NO_WORK),
        built("mass", format!("consistent, {} entries", setup.M.nnz()), bytes(&setup.M), NO_WORK),
        match setup.gravity {
            Some(_) => built("gravity", "[gravity]: the weight of every node".into(), 8 * setup.weight.len(), NO_WORK),
            None => left_out("gravity", "the scene has no [gravity]"),
        },
        match held {
            0 => left_out("fixed", "the scene fixes no node, so every coordinate is free"),
            _ => built("fixed", format!("[fixed]: P leaves {held} nodes out"), setup.constraints.bytes(), NO_WORK),
        },
        match setup.drag {
            Some(_) => built("drag", "[drag]: a spring in force and stiffness".into(), 0, NO_WORK),
            None => left_out("drag", "the scene has no [drag]; a hand in the window pulls all the same"),
        },
        match skinning {
            Some(bytes) => {
                let why = "mesh.display: four weights for each display vertex";
                built("skinning", why.into(), bytes, setup.work.skinning.read())
            }
            None => left_out("skinning", "the scene has no mesh.display, so the tetrahedra are shown"),
        },
    ]
}

fn methods(setup: &AssignmentSetup) -> Vec<Part> {
    let work = &setup.work;
    let stiffness = "assemble_stiffness, projected element by element";
    let solver = "sparse Cholesky; its order of elimination is chosen once";
    vec![
        built("forces", "assemble_forces, at least once a step".into(), 8 * setup.q.len(), work.forces.read()),
        built("stiffness", stiffness.into(), bytes(&setup.M), work.stiffness.read()),
        built("solver", solver.into(), setup.solver.borrow().bytes(), work.solve.read()),
        match setup.integrator {
            Integrator::ImplicitEuler => {
                let why = "implicit_euler: Newton's method decreases an energy along each direction";
                built("line_search", why.into(), 0, work.energy.read())
            }
            other => left_out("line_search", &format!("{} solves once a step and needs no energy", other.name())),
        },
    ]
}

fn built(name: &'static str, why: String, bytes: usize, (uses, seconds): (usize, f64)) -> Part {
    Part { name, built: true, why, bytes, uses, seconds }
}

fn left_out(name: &'static str, why: &str) -> Part {
    Part { name, built: false, why: why.to_owned(), bytes: 0, uses: 0, seconds: 0.0 }
}

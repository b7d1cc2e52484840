//! The parts of the course's pipeline: built or left out, and why.

use fem_model::Integrator;
use fem_model::simulation::Part;

use super::AssignmentSetup;
use super::profile::bytes;

/// A part without a timer.
const NO_WORK: (usize, f64) = (0, 0.0);

/// Every part that the course's pipeline can have.
pub(super) fn parts(setup: &AssignmentSetup) -> Vec<Part> {
    let mut parts = bodies(setup);
    parts.extend(methods(setup));
    parts
}

fn bodies(setup: &AssignmentSetup) -> Vec<Part> {
    let mesh = &setup.shape.mesh;
    let (nodes, elements) = (mesh.vertices().len(), mesh.elements());
    let fixed = nodes - setup.q.len() / 3;
    vec![
        Part::mesh(nodes, elements, mesh.element().name, 24 * nodes + 40 * elements),
        Part::built("mass", format!("consistent, {} entries", setup.M.nnz()), bytes(&setup.M), NO_WORK),
        match setup.gravity {
            Some(_) => Part::built("gravity", "[gravity]: the weight of every node", 8 * setup.weight.len(), NO_WORK),
            None => Part::left_out("gravity", "the scene has no [gravity]"),
        },
        match fixed {
            0 => Part::left_out("fixed", "the scene fixes no node, so every coordinate is free"),
            _ => {
                let why = format!("[fixed]: P eliminates the coordinates of {fixed} nodes");
                Part::built("fixed", why, setup.constraints.bytes(), NO_WORK)
            }
        },
        Part::drag(setup.interaction.has_drag(), setup.has_springs_in_stiffness, NO_WORK),
        Part::skinning(setup.skinning.as_ref().map(bytes), setup.profile.skinning.read()),
    ]
}

fn methods(setup: &AssignmentSetup) -> Vec<Part> {
    let profile = &setup.profile;
    let stiffness = "assemble_stiffness, projected element by element";
    let solver = "sparse Cholesky; its order of elimination is chosen once";
    vec![
        Part::built("forces", "assemble_forces, at least once a step", 8 * setup.q.len(), profile.forces.read()),
        Part::built("stiffness", stiffness, bytes(&setup.M), profile.stiffness.read()),
        Part::built("solver", solver, setup.solver.borrow().bytes(), profile.solve.read()),
        match setup.integrator {
            Integrator::ImplicitEuler => {
                let why = "implicit_euler: Newton's method decreases an energy along each direction";
                Part::built("line_search", why, 0, profile.energy.read())
            }
            other => Part::left_out("line_search", format!("{} solves once a step and needs no energy", other.name())),
        },
    ]
}

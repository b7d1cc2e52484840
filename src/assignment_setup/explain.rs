//! What a scene builds, what it leaves out, and why.

use fem_engine::scene::Integrator;
use fem_engine::simulation::Part;

use super::AssignmentSetup;
use super::work::bytes;

/// Every part that the course's pipeline can have.
pub(super) fn parts(setup: &AssignmentSetup) -> Vec<Part> {
    let mut parts = bodies(setup);
    parts.extend(methods(setup));
    parts
}

fn bodies(setup: &AssignmentSetup) -> Vec<Part> {
    let mesh = &setup.shape.mesh;
    let (nodes, elements) = (mesh.vertices.len(), mesh.elements.len());
    let free = setup.q.len() / 3;
    vec![
        part("mesh", true, format!("[mesh]: {nodes} nodes, {elements} tetrahedra"), 24 * nodes + 40 * elements, 0.0),
        part("mass", true, format!("consistent, {} entries", setup.M.nnz()), bytes(&setup.M), 0.0),
        part(
            "gravity",
            setup.gravity.is_some(),
            "[gravity]: the weight of every node".into(),
            8 * setup.weight.len(),
            0.0,
        ),
        part(
            "fixed",
            free < nodes,
            format!("[fixed]: P leaves {} nodes out", nodes - free),
            setup.constraints.bytes(),
            0.0,
        ),
        part("drag", setup.drag.is_some(), "[drag]: a spring in force and stiffness".into(), 0, 0.0),
        part(
            "skinning",
            setup.skinning.is_some(),
            "mesh.display: weights of the display vertices".into(),
            setup.skinning.as_ref().map_or(0, bytes),
            setup.work.skinning.seconds(),
        ),
    ]
}

fn methods(setup: &AssignmentSetup) -> Vec<Part> {
    let implicit = setup.integrator == Integrator::ImplicitEuler;
    let entries = 16 * setup.M.nnz();
    let search =
        "time.integrator = \"implicit_euler\": the energy that Newton's method decreases along its line search";
    let work = &setup.work;
    vec![
        part("forces", true, "assemble_forces, at least once a step".into(), 8 * setup.q.len(), work.forces.seconds()),
        part(
            "stiffness",
            true,
            "assemble_stiffness, projected element by element".into(),
            entries,
            work.stiffness.seconds(),
        ),
        part(
            "solver",
            true,
            "sparse Cholesky; its order is chosen once".into(),
            setup.solver.borrow().bytes(),
            work.solve.seconds(),
        ),
        part("line_search", implicit, search.into(), 0, work.energy.seconds()),
    ]
}

fn part(name: &'static str, built: bool, why: String, bytes: usize, seconds: f64) -> Part {
    Part { name, built, why, bytes, seconds }
}

//! Configuration, errors and status of a run for its row.

use nalgebra::DVector;

use super::SceneStudy;
use super::mesh::{StudyMesh, cells};
use crate::runs::measure::RunResult;
use crate::runs::names;
use crate::runs::plan::PlannedRun;
use crate::runs::row::{Configuration, Errors};
use crate::space::norms;
use fem_engine::cantilever::moduli;
use fem_model::{Family, Precision, Projection};
use fem_scene::Pipeline;

/// Errors of a completed run.
pub(super) fn errors(run: &PlannedRun, outcome: &RunResult, body: &StudyMesh, study: &SceneStudy) -> Errors {
    let in_space =
        study.richardson.as_ref().and_then(|nested| nested.errors.iter().find(|row| row.0 == cells(&run.scene)));
    let mut errors = Errors {
        space_l2: in_space.map(|row| row.1),
        space_h1: in_space.map(|row| row.2),
        analytic: outcome.analytic,
        ..Errors::default()
    };
    let Some(reference) = &body.reference else { return errors };
    let length = norms::length(&body.mesh);
    let (q, exact) = (outcome.q.as_slice(), reference.q.as_slice());
    errors.time_l2 = Some(norms::l2(&body.weights, q, exact) / length);
    errors.estimated = outcome.estimated.map(|error| error / norms::length(&body.mesh));
    errors.time_linf = Some(norms::largest(q, exact) / length);
    let momenta = |q: &DVector<f64>, v: &DVector<f64>| {
        norms::momenta(&body.mesh, &body.weights, run.scene.material.density, q.as_slice(), v.as_slice())
    };
    let (found, expected) = (momenta(&outcome.q, &outcome.qdot), momenta(&reference.q, &reference.qdot));
    let mass: f64 = run.scene.material.density * body.weights.iter().sum::<f64>();
    // The momentum of a translation with the same kinetic energy; with the length, an angular momentum.
    let scale = (2.0 * mass * reference.kinetic).sqrt();
    let total = |energies: (f64, f64)| energies.0 + energies.1;
    let expected_energy = reference.kinetic + reference.potential;
    let size = reference.kinetic.abs().max(reference.potential.abs());
    errors.energy = Some((total(outcome.energies) - expected_energy) / size);
    // Weights are volumes: momenta of several materials would need the density of each element.
    if run.scene.materials.is_empty() {
        errors.momentum = Some(norms::distance(found.0, expected.0) / scale);
        errors.angular = Some(norms::distance(found.1, expected.1) / (scale * length));
    }
    errors
}

pub(super) fn configuration(id: String, run: &PlannedRun, body: &StudyMesh) -> Configuration {
    let PlannedRun { scene, .. } = run;
    let moduli = moduli(&scene.material.value());
    let is_newton = scene.time.integrator.has_newton();
    let is_course = scene.pipeline == Pipeline::Course;
    let newton = scene.newton.as_ref();
    let projection = match newton.and_then(|newton| newton.projection).unwrap_or_default() {
        _ if is_course => "always",
        Projection::WhenNeeded => "when_needed",
        Projection::Always => "always",
        Projection::Never => "never",
    };
    let has_matrix = is_newton || scene.time.integrator.facts().family == Family::Linearized;
    let solver = if is_course { "course cholesky".to_owned() } else { names::solver_name(scene) };
    let engine = |value: f64| if is_course { None } else { Some(value) };
    Configuration {
        id,
        scene: scene.name.clone(),
        group: run.group.to_owned(),
        method: run.method.clone(),
        pipeline: if is_course { "course" } else { "engine" }.to_owned(),
        mesh_hash: body.hash.clone(),
        nodes: body.mesh.vertices().len(),
        elements: body.mesh.elements(),
        young: moduli.map(|moduli| moduli.young),
        poisson: moduli.map(|moduli| moduli.poisson),
        integrator: scene.time.integrator,
        projection: if has_matrix { projection } else { "none" }.to_owned(),
        solver: if has_matrix { solver } else { "none".to_owned() },
        dt: scene.time.dt(),
        steps: run.steps,
        tolerance: is_newton.then(|| newton.and_then(|newton| newton.tolerance).unwrap_or(1e-10)).and_then(engine),
        max_iterations: is_newton.then(|| match (is_course, newton.and_then(|newton| newton.max_iterations)) {
            (true, _) => 5,
            (false, given) => given.unwrap_or(50),
        }),
        precision: if scene.time.precision == Precision::F32 { "f32" } else { "f64" }.to_owned(),
    }
}

/// `done`, or the failure.
pub(super) fn status(outcome: &RunResult) -> String {
    match &outcome.failure {
        Some(failure) => format!("failed: {failure}"),
        None if outcome.counters.unconverged_steps > 0 => {
            format!("done, with {} steps not converged", outcome.counters.unconverged_steps)
        }
        None => "done".to_owned(),
    }
}

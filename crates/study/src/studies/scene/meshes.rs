//! The meshes of a study with their references, and the rows of the runs on them.

use std::collections::HashMap;

use fem_engine::cantilever::moduli;
use fem_model::{BodyMesh, Family, Precision, Projection};
use fem_scene::{Pipeline, Scene};
use nalgebra::DVector;

use super::{SceneStudy, Settings};
use crate::runs::costs;
use crate::runs::measure::RunResult;
use crate::runs::plan::{PlannedRun, solver_name};
use crate::runs::row::{Configuration, Errors, Row};
use crate::runs::states::{Snapshot, write_reference, write_state};
use crate::study::Result;
use fem_reference::space::norms;
use fem_reference::time::{Equations, Reference, reference};

/// Largest time of a reference, and of the finest of three nested meshes, s.
pub(super) fn most_reference_seconds(is_quick: bool) -> f64 {
    if is_quick { 60.0 } else { 240.0 }
}

/// A mesh of the study, with its reference.
pub(super) struct StudyMesh {
    pub mesh: BodyMesh,
    /// Weights of the nodes, m³.
    pub weights: Vec<f64>,
    pub hash: String,
    /// File of the reference.
    pub file: String,
    pub reference: Option<Reference>,
}

/// Cells per metre of a box, 0 for a mesh from a file.
fn cells(scene: &Scene) -> usize {
    scene.mesh.cuboid.as_ref().map_or(0, |cuboid| cuboid.cells_per_unit)
}

/// Meshes and references by cells per metre (0 for a mesh from a file).
pub(super) struct StudyMeshes<'a> {
    pub settings: &'a Settings<'a>,
    pub scene: &'a Scene,
    pub known: HashMap<usize, StudyMesh>,
}

impl StudyMeshes<'_> {
    /// Reads a mesh. With a horizon, computes its reference; a reason for its absence goes to `left_out`.
    pub fn add(&mut self, scene: &Scene, horizon: Option<f64>, study: &mut SceneStudy) -> Result<()> {
        let body = fem_scene::body(scene, &self.settings.data)?;
        let mesh = body.shape.mesh.clone();
        let is_own = cells(scene) == cells(self.scene);
        let name = if cells(scene) == 0 { String::new() } else { format!("-{}", cells(scene)) };
        let file = format!("states/{}{name}-reference.json", scene.name);
        let mut found = None;
        if let Some(horizon) = horizon {
            match Equations::new(body) {
                Ok(equations) => {
                    if is_own {
                        study.fastest = equations.fastest();
                        study.costs = Some(costs::measure(&equations));
                    }
                    match reference(&equations, horizon, most_reference_seconds(self.settings.is_quick)) {
                        Ok(reference) => found = Some(reference),
                        Err(reason) => study.left_out.push(("errors in time".to_owned(), reason)),
                    }
                }
                Err(reason) => study.left_out.push(("errors in time".to_owned(), reason)),
            }
        }
        if is_own {
            study.size = (mesh.vertices().len(), mesh.elements());
            study.energy_scale = found.as_ref().map_or(0.0, |found| found.kinetic.abs().max(found.potential.abs()));
        }
        study.references.extend(found.as_ref().map(|found| (file.clone(), found.check, found.evaluations)));
        write_reference(&self.settings.out.join(&file), &mesh, scene.material.density, found.as_ref())?;
        let weights = norms::weights(&mesh);
        let hash = norms::mesh_hash(&mesh);
        self.known.insert(cells(scene), StudyMesh { mesh, weights, hash, file, reference: found });
        Ok(())
    }

    /// Writes a run's state and adds its row.
    pub fn add_row(&mut self, run: &PlannedRun, outcome: &RunResult, study: &mut SceneStudy) -> Result<()> {
        if !self.known.contains_key(&cells(&run.scene)) {
            self.add(&run.scene, None, study)?;
        }
        let body = &self.known[&cells(&run.scene)];
        let id = format!("{}-{:03}", study.name, study.rows.len() + 1);
        let state = format!("states/{id}.json");
        let RunResult { time, q, qdot, energies, .. } = outcome;
        let snapshot = Snapshot { time: *time, q, qdot, energies: *energies };
        write_state(&self.settings.out.join(&state), &snapshot)?;
        let start = outcome.history.first().map_or(0.0, |first| first.1);
        let change = |&(time, energy): &(f64, f64)| Some((time, energy - start)).filter(|_| energy.is_finite());
        study.histories.push(outcome.history.iter().filter_map(change).collect());
        let errors = if outcome.failure.is_none() { errors(run, outcome, body, study) } else { Errors::default() };
        study.rows.push(Row {
            errors,
            counters: outcome.counters,
            peak_mb: outcome.peak_mb,
            min_j: Some(outcome.min_j).filter(|min_j| min_j.is_finite()),
            status: status(outcome),
            ..Row::new(configuration(id, run, body), state, body.file.clone())
        });
        Ok(())
    }
}

/// Errors of a completed run.
fn errors(run: &PlannedRun, outcome: &RunResult, body: &StudyMesh, study: &SceneStudy) -> Errors {
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

fn configuration(id: String, run: &PlannedRun, body: &StudyMesh) -> Configuration {
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
    let solver = if is_course { "course cholesky".to_owned() } else { solver_name(scene) };
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
fn status(outcome: &RunResult) -> String {
    match &outcome.failure {
        Some(failure) => format!("failed: {failure}"),
        None if outcome.counters.unconverged_steps > 0 => {
            format!("done, with {} steps not converged", outcome.counters.unconverged_steps)
        }
        None => "done".to_owned(),
    }
}

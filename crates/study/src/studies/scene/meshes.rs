//! The meshes of a study with their references, and the rows of the runs on them.

use std::collections::HashMap;

use super::case::{configuration, errors, status};
use super::mesh::{StudyMesh, cells};
use super::{SceneStudy, Settings};
use crate::reference::{Equations, reference};
use crate::runs::costs;
use crate::runs::measure::RunResult;
use crate::runs::plan::PlannedRun;
use crate::runs::row::{Errors, Row};
use crate::runs::states::{Snapshot, write_reference, write_state};
use crate::space::norms;
use fem_scene::Scene;

/// Largest time of a reference, and of the finest of three nested meshes, s.
pub(super) fn most_reference_seconds(is_quick: bool) -> f64 {
    if is_quick { 60.0 } else { 240.0 }
}

/// Meshes and references by cells per metre (0 for a mesh from a file).
pub(super) struct StudyMeshes<'a> {
    pub settings: &'a Settings<'a>,
    pub scene: &'a Scene,
    pub known: HashMap<usize, StudyMesh>,
}

impl StudyMeshes<'_> {
    /// Reads a mesh. With a horizon, computes its reference; a reason for its absence goes to `left_out`.
    pub fn add(&mut self, scene: &Scene, horizon: Option<f64>, study: &mut SceneStudy) -> Result<(), String> {
        let body = fem_scene::body(scene, &self.settings.data).map_err(|error| error.to_string())?;
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
    pub fn add_row(&mut self, run: &PlannedRun, outcome: &RunResult, study: &mut SceneStudy) -> Result<(), String> {
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

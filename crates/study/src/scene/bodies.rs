//! The meshes of a study with their references, and the row of each run on them.

use std::collections::HashMap;

use super::case::{case, errors, status};
use super::{SceneStudy, Setting};
use crate::costs;
use crate::equations::Equations;
use crate::measure::Outcome;
use crate::norms;
use crate::plan::Run;
use crate::reference::{Reference, reference};
use crate::row::{Errors, Row};
use crate::states::{Snapshot, write_reference, write_state};
use fem_mesh::TetrahedralMesh;
use fem_scene::Scene;

/// Time that a reference may take, and that the finest of three meshes may, s.
pub(super) fn most_reference_seconds(is_quick: bool) -> f64 {
    if is_quick { 60.0 } else { 240.0 }
}

/// A mesh of the study, with its reference.
pub(super) struct Body {
    pub mesh: TetrahedralMesh,
    pub weights: Vec<f64>,
    pub hash: String,
    pub file: String,
    pub reference: Option<Reference>,
}

/// Meshes and references by cells per metre (0 for a mesh from a file).
pub(super) struct Bodies<'a> {
    pub setting: &'a Setting<'a>,
    pub scene: &'a Scene,
    pub known: HashMap<usize, Body>,
}

pub(super) fn cells(scene: &Scene) -> usize {
    scene.mesh.cuboid.as_ref().map_or(0, |cuboid| cuboid.cells_per_unit)
}

impl Bodies<'_> {
    /// Reads a mesh, and computes its reference where a horizon is given and one can be computed.
    pub fn add(&mut self, scene: &Scene, horizon: Option<f64>, study: &mut SceneStudy) -> Result<(), String> {
        let body = fem_scene::body(scene, &self.setting.data).map_err(|error| error.to_string())?;
        let mesh = body.shape.mesh.clone();
        let is_own = cells(scene) == cells(self.scene);
        let name = if cells(scene) == 0 { String::new() } else { format!("-{}", cells(scene)) };
        let file = format!("states/{}{name}-reference.json", scene.name);
        let mut found = None;
        if let Some(horizon) = horizon {
            match Equations::new(scene, body) {
                Ok(equations) => {
                    if is_own {
                        study.fastest = equations.fastest();
                        study.costs = Some(costs::measure(&equations));
                    }
                    match reference(&equations, horizon, most_reference_seconds(self.setting.is_quick)) {
                        Ok(reference) => found = Some(reference),
                        Err(reason) => study.left_out.push(("errors in time".to_owned(), reason)),
                    }
                }
                Err(reason) => study.left_out.push(("errors in time".to_owned(), reason)),
            }
        }
        if is_own {
            study.size = (mesh.vertices.len(), mesh.elements.len());
            study.energy_scale = found.as_ref().map_or(0.0, |found| found.kinetic.abs().max(found.potential.abs()));
        }
        study.references.extend(found.as_ref().map(|found| (file.clone(), found.check, found.evaluations)));
        write_reference(&self.setting.out.join(&file), &mesh, scene.material.density, found.as_ref())?;
        let weights = norms::weights(&mesh);
        let hash = norms::mesh_hash(&mesh);
        self.known.insert(cells(scene), Body { mesh, weights, hash, file, reference: found });
        Ok(())
    }

    /// Writes a run's state and adds its row.
    pub fn add_row(&mut self, run: &Run, outcome: &Outcome, study: &mut SceneStudy) -> Result<(), String> {
        if !self.known.contains_key(&cells(&run.scene)) {
            self.add(&run.scene, None, study)?;
        }
        let body = &self.known[&cells(&run.scene)];
        let id = format!("{}-{:03}", study.name, study.rows.len() + 1);
        let state = format!("states/{id}.json");
        let Outcome { time, q, qdot, energies, .. } = outcome;
        let snapshot = Snapshot { time: *time, q, qdot, energies: *energies };
        write_state(&self.setting.out.join(&state), &snapshot)?;
        let start = outcome.history.first().map_or(0.0, |first| first.1);
        study.histories.push(outcome.history.iter().map(|(time, energy)| (*time, energy - start)).collect());
        let errors = if outcome.failure.is_none() { errors(run, outcome, body, study) } else { Errors::default() };
        study.rows.push(Row {
            case: case(id, run, body),
            errors,
            counters: outcome.counters,
            peak_mb: outcome.peak_mb,
            min_j: Some(outcome.min_j),
            status: status(outcome),
            state,
            reference_state: body.file.clone(),
            ..Row::default()
        });
        Ok(())
    }
}

//! The meshes of a study with their references, and the row of each run on them.

use std::collections::HashMap;

use nalgebra::DVector;

use super::case::{case, errors, status};
use super::{SceneStudy, Setting};
use crate::mesh::TetrahedralMesh;
use crate::scene::{self, Integrator, Scene};
use crate::study::costs;
use crate::study::equations::Equations;
use crate::study::measure::Outcome;
use crate::study::nested::{self, Level, Nested};
use crate::study::plan::{self, Run};
use crate::study::reference::{Reference, reference};
use crate::study::row::{Errors, Row};
use crate::study::states::{Snapshot, write_reference, write_state};
use crate::study::{closed_forms, norms};

/// Time that a reference may take, and that the finest of three meshes may, s.
fn most_reference_seconds(is_quick: bool) -> f64 {
    if is_quick { 20.0 } else { 240.0 }
}

/// Fastest vibration times a step of Verlet that is safely stable.
const EXPLICIT: f64 = 1.2;

/// Time of an explicit step for each element, s; about.
const SECONDS_OF_AN_ELEMENT: f64 = 2e-7;

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
        let body = scene::body(scene, &self.setting.data).map_err(|error| error.to_string())?;
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

    /// Three meshes of a box, and what they tell.
    pub fn nested(&mut self, base: &Scene, study: &mut SceneStudy) -> Result<Option<Nested>, String> {
        let Some(all) = plan::levels(base) else { return Ok(None) };
        let is_static = base.time.integrator == Integrator::Static;
        if closed_forms::uniaxial(base).is_some() || (!is_static && study.fastest == 0.0) {
            return Ok(None);
        }
        let finest = 2.0 * study.fastest * study.horizon / EXPLICIT * 8.0 * study.size.1 as f64 * SECONDS_OF_AN_ELEMENT;
        if !is_static && finest > most_reference_seconds(self.setting.is_quick) {
            study.left_out.push(("errors in space".to_owned(), format!("the finest mesh would take {finest:.0} s")));
            return Ok(None);
        }
        let mut levels = Vec::new();
        for (number, cells) in all.into_iter().enumerate() {
            (self.setting.tell)(number, 3, &format!("{}: mesh of {cells} cells per metre", study.name));
            let mut scene = base.clone();
            if let Some(cuboid) = &mut scene.mesh.cuboid {
                cuboid.cells_per_unit = cells;
            }
            if !self.known.contains_key(&cells) {
                let horizon = (!is_static && number < 2).then_some(study.horizon);
                self.add(&scene, horizon, study)?;
            }
            let body = &self.known[&cells];
            let q = match &body.reference {
                Some(reference) => reference.q.clone(),
                None => {
                    let fastest = (1 << number) as f64 * study.fastest / 2.0;
                    match self.settled(scene, is_static, study.horizon, fastest) {
                        Ok(q) => q,
                        Err(reason) => {
                            study.left_out.push(("errors in space".to_owned(), reason));
                            return Ok(None);
                        }
                    }
                }
            };
            levels.push(Level { cells, mesh: body.mesh.clone(), q });
        }
        let levels: [Level; 3] = levels.try_into().map_err(|_| "three levels are three".to_owned())?;
        Ok(nested::compare(&levels).filter(|nested| nested.orders.0.is_finite()))
    }

    /// A state whose error in time is far below that of the mesh: the equilibrium, or Verlet at small steps.
    fn settled(&self, mut scene: Scene, is_static: bool, horizon: f64, fastest: f64) -> Result<DVector<f64>, String> {
        let steps = if is_static {
            scene.statics.as_ref().map_or(1, |statics| statics.load_steps)
        } else {
            scene.time.integrator = Integrator::Verlet;
            (horizon * fastest / EXPLICIT).ceil().max(1.0) as usize
        };
        if !is_static {
            scene.time.dt = horizon / steps as f64;
        }
        let mut simulation = (self.setting.factory)(&scene)?;
        for _ in 0..steps {
            simulation.step().map_err(|failure| failure.to_string())?;
        }
        Ok(simulation.positions())
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

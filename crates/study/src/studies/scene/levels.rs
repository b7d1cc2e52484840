//! Three nested meshes of a box, and the state on each.

use nalgebra::DVector;

use super::SceneStudy;
use super::meshes::{StudyMeshes, most_reference_seconds};
use crate::runs::plan;
use crate::study::Result;
use fem_model::Integrator;
use fem_reference::space::closed_forms;
use fem_reference::space::nested::{self, Level, RichardsonEstimate};
use fem_scene::Scene;

/// ω_max dt of a stable step of Verlet, with a margin.
const STABLE: f64 = 1.2;

/// Approximate time of an explicit step per element, s.
const SECONDS_OF_AN_ELEMENT: f64 = 2e-7;

impl StudyMeshes<'_> {
    /// Errors in space. `None` if the scene is no box, has a closed form, or would take too long.
    pub fn nested(&mut self, base: &Scene, study: &mut SceneStudy) -> Result<Option<RichardsonEstimate>> {
        let is_static = base.time.integrator == Integrator::Static;
        if closed_forms::uniaxial(base).is_some() || (!is_static && study.fastest == 0.0) {
            return Ok(None);
        }
        let all = match plan::levels(base) {
            Ok(all) => all,
            Err(reason) => {
                study.left_out.push(("errors in space".to_owned(), reason));
                return Ok(None);
            }
        };
        let steps = 2.0 * study.fastest * study.horizon / STABLE;
        let finest = steps * 8.0 * study.size.1 as f64 * SECONDS_OF_AN_ELEMENT;
        if finest > most_reference_seconds(self.settings.is_quick) {
            study.left_out.push(("errors in space".to_owned(), format!("the finest mesh would take {finest:.0} s")));
            return Ok(None);
        }
        let mut levels = Vec::new();
        for (number, cells) in all.into_iter().enumerate() {
            (self.settings.tell)(number, 3, &format!("{}: mesh of {cells} cells per metre", study.name));
            match self.level(base, number, cells, study)? {
                Ok(level) => levels.push(level),
                Err(reason) => {
                    study.left_out.push(("errors in space".to_owned(), reason));
                    return Ok(None);
                }
            }
        }
        let levels: [Level; 3] = levels.try_into().map_err(|_| "three meshes give three levels".to_owned())?;
        Ok(nested::compare(&levels).filter(|nested| nested.orders.0.is_finite() && nested.orders.1.is_finite()))
    }

    /// One level. The inner error says why its state cannot be computed; the outer error is that of a file.
    fn level(
        &mut self,
        base: &Scene,
        number: usize,
        cells: usize,
        study: &mut SceneStudy,
    ) -> Result<Result<Level, String>> {
        let is_static = base.time.integrator == Integrator::Static;
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
            Some(reference) => Ok(reference.q.clone()),
            None => self.settled(scene, is_static, study.horizon, (1 << number) as f64 * study.fastest / 2.0),
        };
        let mesh = body.mesh.clone();
        Ok(q.map(|q| Level { cells, mesh, q }))
    }

    /// A state whose error in time is far below its error in space: the equilibrium, or Verlet with small steps.
    fn settled(&self, mut scene: Scene, is_static: bool, horizon: f64, fastest: f64) -> Result<DVector<f64>, String> {
        let steps = if is_static {
            scene.statics.as_ref().map_or(1, |statics| statics.load_steps)
        } else {
            scene.time.integrator = Integrator::Verlet;
            (horizon * fastest / STABLE).ceil().max(1.0) as usize
        };
        if !is_static {
            scene.time.dt = Some(horizon / steps as f64);
        }
        let mut simulation = (self.settings.factory)(&scene)?;
        for _ in 0..steps {
            simulation.step().map_err(|failure| failure.to_string())?;
        }
        Ok(simulation.positions())
    }
}

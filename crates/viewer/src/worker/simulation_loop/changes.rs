//! Commands that change the scene or drag the body.

use std::path::PathBuf;

use fem_model::simulation::Pull;
use fem_output::ElementField;

use super::SimulationLoop;
use crate::editing::change::Change;
use crate::editing::editor::Motion;

/// Largest number of nodes for which the longest stable time step is computed.
const MOST_NODES: usize = 5000;

impl SimulationLoop {
    /// Updates the values that the panel shows of a simulation and its method.
    pub(super) fn inspect(&mut self) {
        self.last.fields = ElementField::of(&*self.simulation);
        let is_small = self.simulation.shape().mesh.vertices().len() <= MOST_NODES;
        if let Some(editor) = &mut self.editor {
            editor.find_conditions(&*self.simulation);
        }
        self.last.critical_time_step = match &self.editor {
            Some(_) if is_small => self.simulation.critical_time_step(),
            _ => None,
        };
    }

    /// Moves the anchor springs of dragged nodes. Nodes of a mesh that was replaced after the pick may not exist.
    pub(super) fn pull(&mut self, pull: Option<Pull>) {
        let nodes = self.simulation.shape().mesh.vertices().len();
        let exists = |pull: &Pull| pull.anchors.iter().all(|(node, _)| *node < nodes);
        self.simulation.pull(pull.filter(exists));
    }

    /// Changes the scene. A refused change leaves the simulation as it is, with a message.
    pub(super) fn change(&mut self, changes: &[Change]) {
        let Some(editor) = &mut self.editor else { return };
        self.last.is_building = true;
        self.slot.put(self.last.clone());
        self.last.changes += 1;
        let outcome = editor.apply(changes, &mut self.simulation);
        // The wall clock did not stop meanwhile.
        self.pace.restart();
        self.rate.restart();
        match outcome {
            Ok(motion) => {
                self.last.refusal = None;
                self.last.stop = None;
                if motion == Motion::StartsAgain {
                    self.forget_run();
                }
                self.inspect();
            }
            Err(message) => self.last.refusal = Some(message),
        }
    }

    /// Writes the scene as it is set up to a new file.
    pub(super) fn save(&mut self, path: PathBuf) {
        let Some(editor) = &self.editor else { return };
        self.last.saved = Some(editor.save(&path, &*self.simulation).map(|()| path));
    }
}

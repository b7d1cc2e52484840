//! The tools with which the user sets up a scene.

use kiss3d::event::Modifiers;

use super::Session;
use crate::panel::request::UserRequest;
use crate::picture::scene_view::DisplayedSurface;
use crate::setup::{Mode, Pointer};

/// An event of the left mouse button or the mouse.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ToolEvent {
    /// The button was pressed.
    Press,
    /// The mouse was moved.
    Move,
}

impl Session {
    /// Gives an event to the tool in use; returns whether it takes a press.
    pub(super) fn use_tool(&mut self, event: ToolEvent, modifiers: Modifiers) -> bool {
        let Session { setup, snapshot, shape, camera, changes, cursor, .. } = self;
        let Some(scene) = snapshot.setup.as_deref().filter(|_| setup.mode != Mode::Pull) else { return false };
        let positions = &snapshot.frame.positions;
        if positions.len() != shape.mesh.vertices().len() {
            return false; // of a mesh that was replaced
        }
        let control = modifiers.contains(Modifiers::Control);
        let pointer = Pointer { cursor: *cursor, control, camera, positions, shape, scene };
        match event {
            ToolEvent::Press => setup.press(&pointer),
            ToolEvent::Move => {
                setup.moved(&pointer).into_iter().for_each(|change| changes.add(change));
                false
            }
        }
    }

    /// The button was released.
    pub(super) fn end_of_tool(&mut self) {
        let change = self.setup.release(&self.shape, self.snapshot.setup.as_deref());
        change.into_iter().for_each(|change| self.changes.add(change));
    }

    /// Goes on to another tool. Nodes and faces are those of the simulation mesh, which is shown meanwhile.
    pub(super) fn choose(&mut self, mode: Mode) {
        if self.snapshot.setup.is_none() || mode == self.setup.mode {
            return;
        }
        if self.setup.mode == Mode::Pull {
            self.shown_before = self.view.shown();
        }
        self.setup.choose(mode);
        self.view.show(if mode == Mode::Pull { self.shown_before } else { DisplayedSurface::SimulationMesh });
        self.view.update(&self.snapshot.frame);
    }

    /// Changes the load of the picked faces, or picks another.
    pub(super) fn apply_to_loads(&mut self, request: &UserRequest) {
        let Session { setup, snapshot, shape, changes, .. } = self;
        let Some(scene) = snapshot.setup.as_deref() else { return };
        let change = match request {
            UserRequest::RemoveLoad => setup.loads.remove(),
            UserRequest::ChooseLoad(load) => {
                setup.choose_load(shape, scene, *load);
                None
            }
            _ => setup.load(shape, scene),
        };
        change.into_iter().for_each(|change| changes.add(change));
    }
}

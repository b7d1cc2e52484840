//! Keys, mouse and the requests of the panel.

use std::time::Instant;

use fem_output::ElementField;
use kiss3d::egui::pos2;
use kiss3d::event::{Action, Key, Modifiers, MouseButton, WindowEvent};
use kiss3d::glamx::Vec2;

use super::Session;
use super::tools::ToolEvent;
use crate::panel::request::UserRequest;
use crate::picture::frame::Wanted;
use crate::picture::scene_view::DisplayedSurface;
use crate::setup::Mode;
use crate::worker::Command;

impl Session {
    pub(super) fn read_input(&mut self) {
        let events: Vec<WindowEvent> = self.window.events().iter().map(|event| event.value).collect();
        if !events.is_empty() {
            self.last_input = Instant::now();
        }
        for event in events {
            match event {
                WindowEvent::Key(key, Action::Press, _) => self.key(key),
                WindowEvent::MouseButton(button, Action::Press, modifiers) => self.press(button, modifiers),
                WindowEvent::MouseButton(_, Action::Release, _) => {
                    self.interaction.release(&self.worker);
                    self.end_of_tool();
                }
                WindowEvent::CursorPos(x, y, modifiers) => {
                    self.move_cursor(Vec2::new(x as f32, y as f32));
                    self.use_tool(ToolEvent::Move, modifiers);
                }
                WindowEvent::Scroll(_, amount, _) if !self.is_on_panel() => {
                    self.framed = None;
                    self.camera.zoom(notches(amount), self.cursor);
                }
                _ => {}
            }
        }
        self.interaction.poll_pick(self.cursor, &mut self.camera, &self.worker);
    }

    fn key(&mut self, key: Key) {
        if self.window.egui_context().text_edit_focused() {
            return; // a number is being typed
        }
        match key {
            Key::S => self.apply(UserRequest::NextSurface),
            Key::N => self.worker.send(Command::NextIntegrator),
            Key::R => self.worker.send(Command::Reset),
            Key::C => self.apply(UserRequest::NextColor),
            Key::T => self.apply(UserRequest::TogglePicture),
            Key::F => self.apply(UserRequest::ToggleForces),
            Key::Key1 => self.apply(UserRequest::Choose(Mode::Pull)),
            Key::Key2 => self.apply(UserRequest::Choose(Mode::Fix)),
            Key::Key3 => self.apply(UserRequest::Choose(Mode::Load)),
            Key::Space => self.worker.send(Command::TogglePause),
            Key::Escape => self.closing = true,
            _ => {}
        }
    }

    fn press(&mut self, button: MouseButton, modifiers: Modifiers) {
        if self.is_on_panel() {
            return;
        }
        self.framed = None;
        // A mouse without a middle button moves the camera with shift.
        let is_left = button == MouseButton::Button1 && !modifiers.contains(Modifiers::Shift);
        if is_left && self.use_tool(ToolEvent::Press, modifiers) {
            return;
        }
        let button = if modifiers.contains(Modifiers::Shift) { MouseButton::Button3 } else { button };
        let (origin, ray) = self.camera.ray(self.cursor);
        let hit = self.view.hit((origin, ray), &self.snapshot.frame);
        let grip = hit.map(|distance| origin + ray * distance);
        self.interaction.press(button, self.cursor, grip, &self.camera, &self.worker);
    }

    fn move_cursor(&mut self, cursor: Vec2) {
        let motion = cursor - self.cursor;
        self.cursor = cursor;
        let scale = self.window.scale_factor() as f32;
        self.interaction.moved(cursor, motion, scale, &mut self.camera, &self.worker);
    }

    fn is_on_panel(&self) -> bool {
        let logical = self.cursor / self.window.scale_factor() as f32;
        self.panel.covers(pos2(logical.x, logical.y)) || self.window.is_egui_capturing_mouse()
    }

    pub(super) fn apply(&mut self, request: UserRequest) {
        match request {
            UserRequest::Send(command) => self.worker.send(command),
            UserRequest::Change(change) => self.changes.add(change),
            UserRequest::Choose(mode) => self.choose(mode),
            UserRequest::Load | UserRequest::ChooseLoad(_) | UserRequest::RemoveLoad => self.apply_to_loads(&request),
            UserRequest::NextSurface => {
                let other = match self.view.shown() {
                    DisplayedSurface::Skinned => DisplayedSurface::SimulationMesh,
                    DisplayedSurface::SimulationMesh => DisplayedSurface::Skinned,
                };
                self.view.show(other);
                self.view.update(&self.snapshot.frame);
            }
            UserRequest::TogglePicture => {
                self.shows_picture = !self.shows_picture;
                self.view.show_picture(self.shows_picture);
                self.view.update(&self.snapshot.frame);
            }
            UserRequest::NextColor => self.want(Wanted { field: self.next_field(), ..self.wanted }),
            UserRequest::ToggleForces => {
                self.want(Wanted { contact_forces: !self.wanted.contact_forces, ..self.wanted });
            }
        }
    }

    fn want(&mut self, wanted: Wanted) {
        self.wanted = wanted;
        self.worker.send(Command::Want(wanted));
    }

    /// The field after the present one; plain colours after the last.
    fn next_field(&self) -> Option<ElementField> {
        let fields = &self.snapshot.fields;
        let next = self.wanted.field.and_then(|field| fields.iter().position(|other| *other == field));
        fields.get(next.map_or(0, |place| place + 1)).copied()
    }
}

/// Notches of a mouse wheel; touch pads send many small amounts.
fn notches(amount: f64) -> f32 {
    (amount as f32 / 10.0).clamp(-3.0, 3.0)
}

//! Mouse interaction: dragging the body, orbiting and panning the camera.

use std::sync::mpsc::{Receiver, TryRecvError, channel};

use fem_model::simulation::Pull;
use kiss3d::event::MouseButton;
use kiss3d::glamx::{Vec2, Vec3};
use kiss3d::window::Window;

use crate::picture::camera::Camera;
use crate::picture::geometry::double;
use crate::picture::theme;
use crate::worker::{Anchors, Command, Worker};

/// The interaction of the pressed mouse button.
#[derive(Default)]
pub enum Interaction {
    /// No button is down.
    #[default]
    Idle,
    /// The simulation has been asked which nodes lie under the click.
    Picking {
        /// Receives the picked nodes.
        answer: Receiver<Anchors>,
        /// Point of the surface under the click, m.
        grip: Vec3,
    },
    /// Picked nodes follow the mouse.
    Dragging {
        /// The picked nodes and their positions at that time, m.
        anchors: Anchors,
        /// Point of the surface under the click, m.
        grip: Vec3,
        /// Displacement of the mouse since, parallel to the picture, m.
        offset: Vec3,
    },
    /// The camera orbits its target.
    Orbiting,
    /// The camera moves parallel to the picture.
    Panning,
}

impl Interaction {
    /// Handles a button pressed at `cursor`; `grip` is the point of the surface there, if there is one.
    pub fn press(&mut self, button: MouseButton, cursor: Vec2, grip: Option<Vec3>, camera: &Camera, to: &Worker) {
        if !matches!(self, Interaction::Idle) {
            return; // the button pressed first decides
        }
        *self = match (button, grip) {
            (MouseButton::Button1, Some(grip)) => {
                let (reply, answer) = channel();
                to.send(Command::Pick(camera.click(cursor), reply));
                Interaction::Picking { answer, grip }
            }
            (MouseButton::Button1 | MouseButton::Button2, _) if camera.turns() => Interaction::Orbiting,
            _ => Interaction::Panning,
        };
    }

    /// Handles a mouse motion to `cursor`, by `motion`, both in physical pixels.
    pub fn moved(&mut self, cursor: Vec2, motion: Vec2, scale: f32, camera: &mut Camera, to: &Worker) {
        match self {
            Interaction::Orbiting => camera.orbit(motion / scale),
            Interaction::Panning => camera.pan(motion),
            Interaction::Dragging { anchors, grip, offset } => {
                *offset = camera.on_plane(cursor, *grip) - *grip;
                to.send(Command::Pull(Some(Pull { anchors: anchors.clone(), offset: double(*offset) })));
            }
            Interaction::Idle | Interaction::Picking { .. } => {}
        }
    }

    /// Starts the drag once the simulation has answered.
    pub fn poll_pick(&mut self, cursor: Vec2, camera: &mut Camera, to: &Worker) {
        let Interaction::Picking { answer, grip } = self else { return };
        match answer.try_recv() {
            Ok(anchors) if !anchors.is_empty() => {
                *self = Interaction::Dragging { anchors, grip: *grip, offset: Vec3::ZERO };
                self.moved(cursor, Vec2::ZERO, 1.0, camera, to);
            }
            Err(TryRecvError::Empty) => {}
            Ok(_) | Err(TryRecvError::Disconnected) => *self = Interaction::Idle,
        }
    }

    /// Handles the release of the button.
    pub fn release(&mut self, to: &Worker) {
        if matches!(self, Interaction::Dragging { .. }) {
            to.send(Command::Pull(None));
        }
        *self = Interaction::Idle;
    }

    /// Draws the picked nodes and the line from their centroid to the mouse into the next frame.
    pub fn draw(&self, window: &mut Window, positions: &[Vec3], camera: &Camera) {
        let Interaction::Dragging { anchors, grip, offset } = self else { return };
        let scale = window.scale_factor() as f32;
        let picked: Vec<Vec3> = anchors.iter().filter_map(|(node, _)| positions.get(*node)).copied().collect();
        let nearer = |point: Vec3| camera.nearer(point, 0.1); // in front of the surface that would hide the nodes
        for &point in &picked {
            window.draw_point(nearer(point), theme::DRAG, 7.0 * scale);
        }
        let centroid = picked.iter().sum::<Vec3>() / picked.len().max(1) as f32;
        let target = *grip + *offset;
        window.draw_line(nearer(centroid), nearer(target), theme::DRAG, 2.5 * scale, false);
        window.draw_point(nearer(target), theme::DRAG, 11.0 * scale);
    }
}

//! What a pressed mouse button does: hold the body, turn the camera, or move it.

use std::sync::mpsc::{Receiver, TryRecvError, channel};

use fem_scene::simulation::Pull;
use kiss3d::event::MouseButton;
use kiss3d::glamx::{Vec2, Vec3};
use kiss3d::window::Window;

use crate::camera::OrbitCamera;
use crate::geometry::double;
use crate::theme;
use crate::worker::{Anchors, Command, Worker};

/// A mouse button, as long as it is down.
#[derive(Default)]
pub enum Hand {
    /// No button.
    #[default]
    Free,
    /// On the body; the simulation was asked which nodes are there.
    Asking {
        /// Where the answer comes.
        answer: Receiver<Anchors>,
        /// Point of the surface under the click, m.
        grip: Vec3,
    },
    /// Nodes are held.
    Holding {
        /// The nodes, and where each was when it was taken.
        anchors: Anchors,
        /// Point of the surface under the click, m.
        grip: Vec3,
        /// How far the hand has moved since, m.
        offset: Vec3,
    },
    /// The camera turns.
    Turning,
    /// The camera moves sideways.
    Shifting,
}

impl Hand {
    /// A button goes down at `cursor`. `grip` is the point of the body there, if the body is there.
    pub fn press(&mut self, button: MouseButton, cursor: Vec2, grip: Option<Vec3>, camera: &OrbitCamera, to: &Worker) {
        if !matches!(self, Hand::Free) {
            return; // the button that came first decides
        }
        *self = match (button, grip) {
            (MouseButton::Button1, Some(grip)) => {
                let (reply, answer) = channel();
                to.send(Command::Pick(camera.click(cursor), reply));
                Hand::Asking { answer, grip }
            }
            (MouseButton::Button1 | MouseButton::Button2, _) => Hand::Turning,
            _ => Hand::Shifting,
        };
    }

    /// The mouse moves to `cursor`, by `motion`, both in physical pixels.
    pub fn moved(&mut self, cursor: Vec2, motion: Vec2, scale: f32, camera: &mut OrbitCamera, to: &Worker) {
        match self {
            Hand::Turning => camera.turn(motion / scale),
            Hand::Shifting => camera.shift(motion),
            Hand::Holding { anchors, grip, offset } => {
                *offset = camera.on_plane(cursor, *grip) - *grip;
                to.send(Command::Pull(Some(Pull { anchors: anchors.clone(), offset: double(*offset) })));
            }
            Hand::Free | Hand::Asking { .. } => {}
        }
    }

    /// Takes hold once the simulation has answered.
    pub fn listen(&mut self, cursor: Vec2, camera: &mut OrbitCamera, to: &Worker) {
        let Hand::Asking { answer, grip } = self else { return };
        match answer.try_recv() {
            Ok(anchors) if !anchors.is_empty() => {
                *self = Hand::Holding { anchors, grip: *grip, offset: Vec3::ZERO };
                self.moved(cursor, Vec2::ZERO, 1.0, camera, to);
            }
            Err(TryRecvError::Empty) => {}
            Ok(_) | Err(TryRecvError::Disconnected) => *self = Hand::Free,
        }
    }

    /// The button goes up.
    pub fn release(&mut self, to: &Worker) {
        if matches!(self, Hand::Holding { .. }) {
            to.send(Command::Pull(None));
        }
        *self = Hand::Free;
    }

    /// Draws the held nodes and the line from them to the hand into the next frame.
    pub fn draw(&self, window: &mut Window, positions: &[Vec3], eye: Vec3) {
        let Hand::Holding { anchors, grip, offset } = self else { return };
        let scale = window.scale_factor() as f32;
        let held: Vec<Vec3> = anchors.iter().filter_map(|(node, _)| positions.get(*node)).copied().collect();
        let nearer = |point: Vec3| point + (eye - point) * 0.1; // in front of the surface that hides the nodes
        for &point in &held {
            window.draw_point(nearer(point), theme::HAND, 7.0 * scale);
        }
        let middle = held.iter().sum::<Vec3>() / held.len().max(1) as f32;
        let hand = *grip + *offset;
        window.draw_line(nearer(middle), nearer(hand), theme::HAND, 2.5 * scale, false);
        window.draw_point(nearer(hand), theme::HAND, 11.0 * scale);
    }
}

//! Messages between the main thread and a worker.

use std::sync::Arc;
use std::time::Duration;

use bevy::mesh::Mesh;
use fem_model::simulation::Shape;

use crate::SoftBodyError;
use crate::SoftBodyPull;
use crate::blueprint::Blueprint;
use crate::frame::Frame;
use crate::link::BodyId;
use crate::surface::Topology;

/// A command to a worker.
pub enum Command {
    /// Build a body.
    Add(BodyId, Box<Blueprint>),
    /// Do steps up to this total number.
    Advance(BodyId, usize),
    /// Pull the body, or let it go, in the steps that are requested afterwards.
    Pull(BodyId, Option<SoftBodyPull>),
    /// Forget the body.
    Remove(BodyId),
    /// Free the memory of a state that is no longer shown.
    Discard(Frame),
}

/// News of a body.
pub enum News {
    /// It was built.
    Ready(Box<Ready>),
    /// It has done a step, which took this long.
    Step(Frame, Duration),
    /// It was refused or has stopped; after an error of a pull it goes on.
    Failed(SoftBodyError),
}

/// A body in its initial state.
pub struct Ready {
    /// Time step, s.
    pub dt: f64,
    /// The undeformed body.
    pub shape: Arc<Shape>,
    /// The triangles of its surface.
    pub topology: Arc<Topology>,
    /// Its surface for the picture.
    pub mesh: Mesh,
    /// Its initial state.
    pub frame: Frame,
}

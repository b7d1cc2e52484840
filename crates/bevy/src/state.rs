//! The component [`SoftBodyState`]: the results of the simulation so far.

use std::collections::VecDeque;
use std::sync::Arc;
use std::time::Duration;

use bevy::asset::Handle;
use bevy::ecs::component::Component;
use bevy::math::{DVec3, Ray3d};
use bevy::mesh::Mesh;
use bevy::transform::components::GlobalTransform;
use fem_model::simulation::Shape;

use crate::clock::Clock;
use crate::frame::Frame;
use crate::link::Link;
use crate::pick::{SoftBodyHit, pick};
use crate::surface::{Blend, Topology};
use crate::{SoftBodyError, SoftBodyMeshSync};

/// The state of a body. The plugin adds it to every [`SoftBody`](crate::SoftBody) and keeps it up to date.
#[derive(Component, Default)]
pub struct SoftBodyState {
    pub(crate) link: Option<Link>,
    pub(crate) model: Option<Model>,
    pub(crate) clock: Clock,
    /// States from the one that is shown to the newest one, in order.
    pub(crate) frames: VecDeque<Frame>,
    /// Number of steps that are due, and of those that were requested.
    pub(crate) due: usize,
    pub(crate) requested: usize,
    pub(crate) step_time: Duration,
    pub(crate) failure: Option<SoftBodyError>,
    /// The mesh for the picture, before it becomes an asset.
    pub(crate) prepared: Option<Mesh>,
    pub(crate) mesh: Option<Handle<Mesh>>,
    /// The time in steps that the mesh shows.
    pub(crate) written: Option<f64>,
}

/// Constant data of a body.
#[derive(Clone)]
pub struct Model {
    /// The undeformed body.
    pub shape: Arc<Shape>,
    /// The triangles of its surface.
    pub topology: Arc<Topology>,
}

/// Stage in the life of a body.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SoftBodyPhase {
    /// Its scene and meshes are read and its system is built.
    Building,
    /// It moves.
    Running,
    /// It was refused or a step has failed; see [`SoftBodyState::failure`].
    Failed,
}

impl SoftBodyState {
    /// Returns the stage that the body is in.
    pub fn phase(&self) -> SoftBodyPhase {
        match (&self.failure, &self.model) {
            (Some(_), _) => SoftBodyPhase::Failed,
            (None, Some(_)) => SoftBodyPhase::Running,
            (None, None) => SoftBodyPhase::Building,
        }
    }

    /// Number of steps of the newest state.
    pub fn steps(&self) -> usize {
        self.newest().map_or(0, |frame| frame.step)
    }

    /// Simulated time of the newest state, s.
    pub fn time(&self) -> f64 {
        self.newest().map_or(0.0, |frame| frame.time)
    }

    /// Time step, s; zero while the body is built.
    pub fn dt(&self) -> f64 {
        self.clock.dt()
    }

    /// Simulated time that an interpolated mesh shows, s: one step ago, or one frame ago where frames are longer.
    pub fn shown_time(&self) -> f64 {
        self.clock.shown()
    }

    /// Time that was left out of the motion because steps took longer than they last, s.
    pub fn dropped_time(&self) -> f64 {
        self.clock.dropped()
    }

    /// Wall-clock time that the newest step took on its thread.
    pub fn step_time(&self) -> Duration {
        self.step_time
    }

    /// Positions of all nodes in the newest state, in the body's frame and the mesh's order, m; empty while the body is built.
    pub fn positions(&self) -> &[DVec3] {
        self.newest().map_or(&[], |frame| &frame.nodes)
    }

    /// The undeformed body; `None` while it is built.
    pub fn shape(&self) -> Option<&Shape> {
        self.model.as_ref().map(|model| &*model.shape)
    }

    /// The reason why the body has stopped.
    pub fn failure(&self) -> Option<&SoftBodyError> {
        self.failure.as_ref()
    }

    /// The first point of the body's surface on a ray of the world; `None` if the ray misses it. `placement` is the entity's.
    pub fn pick(&self, ray: Ray3d, placement: &GlobalTransform) -> Option<SoftBodyHit> {
        let (model, frame) = (self.model.as_ref()?, self.newest()?);
        pick(ray, placement, (&model.topology, &frame.surface), (&model.shape, &frame.nodes))
    }

    fn newest(&self) -> Option<&Frame> {
        self.frames.back()
    }

    /// Removes the states before the displayed one.
    pub(crate) fn outdated(&mut self) -> impl Iterator<Item = Frame> + '_ {
        let shown = self.clock.shown_steps();
        let is_outdated = move |frames: &VecDeque<Frame>| frames.get(1).is_some_and(|next| next.step as f64 <= shown);
        std::iter::from_fn(move || if is_outdated(&self.frames) { self.frames.pop_front() } else { None })
    }

    /// The time that a mesh is to show, in steps, and the surfaces around it.
    pub(crate) fn blend(&self, sync: SoftBodyMeshSync) -> Option<(f64, Blend<'_>)> {
        let (first, last) = (self.frames.front()?, self.frames.back()?);
        let newest = last.step as f64;
        let shown = match sync {
            SoftBodyMeshSync::Interpolated => self.clock.shown_steps().clamp(first.step as f64, newest),
            SoftBodyMeshSync::Newest => newest,
        };
        let after = self.frames.iter().find(|frame| frame.step as f64 >= shown)?;
        let before = self.frames.iter().rfind(|frame| frame.step as f64 <= shown)?;
        let length = (after.step - before.step).max(1) as f64;
        let fraction = ((shown - before.step as f64) / length) as f32;
        Some((shown, Blend { between: [&before.surface, &after.surface], fraction }))
    }
}

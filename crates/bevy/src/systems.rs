//! Systems of the plugin. In each frame they send commands, receive results, and write meshes. They never wait.

use std::time::Duration;

use bevy::asset::Assets;
use bevy::ecs::change_detection::DetectChanges;
use bevy::ecs::lifecycle::Remove;
use bevy::ecs::prelude::{Changed, Commands, Entity, MessageWriter, On, Or, Query, Ref, Res, ResMut, Resource};
use bevy::mesh::{Mesh, Mesh3d};
use bevy::time::Time;

use crate::blueprint::Blueprint;
use crate::clock::Clock;
use crate::state::Model;
use crate::worker::Workers;
use crate::worker::message::{Command, News, Ready};
use crate::{
    SoftBody, SoftBodyFailed, SoftBodyMaterial, SoftBodyMeshSync, SoftBodyPhase, SoftBodyPinnedParticles,
    SoftBodyPlanes, SoftBodyPull, SoftBodyState, SoftBodyTiming,
};

/// Bounds of all bodies.
#[derive(Resource)]
pub struct Bounds {
    /// Simulated time by which a worker may lag before time is dropped.
    pub most_lag: Duration,
}

/// Least number of steps that may be requested and not done: one in work, and one ahead.
const LEAST_AHEAD: usize = 2;

/// The components that a body is built from.
type Parts<'a> = (
    Entity,
    &'a SoftBody,
    Option<&'a SoftBodyMaterial>,
    Option<&'a SoftBodyPinnedParticles>,
    Option<&'a SoftBodyPlanes>,
    Option<&'a SoftBodyPull>,
    &'a mut SoftBodyState,
);

/// A part of a body has been inserted or changed.
type PartChanged =
    Or<(Changed<SoftBody>, Changed<SoftBodyMaterial>, Changed<SoftBodyPinnedParticles>, Changed<SoftBodyPlanes>)>;

/// Has bodies built that are new or have changed.
pub fn build_bodies(
    mut bodies: Query<Parts<'static>, PartChanged>,
    mut workers: ResMut<Workers>,
    mut failed: MessageWriter<SoftBodyFailed>,
    mut timing: ResMut<SoftBodyTiming>,
) {
    timing.begin_frame();
    let _watch = timing.watch();
    for (entity, body, material, pinned, planes, pull, mut state) in &mut bodies {
        if let Some(link) = state.link {
            workers.remove(link);
        }
        *state = SoftBodyState::default();
        match workers.add(entity, Blueprint::new(body, material, pinned, planes)) {
            Ok(link) => {
                state.link = Some(link);
                if let Some(pull) = pull {
                    workers.send(link, Command::Pull(link.id, Some(pull.clone())));
                }
            }
            Err(error) => {
                state.failure = Some(error.clone());
                failed.write(SoftBodyFailed { entity, error });
            }
        }
    }
}

/// Receives the messages of the workers.
pub fn receive_news(
    mut bodies: Query<&mut SoftBodyState>,
    mut workers: ResMut<Workers>,
    mut failed: MessageWriter<SoftBodyFailed>,
    mut timing: ResMut<SoftBodyTiming>,
) {
    let _watch = timing.watch();
    while let Some((entity, news)) = workers.next_news() {
        let Ok(mut state) = bodies.get_mut(entity) else { continue };
        match news {
            News::Ready(ready) => take_over(&mut state, *ready),
            News::Step(frame, duration) => {
                state.frames.push_back(frame);
                state.step_time = duration;
            }
            News::Failed(error) => {
                if !error.is_harmless() {
                    state.failure = Some(error.clone());
                }
                failed.write(SoftBodyFailed { entity, error });
            }
        }
    }
}

fn take_over(state: &mut SoftBodyState, ready: Ready) {
    let Ready { dt, shape, topology, mesh, frame } = ready;
    state.model = Some(Model { shape, topology });
    state.clock = Clock::new(dt);
    state.prepared = Some(mesh);
    state.frames.push_back(frame);
}

/// Sends new and changed pulls.
pub fn send_pulls(
    pulls: Query<(Ref<SoftBodyPull>, &SoftBodyState)>,
    workers: ResMut<Workers>,
    mut timing: ResMut<SoftBodyTiming>,
) {
    let _watch = timing.watch();
    for (pull, state) in &pulls {
        if let Some(link) = state.link.filter(|_| pull.is_changed()) {
            workers.send(link, Command::Pull(link.id, Some(SoftBodyPull::clone(&pull))));
        }
    }
}

/// Advances the clocks, and finds the steps that are due.
pub fn advance_clocks(
    mut bodies: Query<&mut SoftBodyState>,
    time: Res<Time>,
    bounds: Res<Bounds>,
    mut timing: ResMut<SoftBodyTiming>,
) {
    let _watch = timing.watch();
    for mut state in bodies.iter_mut().filter(|state| state.phase() == SoftBodyPhase::Running) {
        let done = state.steps();
        let most_ahead = (bounds.most_lag.as_secs_f64() / state.dt()).ceil() as usize;
        state.due = state.clock.advance(time.delta_secs_f64(), done, most_ahead.max(LEAST_AHEAD));
    }
}

/// Writes the surfaces of bodies into their meshes.
pub fn sync_meshes(
    mut bodies: Query<(Entity, &mut SoftBodyState, &SoftBodyMeshSync)>,
    mut meshes: ResMut<Assets<Mesh>>,
    mut commands: Commands,
    mut timing: ResMut<SoftBodyTiming>,
) {
    let _watch = timing.watch();
    for (entity, mut state, sync) in &mut bodies {
        if state.model.is_none() {
            continue;
        }
        if let Some(mesh) = state.prepared.take() {
            let handle = meshes.add(mesh);
            commands.entity(entity).try_insert(Mesh3d(handle.clone()));
            state.mesh = Some(handle);
        }
        let Some((shown, blend)) = state.blend(*sync) else { continue };
        // A mesh that is left alone is not sent to the graphics card again.
        if state.written == Some(shown) {
            continue;
        }
        if let Some(mut mesh) = state.mesh.as_ref().and_then(|handle| meshes.get_mut(handle)) {
            blend.write(&mut mesh);
        }
        state.written = Some(shown);
    }
}

/// Requests the steps that are due. It comes last, because a thread that wakes up may take the place of this one.
pub fn request_steps(
    mut bodies: Query<&mut SoftBodyState>,
    workers: ResMut<Workers>,
    mut timing: ResMut<SoftBodyTiming>,
) {
    let _watch = timing.watch();
    for mut state in &mut bodies {
        let Some(link) = state.link else { continue };
        if state.due > state.requested {
            state.requested = state.due;
            workers.send(link, Command::Advance(link.id, state.due));
        }
        for frame in state.outdated() {
            workers.send(link, Command::Discard(frame));
        }
    }
}

/// Has a body forgotten whose component is removed or whose entity is despawned.
pub fn forget_body(removed: On<Remove, SoftBody>, mut bodies: Query<&mut SoftBodyState>, mut workers: ResMut<Workers>) {
    if let Ok(mut state) = bodies.get_mut(removed.entity) {
        if let Some(link) = state.link {
            workers.remove(link);
        }
        *state = SoftBodyState::default();
    }
}

/// Lets a body go whose pull is removed.
pub fn end_pull(removed: On<Remove, SoftBodyPull>, bodies: Query<&SoftBodyState>, workers: Res<Workers>) {
    if let Some(link) = bodies.get(removed.entity).ok().and_then(|state| state.link) {
        workers.send(link, Command::Pull(link.id, None));
    }
}

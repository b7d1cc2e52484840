//! The plugin.

use std::num::NonZero;
use std::time::Duration;

use bevy::app::{App, Plugin, PreUpdate};
use bevy::asset::AssetApp;
use bevy::ecs::schedule::{IntoScheduleConfigs, SystemSet};
use bevy::mesh::Mesh;

use crate::systems::{
    Bounds, advance_clocks, build_bodies, end_pull, forget_body, receive_news, request_steps, send_pulls, sync_meshes,
};
use crate::worker::Workers;
use crate::{SoftBodyFailed, SoftBodyTiming};

/// Moves all entities with a [`SoftBody`](crate::SoftBody), on threads of its own.
///
/// Needs the plugins of time and assets, which `DefaultPlugins` has. Time is that of `Time`, so pausing or slowing `Time<Virtual>` does so to the bodies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SoftBodyPlugin {
    /// Number of threads that simulate, each of them some of the bodies; zero means one less than the machine has. Bodies of more than 2 000 nodes
    /// share rayon's threads besides, whose number `RAYON_NUM_THREADS` sets. Positions do not depend on either.
    pub workers: usize,
    /// Simulated time by which bodies may lag behind the game. Beyond it, time is left out of their motion, and
    /// [`SoftBodyState::dropped_time`](crate::SoftBodyState::dropped_time) tells how much.
    pub most_lag: Duration,
}

impl Default for SoftBodyPlugin {
    /// As many threads as the machine has less one, and a lag of at most 0.1 s.
    fn default() -> Self {
        Self { workers: 0, most_lag: Duration::from_millis(100) }
    }
}

/// The plugin's systems in `PreUpdate`. Systems of `Update` see the states and meshes of the same frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, SystemSet)]
pub struct SoftBodySystems;

impl Plugin for SoftBodyPlugin {
    fn build(&self, app: &mut App) {
        let available = || std::thread::available_parallelism().map_or(1, NonZero::get) - 1;
        let workers = if self.workers == 0 { available() } else { self.workers };
        app.insert_resource(Workers::start(workers))
            .insert_resource(Bounds { most_lag: self.most_lag })
            .init_resource::<SoftBodyTiming>()
            .init_asset::<Mesh>()
            .add_message::<SoftBodyFailed>()
            .add_observer(forget_body)
            .add_observer(end_pull)
            .add_systems(
                PreUpdate,
                (build_bodies, receive_news, send_pulls, advance_clocks, sync_meshes, request_steps)
                    .chain()
                    .in_set(SoftBodySystems),
            );
    }
}

//! Deformable solids in [Bevy](https://bevy.org): bodies of `fem-engine` as components.
//!
//! Add [`SoftBodyPlugin`], and spawn entities with a [`SoftBody`] and a [`SoftBodyMeshSync`]. The plugin simulates them with fixed time steps on threads of
//! its own; a frame only sends commands and takes finished states. The positions are those of the engine bit for bit, whatever the
//! frame rate and the number of threads.
//!
//! ```
//! use bevy::prelude::*;
//! use fem_bevy::{SoftBody, SoftBodyFailed, SoftBodyMeshSync, SoftBodyPlugin, SoftBodyState};
//!
//! let mut app = App::new();
//! app.add_plugins((MinimalPlugins, AssetPlugin::default(), SoftBodyPlugin::default()));
//! let data = concat!(env!("CARGO_MANIFEST_DIR"), "/../../data");
//! let armadillo = app.world_mut().spawn((SoftBody::scene("arma-engine", data), SoftBodyMeshSync::default())).id();
//! app.add_systems(Update, |mut failed: MessageReader<SoftBodyFailed>| {
//!     for SoftBodyFailed { entity, error } in failed.read() {
//!         eprintln!("{entity}: {error}");
//!     }
//! });
//! while app.world().get::<SoftBodyState>(armadillo).is_none_or(|state| state.steps() < 3) {
//!     app.update();
//! }
//! assert!(app.world().get::<Mesh3d>(armadillo).is_some());
//! ```
//!
//! `docs/book/game-engines.md` leads from an empty package to a body that is pulled with the mouse, with the parameters, limits and costs.

#![deny(missing_docs)]

mod blueprint;
mod clock;
mod error;
mod frame;
mod link;
mod pick;
mod plugin;
mod properties;
mod pull;
mod soft_body;
mod state;
mod surface;
mod systems;
mod timing;
mod worker;

pub use error::{SoftBodyError, SoftBodyFailed};
pub use pick::SoftBodyHit;
pub use plugin::{SoftBodyPlugin, SoftBodySystems};
pub use properties::{SoftBodyMaterial, SoftBodyMeshSync, SoftBodyPinnedParticles, SoftBodyPlane, SoftBodyPlanes};
pub use pull::SoftBodyPull;
pub use soft_body::SoftBody;
pub use state::{SoftBodyPhase, SoftBodyState};
pub use timing::SoftBodyTiming;

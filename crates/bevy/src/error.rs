//! The reasons why a soft body is refused or stops, and the message that carries them.

use bevy::ecs::entity::Entity;
use bevy::ecs::message::Message;
use fem_model::simulation::Failure;
use fem_scene::SceneError;
use thiserror::Error;

/// A soft body was refused, or has stopped. It is written once for each such event.
///
/// After an error of a pull the body goes on without the new pull. After any other it stays where its last good step has left it,
/// until its [`SoftBody`](crate::SoftBody) is inserted again.
#[derive(Clone, Debug, Message, PartialEq)]
pub struct SoftBodyFailed {
    /// The entity of the body.
    pub entity: Entity,
    /// The reason, with its remedy.
    pub error: SoftBodyError,
}

/// The reason why a soft body was refused or has stopped.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum SoftBodyError {
    /// The scene has a problem; names file, line, field and remedy.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// A component has a problem; names the field and the remedy.
    #[error("{0}")]
    Component(String),
    /// A pull has a problem; names the field and the remedy.
    #[error("{0}")]
    Pull(String),
    /// A step failed; the body keeps the state before it.
    #[error(transparent)]
    Step(#[from] Failure),
    /// The simulation panicked, which is a fault in the program; holds the panic's message.
    #[error("the simulation has a fault and stopped: {0}; please report it with the scene")]
    Panicked(String),
    /// The system gives no thread for the simulation; holds its reason.
    #[error("no thread could be started for the simulation: {0}; end other programs, or give fewer `workers`")]
    NoThread(String),
}

impl SoftBodyError {
    /// Returns true if the body continues to move after this error.
    pub(crate) fn is_harmless(&self) -> bool {
        matches!(self, Self::Pull(_))
    }
}

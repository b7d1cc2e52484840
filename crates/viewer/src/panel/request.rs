//! Requests of the user.

use crate::editing::change::Change;
use crate::setup::Mode;
use crate::worker::Command;

/// A request that the user makes through the panel or a key.
pub enum UserRequest {
    /// A command to the simulation.
    Send(Command),
    /// Show the other surface.
    NextSurface,
    /// Show the next field as colours, or plain colours.
    NextColor,
    /// Show the picture that the body was made from on it, or plain colours.
    TogglePicture,
    /// Show contact forces, or hide them.
    ToggleForces,
    /// Change the scene.
    Change(Change),
    /// Use another tool.
    Choose(Mode),
    /// Give the picked faces the traction of the panel.
    Load,
    /// Pick the faces of a load.
    ChooseLoad(usize),
    /// Remove the load of the picked faces.
    RemoveLoad,
}

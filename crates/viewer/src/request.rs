//! Requests of the user.

use std::path::PathBuf;

use crate::change::Change;
use crate::setup::Mode;

/// A request that the user makes through the panel or a key.
#[derive(Clone, Debug, PartialEq)]
pub enum UserRequest {
    /// Pause or continue.
    TogglePause,
    /// Go back to the initial state.
    Reset,
    /// Continue with the next integrator.
    NextIntegrator,
    /// Show the other surface.
    NextSurface,
    /// Show the next field as colours, or plain colours.
    NextColor,
    /// Show the picture that the body was made from on it, or plain colours.
    TogglePicture,
    /// Show contact forces, or hide them.
    ToggleForces,
    /// Set a parameter of the simulation.
    Set(&'static str, f64),
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
    /// Write the scene to a new file.
    Save(PathBuf),
}

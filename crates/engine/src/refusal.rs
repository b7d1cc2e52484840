//! Reasons to refuse a scene.

/// A field of the scene that the engine refuses: its name, and the problem with its remedy.
pub(crate) type Refusal = (&'static str, String);

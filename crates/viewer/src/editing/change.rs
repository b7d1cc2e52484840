//! Changes of a scene that the user asks for.

use std::path::PathBuf;

use fem_scene::Override;

/// A change of a scene.
#[derive(Clone, Debug, PartialEq)]
pub enum Change {
    /// Another value of a parameter, by its key.
    Number(&'static str, f64),
    /// Another picture, in the folder of the present one.
    Object(PathBuf),
    /// Other tables.
    Edit(Edit),
}

/// Other tables of a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Edit {
    /// The table that it changes, such as `traction.0`. A later edit of the same table replaces one that waits.
    pub table: String,
    /// The keys that it sets and removes.
    pub overrides: Vec<Override>,
    /// Its effect on the motion and the method.
    pub effect: Effect,
}

/// The effect of an edit on a simulation that runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Effect {
    /// Other Dirichlet conditions, obstacles or plastic flow: the motion starts again, because nodes would jump.
    Supports,
    /// Other loads: the motion goes on.
    Loads,
    /// Another integrator or solver: the motion goes on if the new method can take it over.
    Method,
}

impl Change {
    /// Returns true if a later change supersedes this one.
    pub fn is_replaced_by(&self, later: &Self) -> bool {
        match (self, later) {
            (Self::Number(a, _), Self::Number(b, _)) => a == b,
            (Self::Object(_), Self::Object(_)) => true,
            (Self::Edit(a), Self::Edit(b)) => a.table == b.table,
            (Self::Number(..) | Self::Object(_) | Self::Edit(_), _) => false,
        }
    }
}

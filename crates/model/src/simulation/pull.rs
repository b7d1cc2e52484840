//! What a user does in a picture: clicks and pulls.

use nalgebra::{Matrix4, Vector3, Vector4};

/// A click into a picture of the simulation mesh, in OpenGL's conventions.
#[derive(Clone, Debug, PartialEq)]
pub struct Click {
    /// Pixels from the lower left; z is not used.
    pub win: Vector3<f64>,
    /// World to eye.
    pub view: Matrix4<f32>,
    /// Eye to clip, depth −1…1.
    pub proj: Matrix4<f32>,
    /// `(x, y, width, height)` in pixels.
    pub viewport: Vector4<f32>,
}

/// Springs of zero rest length from nodes to their positions when the pull began, plus a common offset.
#[derive(Clone, Debug, PartialEq)]
pub struct Pull {
    /// Nodes that are pulled, and the position of each when the pull began, m.
    pub anchors: Vec<(usize, Vector3<f64>)>,
    /// Displacement of the mouse since then, m.
    pub offset: Vector3<f64>,
}

//! Obstacles, for pictures, and their forces.

use nalgebra::Vector3;

/// A half-space that the body does not enter, at one time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plane {
    /// A point of the plane, m.
    pub point: Vector3<f64>,
    /// Unit normal, towards the body.
    pub normal: Vector3<f64>,
}

/// The force of an obstacle on the body.
#[derive(Clone, Debug, PartialEq)]
pub struct PlaneContact {
    /// The scene's table, such as `planes[0]`.
    pub name: String,
    /// Sum over the nodes in the last step, friction included, N; the mean over the step for an explicit method.
    pub force: [f64; 3],
    /// Distance of the nearest node, m.
    pub smallest_gap: f64,
}

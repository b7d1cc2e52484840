//! Obstacles, for pictures.

use nalgebra::Vector3;

/// A half-space that the body does not enter, at one time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plane {
    /// A point of the plane, m.
    pub point: Vector3<f64>,
    /// Unit normal, towards the body.
    pub normal: Vector3<f64>,
}

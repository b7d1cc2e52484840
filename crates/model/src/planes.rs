//! Obstacles: half-spaces, and their motions.

use nalgebra::Vector3;

use crate::LoadCurve;

/// A half-space that the body does not enter.
#[derive(Clone, Debug, PartialEq)]
pub struct ContactPlane {
    /// A point of the plane before its motion, m.
    pub point: Vector3<f64>,
    /// Unit normal, towards the body.
    pub normal: Vector3<f64>,
    /// Coefficient of Coulomb friction.
    pub friction: f64,
    /// How the plane moves.
    pub motion: PlaneMotion,
}

/// Motion of an obstacle.
#[derive(Clone, Debug, PartialEq)]
pub enum PlaneMotion {
    /// The plane stays where it is.
    AtRest,
    /// A constant velocity.
    Uniform {
        /// m/s
        velocity: Vector3<f64>,
        /// Time at which the motion ends, s; infinite for a motion without end.
        until: f64,
    },
    /// A displacement times a factor of time.
    Curve {
        /// m
        displacement: Vector3<f64>,
        /// Its factor, without jumps.
        curve: LoadCurve,
    },
}

impl ContactPlane {
    /// Displacement of the plane at a time (s), m.
    pub fn displacement(&self, time: f64) -> Vector3<f64> {
        match &self.motion {
            PlaneMotion::AtRest => Vector3::zeros(),
            PlaneMotion::Uniform { velocity, until } => velocity * time.min(*until),
            PlaneMotion::Curve { displacement, curve } => displacement * curve.factor(time),
        }
    }

    /// Its mean velocity between two times (s), m/s.
    pub fn mean_velocity(&self, [from, to]: [f64; 2]) -> Vector3<f64> {
        match &self.motion {
            PlaneMotion::AtRest => Vector3::zeros(),
            PlaneMotion::Uniform { velocity, until } if to <= *until => *velocity,
            _ => (self.displacement(to) - self.displacement(from)) / (to - from),
        }
    }

    /// Returns true if the plane never moves.
    pub fn is_at_rest(&self) -> bool {
        self.motion == PlaneMotion::AtRest
    }

    /// A plane through a point (m) whose normal, of any length above zero, shows towards the body.
    pub fn new(point: Vector3<f64>, normal: Vector3<f64>) -> Self {
        // Without overflow on the way to a length of 1.
        Self { point, normal: (normal / normal.amax()).normalize(), friction: 0.0, motion: PlaneMotion::AtRest }
    }
}

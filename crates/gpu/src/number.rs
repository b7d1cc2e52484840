//! Number types of shaders.

use bytemuck::Pod;

/// A number type that a shader computes with.
pub trait Number: Pod + Send + Sync {
    /// Its name in WGSL.
    const WGSL: &'static str;
    /// True if the number type needs the device's feature for double precision.
    const IS_DOUBLE: bool;

    /// The nearest number.
    fn of(value: f64) -> Self;

    /// As a number in double precision.
    fn as_f64(self) -> f64;
}

impl Number for f32 {
    const WGSL: &'static str = "f32";
    const IS_DOUBLE: bool = false;

    fn of(value: f64) -> Self {
        value as Self
    }

    fn as_f64(self) -> f64 {
        f64::from(self)
    }
}

impl Number for f64 {
    const WGSL: &'static str = "f64";
    const IS_DOUBLE: bool = true;

    fn of(value: f64) -> Self {
        value
    }

    fn as_f64(self) -> f64 {
        self
    }
}

//! Batches: many environments of one body.

use crate::{Body, Material};

/// The environments of a batch, at least one.
#[derive(Clone, Debug, PartialEq)]
pub struct Batch(pub Vec<EnvironmentValues>);

/// The values of one environment; `None` for a quantity that does not vary.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct EnvironmentValues {
    /// `material.young`, Pa.
    pub young: Option<f64>,
    /// `material.poisson`.
    pub poisson: Option<f64>,
    /// `material.density`, kg/m³.
    pub density: Option<f64>,
    /// Factor on `gravity.acceleration`.
    pub gravity: Option<f64>,
}

impl EnvironmentValues {
    /// The material of an environment.
    pub fn material(&self, material: &Material) -> Material {
        Material {
            law: material.law.with_moduli(self.young, self.poisson),
            density: self.density.unwrap_or(material.density),
            ..*material
        }
    }

    /// The quantities that vary, with their keys in `[batch.vary]`.
    pub fn varied(&self) -> impl Iterator<Item = (&'static str, f64)> {
        let all =
            [("young", self.young), ("poisson", self.poisson), ("density", self.density), ("gravity", self.gravity)];
        all.into_iter().filter_map(|(key, value)| Some((key, value?)))
    }
}

impl Body {
    /// The body of an environment of a batch.
    pub fn environment(&self, values: &EnvironmentValues) -> Self {
        let mut body = Self { material: values.material(&self.material), ..self.clone() };
        if let (Some(acceleration), Some(factor)) = (&mut body.gravity, values.gravity) {
            *acceleration *= factor;
        }
        body
    }
}

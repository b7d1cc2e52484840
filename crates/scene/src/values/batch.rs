//! The environments of a batch as values.

use crate::Scene;
use crate::tables::{BatchTable, RangeTable, Spacing};

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
    /// The quantities that vary, with their keys in `[batch.vary]`.
    pub fn varied(&self) -> impl Iterator<Item = (&'static str, f64)> {
        let all =
            [("young", self.young), ("poisson", self.poisson), ("density", self.density), ("gravity", self.gravity)];
        all.into_iter().filter_map(|(key, value)| Some((key, value?)))
    }
}

impl RangeTable {
    /// The value of environment `number` of `count`; that of a single environment is `from`.
    pub fn value(&self, number: usize, count: usize) -> f64 {
        let Self { from, to, spacing } = *self;
        let part = if count > 1 { number as f64 / (count - 1) as f64 } else { 0.0 };
        // The ends are exact.
        match spacing {
            _ if part == 0.0 => from,
            _ if part == 1.0 => to,
            Spacing::Even => from + part * (to - from),
            Spacing::Geometric => from * (to / from).powf(part),
        }
    }
}

impl BatchTable {
    /// The values of an environment.
    pub fn values(&self, number: usize) -> EnvironmentValues {
        let value = |range: Option<RangeTable>| range.map(|range| range.value(number, self.count));
        let vary = &self.vary;
        EnvironmentValues {
            young: value(vary.young),
            poisson: value(vary.poisson),
            density: value(vary.density),
            gravity: value(vary.gravity),
        }
    }
}

impl Scene {
    /// The scene of one environment, without `[batch]`; a scene that has none is its only environment.
    pub fn environment(&self, number: usize) -> Self {
        let mut scene = self.clone();
        let Some(batch) = scene.batch.take() else { return scene };
        let EnvironmentValues { young, poisson, density, gravity } = batch.values(number);
        scene.material.young = young.or(scene.material.young);
        scene.material.poisson = poisson.or(scene.material.poisson);
        scene.material.density = density.unwrap_or(scene.material.density);
        if let (Some(table), Some(factor)) = (&mut scene.gravity, gravity) {
            table.acceleration = table.acceleration.map(|component| factor * component);
        }
        scene
    }

    /// Number of environments; 1 without `[batch]`.
    pub fn environments(&self) -> usize {
        self.batch.as_ref().map_or(1, |batch| batch.count)
    }
}

//! The environments of a scene as values.

use fem_model::{Batch, EnvironmentValues, Refusal};

use crate::Scene;
use crate::tables::{BatchTable, RangeTable, Spacing};

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

    /// The values of its environments; a scene without `[batch]` is its only one.
    pub fn environment_values(&self) -> Batch {
        let values = |batch: &BatchTable| (0..batch.count).map(|number| batch.values(number)).collect();
        Batch(self.batch.as_ref().map_or(vec![EnvironmentValues::default()], values))
    }

    /// Refuses a scene of many environments, for those who simulate one body.
    pub fn check_one_body(&self) -> Result<(), Refusal> {
        if self.batch.is_none() {
            return Ok(());
        }
        let problem = "is a table of many environments, and this is a simulation of one body; run the scene with --headless, or remove it";
        Err(Refusal::new("batch", problem))
    }
}

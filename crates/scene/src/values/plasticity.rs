//! The plastic flow of a scene.

use fem_model::Plasticity;

use crate::Scene;
use crate::tables::PlasticModel;

/// `[plasticity]` of a checked scene.
pub(crate) fn plasticity(scene: &Scene) -> Option<Plasticity> {
    let table = scene.plasticity.as_ref()?;
    Some(match table.model {
        PlasticModel::Additive => Plasticity::Additive {
            yield_strain: table.yield_strain?,
            creep: table.creep?,
            maximum: table.maximum.unwrap_or(f64::INFINITY),
        },
        PlasticModel::J2 => {
            Plasticity::J2 { yield_stress: table.yield_stress?, hardening: table.hardening.unwrap_or(0.0) }
        }
    })
}

//! Volumetric locking of linear tetrahedra, and elements without it: the tip deflection of a cantilever relative to Timoshenko's beam
//! theory, for Poisson's ratios up to ½ and a sequence of meshes.

use fem_engine::cantilever::{expected_tip_displacement, tip_displacement};
use fem_model::simulation::Simulation;
use serde::{Deserialize, Serialize};

use crate::scenes::{Elements, double, scene_and_body};

/// Poisson's ratios.
pub const RATIOS: [f64; 6] = [0.0, 0.3, 0.45, 0.49, 0.499, 0.4999];

/// Poisson's ratios of a table of these elements: those near ½ for the forms that are made for them, and ½ itself with pressures.
pub fn ratios(elements: Elements) -> impl Iterator<Item = f64> {
    let Elements { volumetric: form, .. } = elements;
    let usual = RATIOS.into_iter().filter(move |ratio| *ratio > 0.4 || form == "standard");
    usual.chain((form == "mixed").then_some(0.5))
}

/// The tip deflection of one beam.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TipDeflection {
    /// Its elements.
    pub elements: String,
    /// Poisson's ratio.
    pub poisson: f64,
    /// Cells per metre of a beam of 8 × 1 × 1 m.
    pub cells: usize,
    /// Tip deflection over that of theory.
    pub ratio: f64,
}

/// Solves the beam under a transverse traction at its end.
pub fn bend(elements: Elements, poisson: f64, cells: usize) -> Result<TipDeflection, String> {
    let [order, volumetric] = elements.keys();
    let text = format!(
        "pipeline = \"engine\"\n[mesh]\nbox = {{ size = [8, 1, 1], cells_per_unit = {cells}, pattern = \"kuhn\" }}\n{order}[material]\n\
         model = \"linear\"\nyoung = 1e6\npoisson = {poisson}\n{volumetric}density = 1000.0\n[fixed]\n\
         plane = {{ axis = \"x\", below = 1e-9 }}\n[[traction]]\non = {{ axis = \"x\", side = \"max\", within = 1e-9 }}\n\
         force_per_area = [0, 0, -50]\n[time]\ndt = 1.0\nintegrator = \"static\"\nsteps = 1\n"
    );
    let (scene, body) = scene_and_body(&text, None).map_err(|error| error.to_string())?;
    let mut simulation = double(&text, None)?;
    simulation.step().map_err(|failure| failure.to_string())?;
    let expected = expected_tip_displacement(&body, &scene.method()).ok_or("the beam is no cantilever")?;
    Ok(TipDeflection {
        elements: elements.to_string(),
        poisson,
        cells,
        ratio: tip_displacement(&simulation).z / expected.z,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenes::{LINEAR, WITHOUT_LOCKING};

    #[test]
    fn a_nearly_incompressible_beam_locks() {
        let bent = bend(LINEAR, 0.4999, 2).unwrap();
        assert!(bent.ratio > 0.0 && bent.ratio < 0.1, "{bent:?}");
        assert!(bend(LINEAR, 0.0, 2).unwrap().ratio > 5.0 * bent.ratio);
    }

    #[test]
    fn elements_without_locking_bend() {
        for elements in WITHOUT_LOCKING {
            let ratio = bend(elements, ratios(elements).last().unwrap(), 2).unwrap().ratio;
            assert!((0.5..1.05).contains(&ratio), "{elements}: {ratio}");
        }
    }
}

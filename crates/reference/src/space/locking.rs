//! Volumetric locking of linear tetrahedra, and elements without it: the tip deflection of a cantilever relative to Timoshenko's beam
//! theory, for Poisson's ratios up to ½ and a sequence of meshes.

use fem_engine::cantilever::{expected_tip_displacement, tip_displacement};
use fem_engine::simulator::Simulator;
use fem_mesh::{Pattern, box_mesh};
use fem_model::simulation::Simulation;
use fem_model::{Axis, Body, BodyMesh, Elastic, Integrator, Law, Material, Method, Selector, Volumetric};
use serde::{Deserialize, Serialize};

use crate::Elements;
use crate::Result;

/// Poisson's ratios.
pub const RATIOS: [f64; 6] = [0.0, 0.3, 0.45, 0.49, 0.499, 0.4999];

/// Poisson's ratios of a table of these elements: those near ½ for the forms that are made for them, and ½ itself with pressures.
pub fn ratios(elements: Elements) -> impl Iterator<Item = f64> {
    let Elements { volumetric: form, .. } = elements;
    let usual = RATIOS.into_iter().filter(move |ratio| *ratio > 0.4 || form == Volumetric::Standard);
    usual.chain((form == Volumetric::Mixed).then_some(0.5))
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

/// The linear beam of 8 × 1 × 1 m under a transverse traction at its end.
pub fn beam(elements: Elements, poisson: f64, cells: usize) -> Result<Body> {
    let mesh = BodyMesh::from(box_mesh([8.0, 1.0, 1.0], cells, Pattern::Kuhn)?);
    let mesh = mesh.of_order(elements.order).ok_or("there is no such element")?;
    let law = Law::Linear(Elastic::new(1e6, poisson));
    let material = Material { volumetric: elements.volumetric, ..Material::new(law, 1000.0) };
    let body = Body::new(mesh, material)?.fix(&Selector::least(Axis::X))?;
    Ok(body.traction(&Selector::most(Axis::X), [0.0, 0.0, -50.0])?)
}

/// Solves the beam.
pub fn bend(elements: Elements, poisson: f64, cells: usize) -> Result<TipDeflection> {
    let (body, method) = (beam(elements, poisson, cells)?, Method::new(Integrator::Static, 1.0));
    let expected = expected_tip_displacement(&body, &method).ok_or("the beam is no cantilever")?;
    let mut simulation = Simulator::<f64>::new(body, &method)?;
    simulation.step()?;
    let ratio = tip_displacement(&simulation).z / expected.z;
    Ok(TipDeflection { elements: elements.to_string(), poisson, cells, ratio })
}

//! Viscoelasticity by a Prony series: a bar that is stretched suddenly, or at a constant rate and then held. Findley, Lai and Onaran, Creep and Relaxation
//! of Nonlinear Viscoelastic Materials (1976), sections 5.4 and 5.5.

use std::path::Path;
use std::time::Instant;

use fem_engine::simulator::Simulator;
use fem_model::simulation::{Diagnostics, Simulation};
use fem_model::{Axis, Elastic, Integrator, Law, LoadCurve, Material, Method, Motion, PronyTerm, Selector, Viscosity};
use nalgebra::Vector3;

use super::case::{CLOSED_FORM, Level, Mapped, Quantity, part, supported};
use crate::scenes::steps;
use crate::study::{Part, Result};

/// Ratio and time (s) of each term.
const TERMS: [[f64; 2]; 2] = [[0.5, 0.2], [0.3, 2.0]];
/// Young's modulus, Pa, Poisson's ratio, and the strain.
const ELASTIC: Elastic = Elastic { young: 1e5, poisson: 0.3 };
const STRAIN: f64 = 1e-3;

/// Stresses relative to those of the law, 1 + Σ g e^(−t/τ) after a sudden strain, 1 + Σ g τ/t (1 − e^(−t/τ)) at a constant rate.
pub fn run(_: &Path, quick: bool) -> Result<Part> {
    let sum = |of: fn(f64) -> f64| 1.0 + TERMS.iter().map(|[ratio, time]| ratio * of(*time)).sum::<f64>();
    let quantity = |name, reference| Quantity { name, reference, tolerance: 1e-10, source: CLOSED_FORM };
    let of = [
        quantity("1 s after a sudden strain", sum(|time| (-1.0 / time).exp())),
        quantity("after 1 s of a constant rate", sum(|time| -time * (-1.0 / time).exp_m1())),
        quantity("1 s later", sum(|time| -time * (-1.0 / time).exp_m1() * (-1.0 / time).exp())),
    ];
    let text = "Stress of a bar over that of its law. Linear law, ν = 0.3, two terms with ratios of 0.5 and 0.3 and times of 0.2 and 2 s, quadratic tetrahedra, so many \
                steps a second. The recursion is exact where the strain is linear in a step, so that no step is too long.";
    part(("prony", text), &of, (&[1, 4, 16], 3), quick, |per_second| {
        let start = Instant::now();
        let mut held = bar(per_second, LoadCurve::Table(vec![[0.0, 1.0]]))?;
        let x = held.shape().mesh.vertices().to_vec();
        let stretched = x.iter().map(|x| (STRAIN * x.component_mul(&Vector3::new(1.0, -0.3, -0.3))).into());
        held.set_state(&stretched.collect::<Vec<_>>(), &vec![[0.0; 3]; x.len()]);
        steps(&mut held, per_second)?;
        let mut ramp = bar(per_second, LoadCurve::Ramp(1.0))?;
        let mut values = vec![stress(&held)];
        for _ in 0..2 {
            steps(&mut ramp, per_second)?;
            values.push(stress(&ramp));
        }
        Ok(Level { nodes: x.len(), values, seconds: start.elapsed().as_secs_f64() })
    })
}

/// A cube on three symmetry planes, whose side x = 1 moves by a strain times a curve.
fn bar(per_second: usize, curve: LoadCurve) -> Result<Simulator<f64>> {
    let Mapped { mesh, places } = Mapped::cube([1; 3], |x| *x)?;
    let body =
        supported(mesh, Material::new(Law::Linear(ELASTIC), 1.0), &places, |x| [x.x == 0.0, x.y == 0.0, x.z == 0.0])?;
    let motion = Motion { curve: Some(curve), ..Motion::by([STRAIN, 0.0, 0.0]) };
    let terms = TERMS.map(|[modulus_ratio, time]| PronyTerm { modulus_ratio, time });
    let body = body
        .prescribe(&Selector::most(Axis::X), [true, false, false], motion)
        .and_then(|body| body.field(Viscosity::new(terms.to_vec())));
    let method = Method::new(Integrator::Static, 1.0 / per_second as f64);
    Ok(body.and_then(|body| Simulator::new(body, &method))?)
}

/// Stress of the side that moves, over that of the law.
fn stress(simulation: &Simulator<f64>) -> f64 {
    simulation.reactions().last().map_or(f64::NAN, |moved| moved.force[0] / (STRAIN * ELASTIC.young))
}

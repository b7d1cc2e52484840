//! Plastic flow: fast and slow creep, low yield, stiff bodies, large strains. The dissipated energy never falls.

use fem_model::simulation::Simulation;
use fem_model::{Axis, Body, Integrator, LoadCurve, Motion, Plasticity, Selector};

use super::*;

const FAMILY: &str = "plastic flow";

/// Meshes of a solid and of a flat bar of 2 m.
const BODIES: [(&str, Grid); 2] = [("solid", Grid::Solid([2.0, 1.0, 1.0], 1)), ("flat", Grid::Flat([2.0, 1.0], 2))];

/// Adds the family.
pub fn add(cases: &mut Vec<Case>, quick: bool) {
    let bodies = if quick { &BODIES[1..] } else { &BODIES[..] };
    let stiffness: &[f64] = if quick { &[1e5] } else { &[1e2, 1e5, 1e12] };
    for (&(name, grid), &young) in pairs(bodies, stiffness) {
        let setup = |law| Setup { grid, young, ..Setup::small(Integrator::ImplicitEuler, law) };
        let body = format!("{name}, E = {young:e} Pa");
        for (creep, yield_strain) in pairs([1e-3, 1.0, 1e9], [1e-12, 0.05]) {
            let flow = Plasticity::Additive { yield_strain, creep, maximum: 0.6 };
            let parameters = format!("{body}, yield strain {yield_strain:e}, creep {creep:e}/s");
            cases.extend(driven(&setup("corotated"), flow, &parameters));
        }
        for (yields, hardens) in [(1e-9, 0.0), (1e-2, 0.0), (1e-2, 1e-1), (1e3, 0.0)] {
            let (yield_stress, hardening) = (yields * young, hardens * young);
            let flow = Plasticity::J2 { yield_stress, hardening };
            let parameters = format!("{body}, yield stress {yield_stress:e} Pa, hardening {hardening:e} Pa");
            cases.extend(driven(&setup("hencky"), flow, &parameters));
        }
    }
}

/// The bar pulled to twice its length, and squashed to half of it, to and fro, each way in as many passages of a wave at every stiffness.
fn driven(setup: &Setup, flow: Plasticity, parameters: &str) -> [Case; 2] {
    let half = 5.0 / (setup.young / setup.density).sqrt();
    [("pulled to twice its length and back", 2.0), ("squashed to half its length and back", -1.0)].map(
        |(case, distance)| {
            let curve = LoadCurve::Table(vec![[0.0, 0.0], [half, 1.0], [2.0 * half, 0.0]]);
            let motion = Motion { curve: Some(curve), ..Motion::by([distance, 0.0, 0.0]) };
            let setup = Setup { dt: half / 25.0, ..setup.clone() }.with(clamp).with(move |body, _| {
                let body = body.prescribe(&Selector::most(Axis::X), [true; 3], motion.clone())?;
                Ok(Body { plasticity: Some(flow), ..body })
            });
            Case { margin_is: "smallest J", ..setup.case(FAMILY, case, parameters.to_owned(), watched) }
        },
    )
}

fn watched(setup: &Setup, deadline: Deadline) -> Result<Finding, Finding> {
    let mut simulation = setup.build()?;
    let dissipated = |simulation: &dyn Simulation| simulation.plastic_flow().map_or(f64::NAN, |flow| flow.dissipated);
    let (mut before, mut falls) = (0.0, false);
    let end = march_with(&mut simulation, 60, deadline, |simulation| {
        let now = dissipated(simulation);
        falls |= !(now >= before);
        before = now;
    });
    let finding = end.survival();
    Ok(if falls { Finding::plain(Outcome::Deviates, "the dissipated energy falls".to_owned()) } else { finding })
}

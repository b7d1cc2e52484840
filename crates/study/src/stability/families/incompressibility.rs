//! Nearly incompressible materials: survival, and volumetric locking.

use fem_engine::cantilever::{expected_tip_displacement, tip_displacement};
use fem_model::simulation::Simulation;
use fem_model::{Axis, Integrator, Selector};

use super::*;
use fem_reference::space::locking::{RATIOS, ratios};
use fem_reference::{Elements, LINEAR, WITHOUT_LOCKING};

const FAMILY: &str = "Poisson's ratio";

/// The case that shows locking.
pub const CANTILEVER: &str = "slender cantilever against Timoshenko's beam theory";

/// A cantilever locks if its tip deflection is below this share of theory.
const LOCKED: f64 = 0.5;

/// Adds the family.
pub fn add(cases: &mut Vec<Case>, quick: bool) {
    let laws: &[&str] = if quick { &LAWS[3..] } else { &LAWS };
    for poisson in RATIOS {
        let methods = [(Integrator::ImplicitEuler, if quick { 10 } else { 50 }), (Integrator::Static, 1)];
        for (&law, (integrator, steps)) in pairs(laws, methods) {
            let setup = Setup { poisson, young: 1e6, ..Setup::finer(integrator, law) };
            cases.push(sagging(setup.with(clamp).with(gravity([0.0, 0.0, -9.81])), steps));
        }
        let cells: &[usize] = if quick { &[4] } else { &[2, 4, 6] };
        cases.extend(cells.iter().map(|&cells| cantilever(LINEAR, poisson, cells)));
    }
    for elements in WITHOUT_LOCKING {
        let all: Vec<f64> = ratios(elements).collect();
        let shown = if quick { &all[all.len() - 1..] } else { &all };
        cases.extend(shown.iter().map(|&poisson| cantilever(elements, poisson, 2)));
    }
}

fn sagging(setup: Setup, steps: usize) -> Case {
    let parameters = format!("nu = {}, E = {:e} Pa, dt = {:e} s, {steps} steps", setup.poisson, setup.young, setup.dt);
    setup.surviving(FAMILY, "clamped body, sagging under its weight", parameters, steps)
}

/// A slender beam. Near ν = ½ linear elements lock on all these meshes, and the study expects that, as it expects that the others do not.
fn cantilever(elements: Elements, poisson: f64, cells: usize) -> Case {
    // Two cells across lock sooner.
    let locks = elements == LINEAR && poisson > if cells > 2 { 0.48 } else { 0.44 };
    let grid = Grid::Solid([8.0, 1.0, 1.0], cells);
    let setup = Setup { grid, elements, poisson, young: 1e6, dt: 1.0, ..Setup::small(Integrator::Static, "linear") };
    let end = Selector::most(Axis::X);
    let setup = setup.with(clamp).with(move |body, _| body.traction(&end, [0.0, 0.0, -50.0]));
    let parameters = format!("nu = {poisson}, 8 x 1 x 1 m, {cells} cells per metre");
    Case {
        expected: if locks { Outcome::Locks } else { Outcome::Survives },
        margin_is: "tip deflection over that of theory; 1 is exact, below 0.5 counts as locked",
        ..setup.case(FAMILY, CANTILEVER, parameters, |setup, deadline| {
            let theory = expected_tip_displacement(&setup.body()?, &setup.method()).unwrap_or_default();
            let mut simulation = setup.build()?;
            march(&mut simulation, 1, deadline).survived()?;
            let part = tip_displacement(&simulation).dot(&theory) / theory.norm_squared();
            let outcome = if part < LOCKED { Outcome::Locks } else { Outcome::Survives };
            let nodes = simulation.shape().mesh.vertices().len();
            let note = format!("tip deflection {:.4} of {:.4e} m; {nodes} nodes", part, theory.norm());
            Ok(Finding::new(outcome, part, note))
        })
    }
}

//! Flat bodies: stiffness against time step, inverted triangles, pictures meshed coarsely and finely, momentum.

use fem_model::Integrator;
use nalgebra::Vector3;

use super::invariance::in_rigid_motion;
use super::recovery::MARGIN_IS;
use super::*;
use fem_reference::{Elements, LINEAR};

const FAMILY: &str = "flat bodies";

/// Adds the family.
pub fn add(cases: &mut Vec<Case>, quick: bool) {
    let stiffness: &[f64] = if quick { &[1e5] } else { &[1e2, 1e5, 1e8, 1e12] };
    let laws = ["corotated", "stable_neo_hookean", "neo_hookean"];
    for ((law, &young), dt) in pairs(pairs(laws, stiffness), [1e-5, 1e-2, 1.0]) {
        cases.push(sagging(law, young, dt, if quick { 5 } else { 40 }));
    }
    let without_barrier = ["corotated", "stable_neo_hookean"];
    let seeds = 0..if quick { 2 } else { 20 };
    cases.extend(pairs(without_barrier, seeds).map(|(law, seed)| scrambled(law, seed)));
    cases.extend(without_barrier.map(|law| meshed_anew(law, if quick { 10 } else { 50 })));
    cases.extend(dynamic().map(|integrator| rigid(integrator, if quick { 100 } else { 1000 })));
}

/// A rectangle of 2 × 1 m in squares of 0.5 m.
fn rectangle(integrator: Integrator, model: &'static str) -> Setup {
    Setup { grid: Grid::Flat([2.0, 1.0], 2), ..Setup::small(integrator, model) }
}

/// A clamped rectangle under a weight that bends it as far at every stiffness.
fn sagging(model: &'static str, young: f64, dt: f64, steps: usize) -> Case {
    let weight = gravity([0.0, -0.02 * young / 1e3, 0.0]);
    let setup = Setup { young, dt, ..rectangle(Integrator::ImplicitEuler, model) }.with(clamp).with(weight);
    let parameters = format!("E = {young:e} Pa, dt = {dt:e} s, {steps} steps");
    setup.surviving(FAMILY, "sags under its weight", parameters, steps)
}

/// Cells per metre and order of the triangles of a rectangle that is meshed anew while it runs.
const MESHES: [(usize, usize); 5] = [(2, 1), (8, 1), (1, 1), (4, 2), (2, 2)];

/// A clamped rectangle that sags, meshed coarsely and finely in turn, each time from rest, as the window does it.
fn meshed_anew(model: &'static str, steps: usize) -> Case {
    let setup = rectangle(Integrator::ImplicitEuler, model).with(clamp).with(gravity([0.0, -2.0, 0.0]));
    let parameters = format!("{MESHES:?} cells per metre and order, {steps} steps each");
    setup.case(FAMILY, "meshed anew", parameters, move |setup, deadline| {
        let mut least: Option<Finding> = None;
        for (cells, order) in MESHES {
            let (grid, elements) = (Grid::Flat([2.0, 1.0], cells), Elements { order, ..LINEAR });
            let anew = Setup { grid, elements, ..setup.clone() };
            let found = march(&mut anew.build()?, steps, deadline).survival();
            if found.outcome != Outcome::Survives {
                return Err(found);
            }
            least = Some(least.filter(|least| least.margin <= found.margin).unwrap_or(found));
        }
        least.ok_or_else(|| Finding::plain(Outcome::Deviates, "no mesh".to_owned()))
    })
}

/// Steps within which a scrambled body must reach an equilibrium.
const STEPS: usize = 600;

/// A clamped rectangle whose nodes start at random places of the plane.
fn scrambled(model: &'static str, seed: u64) -> Case {
    let setup = Setup { dt: 0.05, ..rectangle(Integrator::ImplicitEuler, model) }.with(clamp).with(damp);
    let parameters = format!("E = 1e5 Pa, dt = {} s, up to {STEPS} steps", setup.dt);
    let case = setup.case(FAMILY, "random positions in the plane", parameters, move |setup, deadline| {
        let (mut simulation, mut random) = (setup.build()?, Random::new(seed));
        place_moving(&mut simulation, |X| {
            let mut place = Vector3::new(1.0, 0.5, 0.0) + random.vector().component_mul(&Vector3::new(1.0, 0.5, 0.0));
            if X.x == 0.0 {
                place = *X;
            }
            (place, Vector3::zeros())
        });
        Ok(super::recovery::back_at_rest(&mut simulation, STEPS, true, deadline))
    });
    Case { expected: Outcome::Untangles, margin_is: MARGIN_IS, seed: Some(seed), ..case }
}

/// A free rectangle in rigid motion without loads, which conserves its momentum and stays in its plane.
fn rigid(integrator: Integrator, steps: usize) -> Case {
    let setup = Setup { dt: 1e-3, ..rectangle(integrator, "corotated") };
    let parameters = format!("dt = 1e-3 s, {steps} steps");
    in_rigid_motion(setup, FAMILY, parameters, steps)
}

//! Flat bodies: stiffness against time step, inverted triangles, pictures meshed coarsely and finely, momentum.

use fem_model::Integrator;
use nalgebra::Vector3;

use super::invariance::in_rigid_motion;
use super::recovery::MARGIN_IS;
use crate::stability::case::{Case, Finding, Outcome};
use crate::stability::initial_state::{Random, place_moving};
use crate::stability::march::march;
use crate::stability::scene_text::{CLAMPED, DAMPED, SceneText, dynamic, gravity};

const FAMILY: &str = "flat bodies";

/// Adds the family.
pub fn add(cases: &mut Vec<Case>, quick: bool) {
    let stiffness: &[f64] = if quick { &[1e5] } else { &[1e2, 1e5, 1e8, 1e12] };
    for model in ["corotated", "stable_neo_hookean", "neo_hookean"] {
        for &young in stiffness {
            for dt in [1e-5, 1e-2, 1.0] {
                cases.push(sagging(model, young, dt, if quick { 5 } else { 40 }));
            }
        }
    }
    for (model, expected) in [("corotated", Outcome::Untangles), ("stable_neo_hookean", Outcome::Untangles)] {
        for seed in 0..if quick { 2 } else { 20 } {
            cases.push(scrambled(model, expected, seed));
        }
    }
    for model in ["corotated", "stable_neo_hookean"] {
        cases.push(meshed_anew(model, if quick { 10 } else { 50 }));
    }
    for integrator in dynamic() {
        cases.push(rigid(integrator, if quick { 100 } else { 1000 }));
    }
}

/// A rectangle of 2 × 1 m in squares of 0.5 m.
fn rectangle(integrator: Integrator, model: &'static str) -> SceneText {
    let mesh = "rectangle = { size = [2, 1], pattern = \"kuhn\", cells_per_unit = 2 }".to_owned();
    SceneText { mesh, ..SceneText::small(integrator, model) }
}

/// A clamped rectangle under a weight that bends it as far at every stiffness.
fn sagging(model: &'static str, young: f64, dt: f64, steps: usize) -> Case {
    let weight = gravity([0.0, -0.02 * young / 1e3, 0.0]);
    let text = SceneText { young, dt, ..rectangle(Integrator::ImplicitEuler, model) }.with(CLAMPED).with(&weight);
    let parameters = format!("E = {young:e} Pa, dt = {dt:e} s, {steps} steps");
    text.surviving(FAMILY, "sags under its weight", parameters, steps)
}

/// Cells per metre and order of the triangles of a rectangle that is meshed anew while it runs.
const MESHES: [(usize, usize); 5] = [(2, 1), (8, 1), (1, 1), (4, 2), (2, 2)];

/// A clamped rectangle that sags, meshed coarsely and finely in turn, each time from rest, as the window does it.
fn meshed_anew(model: &'static str, steps: usize) -> Case {
    let text = rectangle(Integrator::ImplicitEuler, model).with(CLAMPED).with(&gravity([0.0, -2.0, 0.0]));
    let parameters = format!("{MESHES:?} cells per metre and order, {steps} steps each");
    text.clone().case(FAMILY, "meshed anew", parameters, move |deadline| {
        let mut least: Option<Finding> = None;
        for (cells, order) in MESHES {
            let mesh = format!(
                "rectangle = {{ size = [2, 1], pattern = \"kuhn\", cells_per_unit = {cells} }}\norder = {order}"
            );
            let found = march(&mut SceneText { mesh, ..text.clone() }.build()?, steps, deadline).survival();
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
fn scrambled(model: &'static str, expected: Outcome, seed: u64) -> Case {
    let text = SceneText { dt: 0.05, ..rectangle(Integrator::ImplicitEuler, model) }.with(CLAMPED).with(DAMPED);
    let parameters = format!("E = 1e5 Pa, dt = {} s, up to {STEPS} steps", text.dt);
    let case = text.clone().case(FAMILY, "random positions in the plane", parameters, move |deadline| {
        let (mut simulation, mut random) = (text.build()?, Random::new(seed));
        place_moving(&mut simulation, |X| {
            let mut place = Vector3::new(1.0, 0.5, 0.0) + random.vector().component_mul(&Vector3::new(1.0, 0.5, 0.0));
            if X.x == 0.0 {
                place = *X;
            }
            (place, Vector3::zeros())
        });
        Ok(super::recovery::back_at_rest(&mut simulation, STEPS, true, deadline))
    });
    Case { expected, margin_is: MARGIN_IS, seed: Some(seed), ..case }
}

/// A free rectangle in rigid motion without loads, which conserves its momentum and stays in its plane.
fn rigid(integrator: Integrator, steps: usize) -> Case {
    let text = SceneText { dt: 1e-3, ..rectangle(integrator, "corotated") };
    let parameters = format!("dt = 1e-3 s, {steps} steps");
    in_rigid_motion(text, FAMILY, parameters, steps)
}

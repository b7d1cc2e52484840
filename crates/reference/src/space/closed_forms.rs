//! Equilibria in closed form.

use std::path::Path;

use crate::space::norms;
use fem_engine::cantilever::{expected_tip_displacement, tip_displacement};
use fem_mesh::Side;
use fem_model::simulation::Simulation;
use fem_model::{Axis, Integrator, Law};
use fem_scene::tables::{On, PrescribedTable};
use fem_scene::{Scene, body_of_shape};

/// Relative distance of a simulation from the scene's closed form; `None` for a scene without one.
///
/// Cantilever: relative error of the tip displacement against Timoshenko's beam theory. Stretched bar: root mean square over the nodes
/// against the uniform state, relative to the body's length.
pub fn error(scene: &Scene, simulation: &dyn Simulation) -> Option<f64> {
    let body = body_of_shape(scene, (*simulation.shape()).clone(), Path::new("")).ok()?;
    if let Some(expected) = expected_tip_displacement(&body, &scene.method()) {
        return Some((tip_displacement(simulation) - expected).norm() / expected.norm());
    }
    let (stretch, lateral) = uniaxial(scene)?;
    let (shape, q) = (simulation.shape(), simulation.positions());
    let mesh = &shape.mesh;
    let origin = mesh.vertices().iter().fold(mesh.vertices()[0], |least, x| least.inf(x));
    let factors = [stretch, lateral, lateral];
    let exact: Vec<f64> = (0..q.len()).map(|i| (mesh.vertices()[i / 3] - origin)[i % 3] * factors[i % 3]).collect();
    let found: Vec<f64> = (0..q.len()).map(|i| q[i] - origin[i % 3]).collect();
    Some(norms::l2(&norms::weights(mesh), &found, &exact) / norms::length(mesh))
}

/// Stretches along and across x of a neo-Hookean box on three symmetry planes under a dead traction along x.
pub fn uniaxial(scene: &Scene) -> Option<(f64, f64)> {
    let is_uniform = scene.materials.is_empty();
    let is_static = scene.time.integrator == Integrator::Static;
    let is_without_weight = scene.gravity.is_none() && scene.body_force.is_none();
    let is_alone = is_without_weight
        && scene.fields().tables().next().is_none()
        && scene.force.is_empty()
        && scene.springs.is_empty()
        && scene.drag.is_none();
    let [traction] = &scene.traction[..] else { return None };
    let on = traction.on.as_ref().and_then(On::side).filter(|on| on.axis == Axis::X && on.side == Side::Max)?;
    let [load, 0.0, 0.0] = traction.force_per_area? else { return None };
    let rollers = [Axis::X, Axis::Y, Axis::Z]
        .iter()
        .all(|&axis| scene.prescribed.iter().any(|condition| is_roller(condition, axis)));
    let is_bar =
        scene.mesh.cuboid.is_some() && scene.prescribed.len() == 3 && scene.fixed.is_none() && on.within >= 0.0;
    let Law::NeoHookean(law) = scene.material.value().law else { return None };
    if !(is_uniform && is_static && is_alone && rollers && is_bar) {
        return None;
    }
    let [C, D] = law.moduli();
    stretches(C, D, load)
}

/// A symmetry plane: the face of the smallest coordinate keeps that coordinate.
fn is_roller(condition: &PrescribedTable, axis: Axis) -> bool {
    let on_side = condition.on.as_ref().and_then(On::side).is_some_and(|on| on.axis == axis && on.side == Side::Min);
    let stays = condition.rotation.is_none() && condition.displacement == Some([0.0; 3]);
    on_side && stays && condition.components.as_deref() == Some(&[axis])
}

/// λ and a of P11(λ, a) = traction where (2C/3) J^(−2/3) (a² − λ²) + 2D (J − 1) J = 0, J = λ a²: bisection over λ, and over a in it.
fn stretches(C: f64, D: f64, traction: f64) -> Option<(f64, f64)> {
    let lateral = |stretch: f64| {
        bisect(1e-3, 10.0, |a| {
            let J = stretch * a * a;
            2.0 * C / 3.0 * J.powf(-2.0 / 3.0) * (a * a - stretch * stretch) + 2.0 * D * (J - 1.0) * J
        })
    };
    let stress = |stretch: f64| {
        let a = lateral(stretch)?;
        Some(2.0 * C / stretch * (stretch * a * a).powf(-2.0 / 3.0) * (stretch * stretch - a * a))
    };
    let stretch = bisect(0.05, 20.0, |stretch| stress(stretch).map_or(f64::NAN, |stress| stress - traction))?;
    Some((stretch, lateral(stretch)?))
}

/// A zero of a function that is negative at `low` and positive at `high`.
fn bisect(mut low: f64, mut high: f64, f: impl Fn(f64) -> f64) -> Option<f64> {
    // NaN fails both comparisons.
    if !(f(low) < 0.0 && f(high) > 0.0) {
        return None;
    }
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if f(middle) < 0.0 { low = middle } else { high = middle }
    }
    Some(0.5 * (low + high))
}

//! The last digits of a free body's momentum.

use crate::newton::incremental_potential::IncrementalPotential;
use crate::number::Real;

/// Puts the mean of a step right where nothing holds or pulls the body.
///
/// Forces inside a body add up to zero, so the step's sum over all nodes, M-weighted, is what inertia, loads and the damping of
/// the mass alone make it. In the matrix of a small stiff body M is far below dt² K, and a solution loses that. `w` is the step
/// of `dt` seconds, m.
pub fn restore<T: Real>(objective: &IncrementalPotential<T>, dt: f64, w: &mut [[T; 3]]) {
    let IncrementalPotential { system, acting, motion: Some(motion), .. } = objective else { return };
    if !system.is_unheld() || !acting.pulls.is_empty() {
        return;
    }
    let load = acting.total_load();
    let damped = 1.0 + dt * system.damping.as_ref().map_or(0.0, |damping| damping.alpha);
    for i in 0..3 {
        let difference = |node: usize| motion.inertial[node][i].as_f64() - damped * w[node][i].as_f64();
        let missing: f64 =
            system.node_masses.iter().enumerate().map(|(node, mass)| mass.as_f64() * difference(node)).sum();
        let mean = T::of((missing + dt * dt * load[i]) / (damped * system.total_mass));
        for node in &mut *w {
            node[i] += mean;
        }
    }
}

//! The last digits of a free body's momentum.

use crate::newton::incremental_potential::IncrementalPotential;
use fem_elements::vector::triple;
use fem_solvers::Real;

/// Corrects the mean of an increment where the body is unconstrained and the sum of its external forces is known.
///
/// Internal forces add up to zero, so the M-weighted sum of the increment over all nodes follows from inertia, loads and mass damping
/// alone. In the matrix of a small stiff body M is far below τ² K, and a solution loses that sum. `w` is the increment, m, with this τ,
/// s, and this c τ.
pub fn restore<T: Real>(potential: &IncrementalPotential<T>, tau: f64, velocity: f64, w: &mut [[T; 3]]) {
    let IncrementalPotential { system, increment, followers } = potential;
    let Some(inertia) = increment.inertia else { return };
    if !system.is_unconstrained() {
        return;
    }
    let mut forces = system.forces.active();
    let add = |sum: [f64; 3], force: [f64; 3]| triple(|i| sum[i] + force[i]);
    let resultant = forces.try_fold([0.0; 3], |sum, (force, _)| Some(add(sum, force.resultant(increment.end)?)));
    let Some(resultant) = resultant else { return };
    let drag = tau * velocity * system.damping.as_ref().map_or(0.0, |damping| damping.alpha);
    let damped = 1.0 + drag;
    for i in (0..3).filter(|&i| !system.dirichlet.is_constrained_everywhere(i)) {
        let follower_load: f64 = followers.iter().map(|gradient| -gradient[i].as_f64()).sum();
        let load = follower_load + resultant[i];
        let still = |node: usize| inertia.still.map_or(0.0, |still| drag * still[node][i].as_f64());
        let difference = |node: usize| inertia.inertial[node][i].as_f64() - damped * w[node][i].as_f64() + still(node);
        let missing: f64 =
            system.node_masses.iter().enumerate().map(|(node, mass)| mass.as_f64() * difference(node)).sum();
        let mean = T::of((missing + tau * tau * load) / (damped * system.total_mass));
        for node in &mut *w {
            node[i] += mean;
        }
    }
}

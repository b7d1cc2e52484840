//! The change of velocity in the last step, m/s: the initial guess of the next step assumes the same one.

use crate::model::state::State;
use fem_elements::vector::triple;
use fem_solvers::Real;

/// The increment, m, if velocities change as in the last step; `inertial` is that without a change.
pub fn extrapolate<T: Real>(step: &mut [[T; 3]], inertial: &[[T; 3]], last_change: &[[T; 3]], dt: f64) {
    let dt = T::of(dt);
    for ((step, inertial), change) in step.iter_mut().zip(inertial).zip(last_change) {
        *step = triple(|i| inertial[i] + dt * change[i]);
    }
}

/// Adds the increment of a step of `dt` seconds to the state, and keeps the change of velocity.
pub fn finish<T: Real>(step: &[[T; 3]], dt: f64, state: &mut State<T>, last_change: &mut [[T; 3]]) {
    let over_dt = T::of(1.0 / dt);
    for node in 0..step.len() {
        for i in 0..3 {
            let v = step[node][i] * over_dt;
            last_change[node][i] = v - state.v[node][i];
            state.v[node][i] = v;
            state.u[node][i] += step[node][i];
        }
    }
}

use nalgebra::DVector;
use nalgebra_sparse::CsrMatrix;

use crate::given::add_scaled;
use crate::newtons_method;

const MAX_NEWTON_STEPS: usize = 5;

/// One step of implicit Euler: the velocity at the end of the step minimises `energy`, which Newton's method finds.
#[allow(clippy::too_many_arguments)] // the course's signature
pub fn implicit_euler(
    q: &mut DVector<f64>,
    qdot: &mut DVector<f64>,
    dt: f64,
    mass: &CsrMatrix<f64>,
    energy: impl Fn(&DVector<f64>) -> f64,
    force: impl Fn(&DVector<f64>, &DVector<f64>) -> DVector<f64>,
    stiffness: impl Fn(&DVector<f64>, &DVector<f64>) -> CsrMatrix<f64>,
    solve: impl Fn(&CsrMatrix<f64>, &DVector<f64>) -> DVector<f64>,
) {
    let g = |v: &DVector<f64>| mass * (v - &*qdot) - force(&(&*q + v * dt), v) * dt;
    let H = |v: &DVector<f64>| add_scaled(mass, -dt * dt, &stiffness(&(&*q + v * dt), v));

    // If the old velocity would invert an element, zero velocity, which keeps the old positions, is a feasible initial guess.
    let mut v = qdot.clone();
    if !energy(&v).is_finite() {
        v.fill(0.0);
    }
    newtons_method(&mut v, energy, g, H, solve, MAX_NEWTON_STEPS);

    q.axpy(dt, &v, 1.0);
    *qdot = v;
}

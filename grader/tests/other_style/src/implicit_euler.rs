use nalgebra::DVector;
use nalgebra_sparse::CsrMatrix;

use crate::newtons_method;

/// Implicit Euler: Newton's method on the velocity at the end of the step.
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
    let before = qdot.clone();
    let end = |v: &DVector<f64>| -> DVector<f64> { &*q + dt * v };
    // Where the old velocity leads to a state that cannot be, the body starts where it is.
    if energy(qdot).is_infinite() {
        qdot.fill(0.0);
    }
    newtons_method(
        qdot,
        &energy,
        |v| mass * v - mass * &before - dt * force(&end(v), v),
        |v| mass - stiffness(&end(v), v) * dt.powi(2),
        &solve,
        5,
    );
    *q = end(qdot);
}

use nalgebra::DVector;
use nalgebra_sparse::CsrMatrix;

use crate::given::add_scaled;

/// One step of linearly implicit Euler: force and stiffness at the old state, one linear solve.
pub fn linearly_implicit_euler(
    q: &mut DVector<f64>,
    qdot: &mut DVector<f64>,
    dt: f64,
    mass: &CsrMatrix<f64>,
    force: impl Fn(&DVector<f64>, &DVector<f64>) -> DVector<f64>,
    stiffness: impl Fn(&DVector<f64>, &DVector<f64>) -> CsrMatrix<f64>,
    solve: impl Fn(&CsrMatrix<f64>, &DVector<f64>) -> DVector<f64>,
) {
    let A = add_scaled(mass, -dt * dt, &stiffness(q, qdot));
    let b = mass * &*qdot + force(q, qdot) * dt;
    *qdot = solve(&A, &b);
    q.axpy(dt, qdot, 1.0);
}

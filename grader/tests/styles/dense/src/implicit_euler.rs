use nalgebra::{DMatrix, DVector};
use nalgebra_sparse::CsrMatrix;

/// With full matrices.
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
    let (old_q, old_v) = (q.clone(), qdot.clone());
    let M = DMatrix::from(mass);
    let gradient = |v: &DVector<f64>| &M * (v - &old_v) - force(&(&old_q + v * dt), v) * dt;
    let hessian = |v: &DVector<f64>| {
        let K = DMatrix::from(&stiffness(&(&old_q + v * dt), v));
        CsrMatrix::from(&(&M - K * (dt * dt)))
    };
    crate::newtons_method(qdot, energy, gradient, hessian, solve, 5);
    *q += &*qdot * dt;
}

use nalgebra::DVector;
use nalgebra_sparse::CsrMatrix;

/// The gradient and the Hessian of the page, handed on.
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
    let at = |v: &DVector<f64>| &old_q + v * dt;
    let g = |v: &DVector<f64>| mass * (v - &old_v) - force(&at(v), v) * dt;
    let H = |v: &DVector<f64>| mass - &(stiffness(&at(v), v) * dt.powi(2));
    crate::newtons_method(qdot, energy, g, H, solve, 5);
    *q = at(qdot);
}

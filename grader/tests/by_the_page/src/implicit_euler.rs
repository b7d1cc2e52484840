use nalgebra::DVector;
use nalgebra_sparse::CsrMatrix;

/// Five steps of Newton's method for the velocity at the end.
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
    let gradient = |v: &DVector<f64>| mass * (v - &*qdot) - force(&(&*q + v * dt), v) * dt;
    let hessian = |v: &DVector<f64>| mass - stiffness(&(&*q + v * dt), v) * (dt * dt);
    let mut v = qdot.clone();
    crate::newtons_method(&mut v, energy, gradient, hessian, solve, 5);
    *q += &v * dt;
    *qdot = v;
}

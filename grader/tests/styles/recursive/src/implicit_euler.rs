use nalgebra::DVector;
use nalgebra_sparse::CsrMatrix;

/// The energy's gradient and Hessian as closures.
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
    let (x, v) = (q.clone(), qdot.clone());
    crate::newtons_method(
        qdot,
        &energy,
        |new| mass * (new - &v) - dt * force(&(&x + dt * new), new),
        |new| mass - stiffness(&(&x + dt * new), new) * (dt * dt),
        &solve,
        5,
    );
    q.axpy(dt, qdot, 1.0);
}

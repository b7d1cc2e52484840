use nalgebra::DVector;
use nalgebra_sparse::CsrMatrix;

/// The system of the page.
pub fn linearly_implicit_euler(
    q: &mut DVector<f64>,
    qdot: &mut DVector<f64>,
    dt: f64,
    mass: &CsrMatrix<f64>,
    force: impl Fn(&DVector<f64>, &DVector<f64>) -> DVector<f64>,
    stiffness: impl Fn(&DVector<f64>, &DVector<f64>) -> CsrMatrix<f64>,
    solve: impl Fn(&CsrMatrix<f64>, &DVector<f64>) -> DVector<f64>,
) {
    let (f, K) = (force(&*q, &*qdot), stiffness(&*q, &*qdot));
    let system = mass + K * (-dt * dt);
    let right = mass * &*qdot + f * dt;
    qdot.copy_from(&solve(&system, &right));
    q.axpy(dt, &*qdot, 1.0);
}

use nalgebra::DVector;
use nalgebra_sparse::CsrMatrix;

/// Solved for the change of the velocity.
pub fn linearly_implicit_euler(
    q: &mut DVector<f64>,
    qdot: &mut DVector<f64>,
    dt: f64,
    mass: &CsrMatrix<f64>,
    force: impl Fn(&DVector<f64>, &DVector<f64>) -> DVector<f64>,
    stiffness: impl Fn(&DVector<f64>, &DVector<f64>) -> CsrMatrix<f64>,
    solve: impl Fn(&CsrMatrix<f64>, &DVector<f64>) -> DVector<f64>,
) {
    let K = stiffness(q, qdot);
    let impulse = (force(q, qdot) + &K * &*qdot * dt) * dt;
    let gained = solve(&(mass - K * (dt * dt)), &impulse);
    *qdot += gained;
    *q += dt * &*qdot;
}

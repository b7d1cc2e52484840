use nalgebra::DVector;
use nalgebra_sparse::CsrMatrix;

/// The system of the page in three lines.
pub fn linearly_implicit_euler(
    q: &mut DVector<f64>,
    qdot: &mut DVector<f64>,
    dt: f64,
    mass: &CsrMatrix<f64>,
    force: impl Fn(&DVector<f64>, &DVector<f64>) -> DVector<f64>,
    stiffness: impl Fn(&DVector<f64>, &DVector<f64>) -> CsrMatrix<f64>,
    solve: impl Fn(&CsrMatrix<f64>, &DVector<f64>) -> DVector<f64>,
) {
    let A = mass - &(stiffness(q, qdot) * (dt * dt));
    let b = mass * &*qdot + force(q, qdot) * dt;
    *qdot = solve(&A, &b);
    q.iter_mut().zip(qdot.iter()).for_each(|(position, velocity)| *position += dt * velocity);
}

use nalgebra::{DMatrix, DVector};
use nalgebra_sparse::CsrMatrix;

/// With full matrices, for the change of the velocity.
pub fn linearly_implicit_euler(
    q: &mut DVector<f64>,
    qdot: &mut DVector<f64>,
    dt: f64,
    mass: &CsrMatrix<f64>,
    force: impl Fn(&DVector<f64>, &DVector<f64>) -> DVector<f64>,
    stiffness: impl Fn(&DVector<f64>, &DVector<f64>) -> CsrMatrix<f64>,
    solve: impl Fn(&CsrMatrix<f64>, &DVector<f64>) -> DVector<f64>,
) {
    let K = DMatrix::from(&stiffness(q, qdot));
    let A = DMatrix::from(mass) - &K * (dt * dt);
    let gained = solve(&CsrMatrix::from(&A), &((force(q, qdot) + K * &*qdot * dt) * dt));
    *qdot += gained;
    *q += &*qdot * dt;
}

use nalgebra::DVector;
use nalgebra_sparse::CsrMatrix;

/// (M − Δt² K) v⁺ = M v + Δt f, then the positions.
pub fn linearly_implicit_euler(
    q: &mut DVector<f64>,
    qdot: &mut DVector<f64>,
    dt: f64,
    mass: &CsrMatrix<f64>,
    force: impl Fn(&DVector<f64>, &DVector<f64>) -> DVector<f64>,
    stiffness: impl Fn(&DVector<f64>, &DVector<f64>) -> CsrMatrix<f64>,
    solve: impl Fn(&CsrMatrix<f64>, &DVector<f64>) -> DVector<f64>,
) {
    let f = force(q, qdot);
    let K = stiffness(q, qdot);
    let A = mass - K * (dt * dt);
    let b = mass * &*qdot + f * dt;
    *qdot = solve(&A, &b);
    *q += &*qdot * dt;
}

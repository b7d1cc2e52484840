use nalgebra::DVector;
use nalgebra_sparse::CsrMatrix;

/// One step of linearly implicit Euler, by momenta.
pub fn linearly_implicit_euler(
    q: &mut DVector<f64>,
    qdot: &mut DVector<f64>,
    dt: f64,
    mass: &CsrMatrix<f64>,
    force: impl Fn(&DVector<f64>, &DVector<f64>) -> DVector<f64>,
    stiffness: impl Fn(&DVector<f64>, &DVector<f64>) -> CsrMatrix<f64>,
    solve: impl Fn(&CsrMatrix<f64>, &DVector<f64>) -> DVector<f64>,
) {
    let impulse = dt * force(q, qdot);
    let system = mass - stiffness(q, qdot) * dt.powi(2);
    let momentum = mass * &*qdot;
    qdot.copy_from(&solve(&system, &(impulse + momentum)));
    *q += &*qdot * dt;
}

use nalgebra::DVector;
use nalgebra_sparse::{CooMatrix, CsrMatrix};

/// The triplets of both matrices, K before M; q moved by the step and v replaced.
pub fn linearly_implicit_euler(
    q: &mut DVector<f64>,
    qdot: &mut DVector<f64>,
    dt: f64,
    mass: &CsrMatrix<f64>,
    force: impl Fn(&DVector<f64>, &DVector<f64>) -> DVector<f64>,
    stiffness: impl Fn(&DVector<f64>, &DVector<f64>) -> CsrMatrix<f64>,
    solve: impl Fn(&CsrMatrix<f64>, &DVector<f64>) -> DVector<f64>,
) {
    let (K, f) = (stiffness(q, qdot), force(q, qdot));
    let mut A = CooMatrix::new(q.len(), q.len());
    K.triplet_iter().for_each(|(row, column, value)| A.push(row, column, value * -(dt * dt)));
    mass.triplet_iter().for_each(|(row, column, value)| A.push(row, column, *value));
    let momentum: DVector<f64> = mass * &*qdot;
    let v = solve(&CsrMatrix::from(&A), &(momentum + dt * f));
    let step = &v * dt;
    *q = &*q + step;
    *qdot = v;
}

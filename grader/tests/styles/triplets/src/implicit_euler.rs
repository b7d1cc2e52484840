use nalgebra::DVector;
use nalgebra_sparse::{CooMatrix, CsrMatrix};

/// Triplets of M and of K in one list for each Hessian.
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
    let (start_q, start_v) = (q.clone(), qdot.clone());
    let moved = |v: &DVector<f64>| &start_q + dt * v;
    let gradient = |v: &DVector<f64>| mass * v - mass * &start_v - dt * force(&moved(v), v);
    let hessian = |v: &DVector<f64>| {
        let mut H = CooMatrix::new(v.len(), v.len());
        mass.triplet_iter().for_each(|(row, column, value)| H.push(row, column, *value));
        let K = stiffness(&moved(v), v);
        K.triplet_iter().for_each(|(row, column, value)| H.push(row, column, -dt * value * dt));
        CsrMatrix::from(&H)
    };
    let mut v = start_v.clone();
    crate::newtons_method(&mut v, energy, gradient, hessian, solve, 5);
    q.copy_from(&moved(&v));
    qdot.copy_from(&v);
}

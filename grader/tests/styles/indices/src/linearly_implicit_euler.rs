use nalgebra::DVector;
use nalgebra_sparse::{CooMatrix, CsrMatrix};

/// Both matrices as triplets of one list.
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
    let n = q.len();
    let mut A = CooMatrix::new(n, n);
    for (i, j, value) in mass.triplet_iter() {
        A.push(i, j, *value);
    }
    for (i, j, value) in K.triplet_iter() {
        A.push(i, j, -dt * dt * value);
    }
    let mut b = DVector::zeros(n);
    for (i, j, value) in mass.triplet_iter() {
        b[i] += value * qdot[j];
    }
    for i in 0..n {
        b[i] += dt * f[i];
    }
    let v = solve(&CsrMatrix::from(&A), &b);
    for i in 0..n {
        qdot[i] = v[i];
        q[i] += dt * v[i];
    }
}

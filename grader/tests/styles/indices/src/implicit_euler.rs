use nalgebra::DVector;
use nalgebra_sparse::{CooMatrix, CsrMatrix};

/// Newton's method for the velocity at the end of the step.
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
    let n = q.len();
    let (q_old, v_old) = (q.clone(), qdot.clone());
    let position = |v: &DVector<f64>| {
        let mut at = q_old.clone();
        for i in 0..n {
            at[i] += dt * v[i];
        }
        at
    };
    let gradient = |v: &DVector<f64>| {
        let f = force(&position(v), v);
        let mut g = DVector::zeros(n);
        for (i, j, m) in mass.triplet_iter() {
            g[i] += m * (v[j] - v_old[j]);
        }
        for i in 0..n {
            g[i] -= dt * f[i];
        }
        g
    };
    let hessian = |v: &DVector<f64>| {
        let mut H = CooMatrix::new(n, n);
        for (i, j, m) in mass.triplet_iter() {
            H.push(i, j, *m);
        }
        for (i, j, k) in stiffness(&position(v), v).triplet_iter() {
            H.push(i, j, -(dt * dt) * k);
        }
        CsrMatrix::from(&H)
    };
    crate::newtons_method(qdot, &energy, &gradient, &hessian, &solve, 5);
    for i in 0..n {
        q[i] += dt * qdot[i];
    }
}

use nalgebra::DVector;
use nalgebra_sparse::CsrMatrix;

/// Newton's method written out, with the positions in place of a function of the velocity.
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
    let (old_q, old_v) = (q.clone(), qdot.clone());
    let gradient = |v: &DVector<f64>| mass * (v - &old_v) - force(&(&old_q + v * dt), v) * dt;
    let mut v = old_v.clone();
    let mut g = gradient(&v);
    let small = g.norm() * 1e-10;
    let mut value = energy(&v);
    for _ in 0..5 {
        if g.norm() <= small {
            break;
        }
        let K = stiffness(&(&old_q + &v * dt), &v);
        let d = -solve(&(mass - K * (dt * dt)), &g);
        let mut alpha = 1.0;
        let step = loop {
            if alpha < 1e-8 {
                break None;
            }
            let trial = &v + &d * alpha;
            let energy = energy(&trial);
            if energy.is_finite() && energy <= value + 1e-8 * alpha * d.dot(&g) {
                break Some((trial, energy));
            }
            alpha /= 2.0;
        };
        let Some((next, energy)) = step else { break };
        (v, value) = (next, energy);
        g = gradient(&v);
    }
    *q = old_q + &v * dt;
    *qdot = v;
}

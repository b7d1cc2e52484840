use nalgebra::DVector;
use nalgebra_sparse::CsrMatrix;

/// Solves against the gradient itself and goes the other way; x0 is moved, and moved back where that was no good.
pub fn newtons_method(
    x0: &mut DVector<f64>,
    f: impl Fn(&DVector<f64>) -> f64,
    g: impl Fn(&DVector<f64>) -> DVector<f64>,
    H: impl Fn(&DVector<f64>) -> CsrMatrix<f64>,
    solve: impl Fn(&CsrMatrix<f64>, &DVector<f64>) -> DVector<f64>,
    max_steps: usize,
) -> f64 {
    let start = g(x0).norm();
    let mut steps = 0;
    while steps < max_steps && g(x0).norm() > 1e-10 * start {
        steps += 1;
        let before = f(x0);
        let gradient = g(x0);
        let d = -solve(&H(x0), &gradient);
        let slope = gradient.dot(&d);
        let mut alpha = 1.0;
        loop {
            let trial = &*x0 + &d * alpha;
            if f(&trial).is_finite() && f(&trial) <= before + 1e-8 * alpha * slope {
                *x0 = trial;
                break;
            }
            // The step length has fallen below the bound and still fails.
            if alpha < 1e-8 {
                return f(x0);
            }
            alpha /= 2.0;
        }
    }
    f(x0)
}

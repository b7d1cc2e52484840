use nalgebra::DVector;
use nalgebra_sparse::CsrMatrix;

/// Newton's method with the line search inside its loop.
pub fn newtons_method(
    x0: &mut DVector<f64>,
    f: impl Fn(&DVector<f64>) -> f64,
    g: impl Fn(&DVector<f64>) -> DVector<f64>,
    H: impl Fn(&DVector<f64>) -> CsrMatrix<f64>,
    solve: impl Fn(&CsrMatrix<f64>, &DVector<f64>) -> DVector<f64>,
    max_steps: usize,
) -> f64 {
    let mut value = f(x0);
    let mut gradient = g(x0);
    let enough = 1e-10 * gradient.norm();
    let mut steps = 0;
    'directions: while steps < max_steps && gradient.norm() > enough {
        steps += 1;
        let d = solve(&H(x0), &(-1.0 * &gradient));
        let slope = d.dot(&gradient);
        for halvings in 0.. {
            let alpha = 0.5_f64.powi(halvings);
            if alpha < 1e-8 {
                break 'directions;
            }
            let trial = &*x0 + alpha * &d;
            let after = f(&trial);
            if after.is_finite() && after <= value + 1e-8 * alpha * slope {
                (*x0, value) = (trial, after);
                break;
            }
        }
        gradient = g(x0);
    }
    value
}

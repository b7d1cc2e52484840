use nalgebra::DVector;
use nalgebra_sparse::CsrMatrix;

/// One direction, then the rest of the way by calling itself.
pub fn newtons_method(
    x0: &mut DVector<f64>,
    f: impl Fn(&DVector<f64>) -> f64,
    g: impl Fn(&DVector<f64>) -> DVector<f64>,
    H: impl Fn(&DVector<f64>) -> CsrMatrix<f64>,
    solve: impl Fn(&CsrMatrix<f64>, &DVector<f64>) -> DVector<f64>,
    max_steps: usize,
) -> f64 {
    let small = 1e-10 * g(x0).norm();
    further(x0, &f, &g, &H, &solve, max_steps, small)
}

fn further(
    x: &mut DVector<f64>,
    f: &impl Fn(&DVector<f64>) -> f64,
    g: &impl Fn(&DVector<f64>) -> DVector<f64>,
    H: &impl Fn(&DVector<f64>) -> CsrMatrix<f64>,
    solve: &impl Fn(&CsrMatrix<f64>, &DVector<f64>) -> DVector<f64>,
    left: usize,
    small: f64,
) -> f64 {
    let (value, gradient) = (f(x), g(x));
    if left == 0 || gradient.norm() <= small {
        return value;
    }
    let d = solve(&H(x), &-&gradient);
    match halved(x, value, gradient.dot(&d), &d, 1.0, f) {
        None => value,
        Some(alpha) => {
            x.axpy(alpha, &d, 1.0);
            further(x, f, g, H, solve, left - 1, small)
        }
    }
}

/// The first of α, α/2, α/4 … that is good enough.
fn halved(
    x: &DVector<f64>,
    value: f64,
    slope: f64,
    d: &DVector<f64>,
    alpha: f64,
    f: &impl Fn(&DVector<f64>) -> f64,
) -> Option<f64> {
    if alpha < 1e-8 {
        return None;
    }
    let after = f(&(x + d * alpha));
    let is_good = after.is_finite() && after <= value + 1e-8 * alpha * slope;
    if is_good { Some(alpha) } else { halved(x, value, slope, d, 0.5 * alpha, f) }
}

use nalgebra::DVector;
use nalgebra_sparse::CsrMatrix;

/// The page's loop.
pub fn newtons_method(
    x0: &mut DVector<f64>,
    f: impl Fn(&DVector<f64>) -> f64,
    g: impl Fn(&DVector<f64>) -> DVector<f64>,
    H: impl Fn(&DVector<f64>) -> CsrMatrix<f64>,
    solve: impl Fn(&CsrMatrix<f64>, &DVector<f64>) -> DVector<f64>,
    max_steps: usize,
) -> f64 {
    let at_start = g(x0).norm();
    for _ in 0..max_steps {
        let gradient = g(x0);
        if gradient.norm() <= 1e-10 * at_start {
            break;
        }
        let d = solve(&H(x0), &-&gradient);
        let slope = gradient.dot(&d);
        let value = f(x0);
        let mut alpha = 1.0;
        loop {
            let x = &*x0 + &d * alpha;
            let tried = f(&x);
            // Neither +∞ nor NaN is less than +∞.
            if tried < f64::INFINITY && tried <= value + 1e-8 * alpha * slope {
                *x0 = x;
                break;
            }
            alpha /= 2.0;
            if alpha < 1e-8 {
                return value;
            }
        }
    }
    f(x0)
}

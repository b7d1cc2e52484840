use nalgebra::DVector;
use nalgebra_sparse::CsrMatrix;

/// Asks for the Hessian before the gradient, looks at the gradient after each step, and once more at the end.
pub fn newtons_method(
    x0: &mut DVector<f64>,
    f: impl Fn(&DVector<f64>) -> f64,
    g: impl Fn(&DVector<f64>) -> DVector<f64>,
    H: impl Fn(&DVector<f64>) -> CsrMatrix<f64>,
    solve: impl Fn(&CsrMatrix<f64>, &DVector<f64>) -> DVector<f64>,
    max_steps: usize,
) -> f64 {
    let at_start = g(x0).norm();
    if at_start == 0.0 || max_steps == 0 {
        return f(x0);
    }
    let mut directions = 0;
    loop {
        let (H, gradient, value) = (H(x0), g(x0), f(x0));
        let d = -1.0 * solve(&H, &gradient);
        directions += 1;
        let mut alpha = 1.0;
        let next = loop {
            let x = &*x0 + alpha * &d;
            let promised = 1e-8 * alpha * gradient.dot(&d);
            if f(&x).is_finite() && f(&x) - value <= promised {
                break Some(x);
            }
            alpha *= 0.5;
            if alpha < 1e-8 {
                break None;
            }
        };
        match next {
            None => return value,
            Some(x) => *x0 = x,
        }
        if g(x0).norm() <= 1e-10 * at_start || directions == max_steps {
            return f(x0);
        }
    }
}

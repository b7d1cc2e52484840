use nalgebra::DVector;
use nalgebra_sparse::CsrMatrix;

/// A loop of directions around a loop of step lengths.
pub fn newtons_method(
    x0: &mut DVector<f64>,
    f: impl Fn(&DVector<f64>) -> f64,
    g: impl Fn(&DVector<f64>) -> DVector<f64>,
    H: impl Fn(&DVector<f64>) -> CsrMatrix<f64>,
    solve: impl Fn(&CsrMatrix<f64>, &DVector<f64>) -> DVector<f64>,
    max_steps: usize,
) -> f64 {
    let n = x0.len();
    let mut fx = f(x0);
    let mut gx = g(x0);
    let small = 1e-10 * gx.norm();
    for _ in 0..max_steps {
        if gx.norm() <= small {
            break;
        }
        let mut minus = DVector::zeros(n);
        for i in 0..n {
            minus[i] = -gx[i];
        }
        let d = solve(&H(x0), &minus);
        let mut slope = 0.0;
        for i in 0..n {
            slope += gx[i] * d[i];
        }
        let mut alpha = 1.0;
        let mut moved = false;
        while alpha >= 1e-8 {
            let mut trial = x0.clone();
            for i in 0..n {
                trial[i] += alpha * d[i];
            }
            let value = f(&trial);
            if value.is_finite() && value <= fx + 1e-8 * alpha * slope {
                x0.copy_from(&trial);
                fx = value;
                moved = true;
                break;
            }
            alpha *= 0.5;
        }
        if !moved {
            return fx;
        }
        gx = g(x0);
    }
    fx
}

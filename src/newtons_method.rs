use nalgebra::DVector;
use nalgebra_sparse::CsrMatrix;

const GRADIENT_TOLERANCE: f64 = 1e-10; // relative to the gradient at the start
const SUFFICIENT_DECREASE: f64 = 1e-8; // c
const BACKTRACKING: f64 = 0.5; // p
const SMALLEST_STEP: f64 = 1e-8;

/// Minimises f by Newton's method with a backtracking line search; returns f at the x0 that it leaves.
pub fn newtons_method(
    x0: &mut DVector<f64>,
    f: impl Fn(&DVector<f64>) -> f64,
    g: impl Fn(&DVector<f64>) -> DVector<f64>,
    H: impl Fn(&DVector<f64>) -> CsrMatrix<f64>,
    solve: impl Fn(&CsrMatrix<f64>, &DVector<f64>) -> DVector<f64>,
    max_steps: usize,
) -> f64 {
    let mut f_x = f(x0);
    let mut tolerance = None;
    for _ in 0..max_steps {
        let gradient = g(x0);
        let norm = gradient.norm();
        // A gradient whose norm overflows is not small, though ∞ ≤ ∞.
        if norm.is_finite() && norm <= *tolerance.get_or_insert(GRADIENT_TOLERANCE * norm) {
            break;
        }
        let direction = solve(&H(x0), &-&gradient);
        let Some((x, f_new)) = line_search(x0, f_x, &direction, gradient.dot(&direction), &f) else { break };
        *x0 = x;
        f_x = f_new;
    }
    f_x
}

/// The point after the first of the steps 1, ½, ¼ … that decreases f sufficiently, and f there; `None` if no step does.
fn line_search(
    x0: &DVector<f64>,
    f_x0: f64,
    direction: &DVector<f64>,
    directional_derivative: f64,
    f: impl Fn(&DVector<f64>) -> f64,
) -> Option<(DVector<f64>, f64)> {
    let mut alpha = 1.0;
    while alpha >= SMALLEST_STEP {
        let x = x0 + direction * alpha;
        let f_x = f(&x);
        // NaN fails the comparison; ∞ ≤ ∞ would pass it.
        if f_x.is_finite() && f_x <= f_x0 + SUFFICIENT_DECREASE * alpha * directional_derivative {
            return Some((x, f_x));
        }
        alpha *= BACKTRACKING;
    }
    None
}

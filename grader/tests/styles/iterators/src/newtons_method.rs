use nalgebra::DVector;
use nalgebra_sparse::CsrMatrix;

/// The step length is the first of a sequence that is good enough; f is evaluated wherever its value is needed.
pub fn newtons_method(
    x0: &mut DVector<f64>,
    f: impl Fn(&DVector<f64>) -> f64,
    g: impl Fn(&DVector<f64>) -> DVector<f64>,
    H: impl Fn(&DVector<f64>) -> CsrMatrix<f64>,
    solve: impl Fn(&CsrMatrix<f64>, &DVector<f64>) -> DVector<f64>,
    max_steps: usize,
) -> f64 {
    let small = 1e-10 * g(x0).norm();
    let _ =
        (0..max_steps).take_while(|_| g(x0).norm() > small && descend(x0, &f, &g(x0), &solve(&H(x0), &-g(x0)))).count();
    f(x0)
}

/// Goes along d as far as it is good; whether it goes at all.
fn descend(x: &mut DVector<f64>, f: &impl Fn(&DVector<f64>) -> f64, g: &DVector<f64>, d: &DVector<f64>) -> bool {
    let is_good = |alpha: &f64| {
        let trial = &*x + d * *alpha;
        f(&trial).is_finite() && f(&trial) <= f(x) + 1e-8 * alpha * g.dot(d)
    };
    let halvings = std::iter::successors(Some(1.0), |alpha| Some(alpha / 2.0)).take_while(|alpha| *alpha >= 1e-8);
    let found = { halvings }.find(is_good);
    found.into_iter().for_each(|alpha| *x += d * alpha);
    found.is_some()
}

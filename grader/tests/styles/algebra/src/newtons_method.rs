use nalgebra::DVector;
use nalgebra_sparse::CsrMatrix;

/// A state that knows its value and its gradient, and moves.
pub fn newtons_method(
    x0: &mut DVector<f64>,
    f: impl Fn(&DVector<f64>) -> f64,
    g: impl Fn(&DVector<f64>) -> DVector<f64>,
    H: impl Fn(&DVector<f64>) -> CsrMatrix<f64>,
    solve: impl Fn(&CsrMatrix<f64>, &DVector<f64>) -> DVector<f64>,
    max_steps: usize,
) -> f64 {
    let mut state = State::at(x0.clone(), &f, &g);
    let small = 1e-10 * state.g.norm();
    let mut left = max_steps;
    while left > 0 && !(state.g.norm() <= small) {
        let d = solve(&H(&state.x), &(-&state.g));
        let bound = 1e-8 * state.g.dot(&d);
        let lengths = (0..27).map(|halvings| 1.0 / f64::from(1_u32 << halvings));
        let accepted = lengths.map(|alpha| (alpha, &state.x + alpha * &d)).find(|(alpha, x)| {
            let value = f(x);
            // Infinite values and NaN are no decrease, however the comparison comes out.
            value.is_finite() && value <= state.f + alpha * bound
        });
        let Some((_, x)) = accepted else { break };
        state = State::at(x, &f, &g);
        left -= 1;
    }
    *x0 = state.x;
    state.f
}

struct State {
    x: DVector<f64>,
    f: f64,
    g: DVector<f64>,
}

impl State {
    fn at(x: DVector<f64>, f: &impl Fn(&DVector<f64>) -> f64, g: &impl Fn(&DVector<f64>) -> DVector<f64>) -> Self {
        Self { f: f(&x), g: g(&x), x }
    }
}

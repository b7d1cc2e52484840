//! Newton's method with a line search.

mod mistakes;

use std::cell::Cell;

use nalgebra::{DMatrix, DVector};
use nalgebra_sparse::CsrMatrix;

use crate::reference::systems::solve;
use crate::reference::trial::{Input, Observed, Trial};

pub use mistakes::SWITCHES;

type Vector = DVector<f64>;

/// The decisions of the method.
#[derive(Clone, Copy)]
pub struct Settings {
    /// The direction, from the gradient and the Hessian's solution for minus the gradient.
    direction: fn(&Vector, Vector) -> Vector,
    /// True for each of value, gradient and Hessian that is evaluated anew for each direction.
    pub anew: [bool; 3],
    first: f64,
    shorter: f64,
    shortest: f64,
    decrease: f64,
    slope: fn(f64) -> f64,
    /// The largest value that is good enough, from the value before and the one by the sufficient decrease.
    bound: fn(f64, f64) -> f64,
    /// The share of the decrease that is asked for at a step length.
    share: fn(f64) -> f64,
    /// Returns true to stop after a step. Arguments: the decrease of f, the length of the step, and α.
    done: fn(f64, f64, f64) -> bool,
    accepts: fn(f64, f64) -> bool,
    /// Returns true if the gradient is small. Arguments: its norm, and that at the start.
    small: fn(f64, f64) -> bool,
    pub most: fn(usize) -> usize,
    /// The step length after a line search without an acceptable step. 0: give up. NaN: continue without a step.
    last: fn(f64) -> f64,
    carries_over: bool,
    left_behind: bool,
    moved: fn(&Vector, &Vector, f64) -> Vector,
    answer: fn(Ends) -> f64,
    /// Most step lengths that are tried.
    trials: usize,
}

/// Candidates for the returned value: values of f at the end and at the start, norms of the gradient there.
struct Ends {
    value: f64,
    first_value: f64,
    value_before: f64,
    norm: f64,
}

/// The method of the course.
pub const RIGHT: Settings = Settings {
    direction: |_, d| d,
    anew: [true; 3],
    first: 1.0,
    shorter: 0.5,
    shortest: 1e-8,
    decrease: 1e-8,
    slope: |slope| slope,
    bound: |_, bound| bound,
    share: |alpha| alpha,
    done: |_, _, _| false,
    accepts: |value, bound| value.is_finite() && value <= bound,
    small: |norm, start| norm.is_finite() && norm <= 1e-10 * start,
    most: |most| most,
    last: |_| 0.0,
    carries_over: false,
    left_behind: false,
    moved: |x, d, alpha| x + d * alpha,
    answer: |ends| ends.value,
    trials: usize::MAX,
};

/// A function to minimise: its value, gradient and Hessian.
pub struct Problem<'a> {
    pub value: &'a dyn Fn(&Vector) -> f64,
    pub gradient: &'a dyn Fn(&Vector) -> Vector,
    pub hessian: &'a dyn Fn(&Vector) -> DMatrix<f64>,
    /// Number of systems of equations that were solved.
    pub solves: Cell<usize>,
}

/// Newton's method with these settings; changes `x` and returns the value that it would return.
pub fn minimise(settings: &Settings, problem: &Problem, x: &mut Vector, most: usize) -> f64 {
    let [anew_value, anew_gradient, anew_hessian] = settings.anew;
    let (first_value, first_gradient) = ((problem.value)(x), (problem.gradient)(x));
    let (start, first_hessian) = (first_gradient.norm(), (problem.hessian)(x));
    let (mut alpha, mut value_before) = (settings.first, first_value);
    for _ in 0..(settings.most)(most) {
        let gradient = if anew_gradient { (problem.gradient)(x) } else { first_gradient.clone() };
        let norm = gradient.norm();
        if norm == 0.0 || (settings.small)(norm, start) {
            break;
        }
        let hessian = if anew_hessian { (problem.hessian)(x) } else { first_hessian.clone() };
        problem.solves.set(problem.solves.get() + 1);
        let direction = (settings.direction)(&gradient, solve(&CsrMatrix::from(&hessian), &-&gradient));
        let value = if anew_value { (problem.value)(x) } else { first_value };
        let slope = (settings.slope)(gradient.dot(&direction));
        alpha = if settings.carries_over { alpha } else { settings.first };
        let mut tried = 0;
        let is_good = |x: &Vector, alpha: f64| {
            let bound = value + settings.decrease * (settings.share)(alpha) * slope;
            (settings.accepts)((problem.value)(&(x + &direction * alpha)), (settings.bound)(value, bound))
        };
        let mut good = is_good(x, alpha);
        while !good {
            alpha *= settings.shorter;
            tried += 1;
            if alpha < settings.shortest || tried >= settings.trials {
                break;
            }
            if settings.left_behind {
                x.axpy(alpha / settings.shorter, &direction, 1.0);
            }
            good = is_good(x, alpha);
        }
        if !good {
            alpha = (settings.last)(alpha);
            if alpha == 0.0 {
                break;
            }
        }
        value_before = value;
        *x = (settings.moved)(x, &direction, alpha);
        if (settings.done)(value - (problem.value)(x), alpha * direction.norm(), alpha) {
            break;
        }
    }
    let norm = (problem.gradient)(x).norm();
    (settings.answer)(Ends { value: (problem.value)(x), first_value, value_before, norm })
}

/// The method with these settings.
pub fn run(settings: &Settings, trial: &Trial) -> Option<Observed> {
    let Input::Minimum { objective, start, max_steps } = &trial.input else { return None };
    let mut x = start.clone();
    let problem = Problem {
        value: &|x| objective.value(x),
        gradient: &|x| objective.gradient(x),
        hessian: &|x| DMatrix::from(&objective.hessian(x)),
        solves: Cell::default(),
    };
    let value = minimise(settings, &problem, &mut x, *max_steps);
    let calls = vec![("solve", problem.solves.get())];
    Some(Observed { calls, ..Observed::vector(std::iter::once(value).chain(x.iter().copied()).collect()) })
}

/// Takes every full step.
pub fn without_search(settings: &mut Settings) {
    settings.accepts = |_, _| true;
}

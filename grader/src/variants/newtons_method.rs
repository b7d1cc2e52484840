//! Mistakes in `newtons_method`.

use grader_child::{Gradient, Hessian, Objective, Solve};
use nalgebra::DVector;

use super::Variant;
use crate::reference::REFERENCE;

/// The mistakes that are known.
pub const VARIANTS: &[Variant] = &[
    variant!(
        newtons_method,
        "negated",
        "The direction leads uphill: look at the sign of the right-hand side.",
        |x0, f, g, H, solve, max_steps| { (REFERENCE.newtons_method)(x0, f, g, H, &|A, b| -solve(A, b), max_steps) }
    ),
    variant!(
        newtons_method,
        "accepts NaN",
        "A step to a point where f is not a number was taken: what does a comparison with NaN give?",
        |x0, f, g, H, solve, max_steps| {
            let accepts = |f_new: f64, bound| f_new.is_nan() || f_new <= bound;
            newton(&Habits { accepts, ..USUAL }, x0, f, g, H, solve, max_steps)
        }
    ),
    variant!(
        newtons_method,
        "missing backtracking",
        "A full step can overshoot. After it f must be smaller than before, else the step was too long.",
        |x0, f, g, H, solve, max_steps| {
            newton(&Habits { accepts: |_, _| true, ..USUAL }, x0, f, g, H, solve, max_steps)
        }
    ),
    variant!(
        newtons_method,
        "absolute tolerance",
        "What is a small gradient depends on the units. Small compared with what?",
        |x0, f, g, H, solve, max_steps| {
            let small = |norm: f64, _: f64| norm <= 1e-10;
            newton(&Habits { small, ..USUAL }, x0, f, g, H, solve, max_steps)
        }
    ),
    variant!(
        newtons_method,
        "loose tolerance",
        "The gradient at the end is not small enough: read on the page when to stop.",
        |x0, f, g, H, solve, max_steps| {
            let small = |norm: f64, start: f64| norm <= 1e-3 * start;
            newton(&Habits { small, ..USUAL }, x0, f, g, H, solve, max_steps)
        }
    ),
    variant!(
        newtons_method,
        "one step too many",
        "Count the directions: there may be `max_steps` of them, and none where it is zero.",
        |x0, f, g, H, solve, max_steps| (REFERENCE.newtons_method)(x0, f, g, H, solve, max_steps.saturating_add(1))
    ),
    variant!(
        newtons_method,
        "one step too few",
        "Count the directions: the last one that `max_steps` allows is not taken.",
        |x0, f, g, H, solve, max_steps| (REFERENCE.newtons_method)(x0, f, g, H, solve, max_steps.saturating_sub(1))
    ),
    variant!(
        newtons_method,
        "not put back",
        "Each trial starts from the same point, and where none is good enough x0 must be as it was.",
        |x0, f, g, H, solve, max_steps| {
            newton(&Habits { left_behind: |alpha| alpha, ..USUAL }, x0, f, g, H, solve, max_steps)
        }
    ),
    variant!(
        newtons_method,
        "step carried over",
        "Each new direction deserves a full step first. With which step does your second line search begin?",
        |x0, f, g, H, solve, max_steps| {
            newton(&Habits { first_step: |last| last, ..USUAL }, x0, f, g, H, solve, max_steps)
        }
    ),
    variant!(
        newtons_method,
        "value at the start",
        "The value that is returned must belong to the point that is left in x0.",
        |x0, f, g, H, solve, max_steps| {
            let at_start = f(x0);
            (REFERENCE.newtons_method)(x0, f, g, H, solve, max_steps);
            at_start
        }
    ),
    variant!(
        newtons_method,
        "Hessian at the minimum",
        "A start at the minimum needs no Hessian and no solve. When do you look at the gradient?",
        |x0, f, g, H, solve, max_steps| {
            let _ = H(x0);
            (REFERENCE.newtons_method)(x0, f, g, H, solve, max_steps)
        }
    ),
];

/// A mistake in Newton's method.
struct Habits {
    /// Takes the value after a step and the largest value that is good enough.
    accepts: fn(f64, f64) -> bool,
    /// Takes the norms of the gradient here and at the start.
    small: fn(f64, f64) -> bool,
    /// Fraction of the way to a rejected point that stays in x0.
    left_behind: fn(f64) -> f64,
    /// The first step of a line search, from the last one of the search before.
    first_step: fn(f64) -> f64,
}

const USUAL: Habits = Habits {
    accepts: |f_new, bound| f_new.is_finite() && f_new <= bound,
    small: |norm, start| norm <= 1e-10 * start,
    left_behind: |_| 0.0,
    first_step: |_| 1.0,
};

/// Newton's method with these settings.
fn newton(
    habits: &Habits,
    x0: &mut DVector<f64>,
    f: Objective,
    g: Gradient,
    H: Hessian,
    solve: Solve,
    max_steps: usize,
) -> f64 {
    let (mut at_start, mut alpha) = (None, 1.0);
    for _ in 0..max_steps {
        let gradient = g(x0);
        let norm = gradient.norm();
        if norm == 0.0 || (habits.small)(norm, *at_start.get_or_insert(norm)) {
            break;
        }
        let direction = solve(&H(x0), &-&gradient);
        let (f_x0, slope) = (f(x0), gradient.dot(&direction));
        alpha = (habits.first_step)(alpha);
        while alpha >= 1e-8 && !(habits.accepts)(f(&(&*x0 + &direction * alpha)), f_x0 + 1e-8 * alpha * slope) {
            x0.axpy((habits.left_behind)(alpha), &direction, 1.0);
            alpha *= 0.5;
        }
        if alpha < 1e-8 {
            break;
        }
        x0.axpy(alpha, &direction, 1.0);
    }
    f(x0)
}

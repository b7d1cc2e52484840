//! The mistakes in Newton's method.

use super::Settings;
use crate::diagnosis::switches::Switch;

const DIRECTION: &str = "Look at the first direction: which system of equations does Newton's method solve for it?";
const ANEW: &str = "The first direction is right, the later ones are not: what must be computed anew at each point?";
const LENGTH: &str = "The directions are right, the lengths of the steps are not: compare your line search with the page, number by number.";
const BOUND: &str =
    "The line search takes the wrong one of its steps: compare its condition with the page, sign by sign.";
const END: &str = "The gradient at the end is not as small as it should be: when does the method stop?";
const REFUSED: &str = "Where no step is good enough, x0 must be left as it was.";
const RETURNED: &str =
    "The point is right, the value returned is not: which value belongs to the point that is left in x0?";

/// The mistakes.
pub const SWITCHES: &[Switch<Settings>] = &[
    ("negated", "The direction leads uphill: look at the sign of the right-hand side.", |s| s.direction = |_, d| -d),
    ("gradient for the direction", DIRECTION, |s| s.direction = |g, _| -g),
    ("gradient uphill for the direction", DIRECTION, |s| s.direction = |g, _| g.clone()),
    ("unit direction", DIRECTION, |s| s.direction = |_, d| &d / d.norm()),
    ("value not evaluated anew", ANEW, |s| s.anew[0] = false),
    ("gradient not evaluated anew", ANEW, |s| s.anew[1] = false),
    ("Hessian not evaluated anew", ANEW, |s| s.anew[2] = false),
    ("gradient and Hessian not evaluated anew", ANEW, |s| {
        s.anew[1] = false;
        s.anew[2] = false;
    }),
    ("line search begins at another step", LENGTH, |s| s.first = 0.5),
    ("line search begins beyond a full step", LENGTH, |s| s.first = 2.0),
    ("line search begins at a tenth", LENGTH, |s| s.first = 0.1),
    ("half of the direction", DIRECTION, |s| s.direction = |_, d| d * 0.5),
    ("twice the direction", DIRECTION, |s| s.direction = |_, d| d * 2.0),
    ("other factor of the line search", LENGTH, |s| s.shorter = 0.9),
    ("other factor of the line search", LENGTH, |s| s.shorter = 0.8),
    ("other factor of the line search", LENGTH, |s| s.shorter = 0.75),
    ("other factor of the line search", LENGTH, |s| s.shorter = 0.25),
    ("other factor of the line search", LENGTH, |s| s.shorter = 0.1),
    ("other factor of the line search", LENGTH, |s| s.shorter = 0.2),
    ("other factor of the line search", LENGTH, |s| s.shorter = 0.7),
    ("line search gives up too early", LENGTH, |s| s.shortest = 0.9),
    ("line search gives up too early", LENGTH, |s| s.shortest = 0.4),
    ("line search gives up too early", LENGTH, |s| s.shortest = 0.1),
    ("line search gives up too early", LENGTH, |s| s.shortest = 0.01),
    ("line search gives up too early", LENGTH, |s| s.trials = 2),
    ("line search gives up too early", LENGTH, |s| s.trials = 3),
    ("line search gives up too early", LENGTH, |s| s.trials = 5),
    ("other sufficient decrease", BOUND, |s| s.decrease = 0.5),
    ("other sufficient decrease", BOUND, |s| s.decrease = 0.1),
    ("other sufficient decrease", BOUND, |s| s.decrease = 0.25),
    ("other sufficient decrease", BOUND, |s| s.decrease = 0.9),
    ("other sufficient decrease", BOUND, |s| s.decrease = 1.0),
    ("other sufficient decrease", BOUND, |s| s.decrease = 1e-1),
    ("other sufficient decrease", BOUND, |s| s.decrease = 1e-2),
    ("other sufficient decrease", BOUND, |s| s.decrease = 1e-3),
    ("other sufficient decrease", BOUND, |s| s.decrease = 1e-4),
    ("sign of the sufficient decrease", BOUND, |s| {
        s.slope = |slope| -slope;
        s.decrease = 0.5;
    }),
    ("sufficient decrease without α", BOUND, |s| {
        s.share = |_| 1.0;
        s.decrease = 0.1;
    }),
    ("sufficient decrease without α", BOUND, |s| {
        s.share = |_| 1.0;
        s.decrease = 0.5;
    }),
    ("sufficient decrease without α", BOUND, |s| {
        s.share = |_| 1.0;
        s.decrease = 1.0;
    }),
    ("other condition of decrease", BOUND, |s| s.bound = |before, _| 0.9 * before),
    ("other condition of decrease", BOUND, |s| s.bound = |before, _| 0.5 * before),
    ("other condition of decrease", BOUND, |s| s.bound = |before, _| before - 1e-3),
    ("other condition of decrease", BOUND, |s| s.bound = |_, _| 0.0),
    ("stops by the change of f", END, |s| s.done = |decrease, _, _| decrease < 1e-2),
    ("stops by the change of f", END, |s| s.done = |decrease, _, _| decrease < 1e-3),
    ("stops by the change of f", END, |s| s.done = |decrease, _, _| decrease < 1e-4),
    ("stops by the change of f", END, |s| s.done = |decrease, _, _| decrease < 1e-6),
    ("stops by the change of f", END, |s| s.done = |decrease, _, _| decrease < 1e-8),
    ("stops by the length of the step", END, |s| s.done = |_, length, _| length < 1e-2),
    ("stops by the length of the step", END, |s| s.done = |_, length, _| length < 1e-3),
    ("stops by the length of the step", END, |s| s.done = |_, length, _| length < 1e-4),
    ("stops by the length of the step", END, |s| s.done = |_, length, _| length < 1e-6),
    ("fixed step", LENGTH, |s| fixed(s, 0.1)),
    ("fixed step", LENGTH, |s| fixed(s, 0.5)),
    ("fixed step", LENGTH, |s| fixed(s, 0.8)),
    ("fixed step", LENGTH, |s| fixed(s, 0.9)),
    (
        "accepts NaN",
        "A step to a point where f is not a number was taken: what does a comparison with NaN give?",
        |s| {
            s.accepts = |value, bound| value.is_nan() || value <= bound;
        },
    ),
    (
        "missing backtracking",
        "A full step can overshoot. After it f must be smaller than before, else the step was too long.",
        |s| {
            s.accepts = |_, _| true;
        },
    ),
    ("only finite is asked for", BOUND, |s| s.accepts = |value, _| value.is_finite()),
    ("comparison the wrong way round", BOUND, |s| s.accepts = |value, bound| value >= bound),
    ("accepts what is larger than before", BOUND, |s| {
        s.accepts = |value, bound| value.is_finite() && value <= bound.abs() * 2.0
    }),
    ("stops at once", END, |s| s.small = |norm, start| norm <= start),
    ("absolute tolerance", "What is a small gradient depends on the units. Small compared with what?", |s| {
        s.small = |norm, _| norm <= 1e-10
    }),
    ("absolute tolerance", "What is a small gradient depends on the units. Small compared with what?", |s| {
        s.small = |norm, _| norm <= 1e-8
    }),
    ("absolute tolerance", "What is a small gradient depends on the units. Small compared with what?", |s| {
        s.small = |norm, _| norm <= 1e-6
    }),
    ("absolute tolerance", "What is a small gradient depends on the units. Small compared with what?", |s| {
        s.small = |norm, _| norm <= 1e-5
    }),
    ("absolute tolerance", "What is a small gradient depends on the units. Small compared with what?", |s| {
        s.small = |norm, _| norm <= 1e-4
    }),
    ("absolute tolerance", "What is a small gradient depends on the units. Small compared with what?", |s| {
        s.small = |norm, _| norm <= 1e-3
    }),
    ("loose tolerance", END, |s| s.small = |norm, start| norm <= 1e-1 * start),
    ("loose tolerance", END, |s| s.small = |norm, start| norm <= 1e-2 * start),
    ("loose tolerance", END, |s| s.small = |norm, start| norm <= 1e-3 * start),
    ("loose tolerance", END, |s| s.small = |norm, start| norm <= 1e-4 * start),
    ("loose tolerance", END, |s| s.small = |norm, start| norm <= 1e-5 * start),
    ("loose tolerance", END, |s| s.small = |norm, start| norm <= 1e-6 * start),
    ("loose tolerance", END, |s| s.small = |norm, start| norm * norm <= 1e-10 * start * start),
    ("one step too many", "Count the directions: there may be `max_steps` of them, and none where it is zero.", |s| {
        s.most = |n| n.saturating_add(1)
    }),
    ("one step too few", "Count the directions: the last one that `max_steps` allows is not taken.", |s| {
        s.most = |n| n.saturating_sub(1)
    }),
    ("a single step", "Only one direction is taken. When does Newton's method end?", |s| s.most = |n| n.min(1)),
    ("steps without limit", "More directions are taken than `max_steps` allows.", |s| s.most = |_| 200),
    ("smallest step taken anyway", REFUSED, |s| s.last = |alpha| alpha),
    ("smallest step taken anyway", REFUSED, |s| {
        s.last = |alpha| alpha;
        s.done = |_, _, alpha| alpha < 1e-8;
    }),
    ("full step where none is good enough", REFUSED, |s| s.last = |_| 1.0),
    (
        "not put back",
        "Each trial starts from the same point, and where none is good enough x0 must be as it was.",
        |s| s.left_behind = true,
    ),
    (
        "step carried over",
        "Each new direction deserves a full step first. With which step does your second line search begin?",
        |s| s.carries_over = true,
    ),
    ("full step after the search", LENGTH, |s| s.moved = |x, d, _| x + d),
    ("step taken backwards", DIRECTION, |s| s.moved = |x, d, alpha| x - d * alpha),
    ("step taken twice", LENGTH, |s| s.moved = |x, d, alpha| x + d * (2.0 * alpha)),
    ("step shortened once too often", LENGTH, |s| s.moved = |x, d, alpha| x + d * (0.5 * alpha)),
    ("direction for the point", DIRECTION, |s| s.moved = |_, d, alpha| d * alpha),
    ("start not moved", "The starting point is left as it was. Where is the solution to be written?", |s| {
        s.moved = |x, _, _| x.clone()
    }),
    ("value at the start", RETURNED, |s| s.answer = |ends| ends.first_value),
    ("value before the last step", RETURNED, |s| s.answer = |ends| ends.value_before),
    ("norm of the gradient returned", RETURNED, |s| s.answer = |ends| ends.norm),
    ("zero returned", RETURNED, |s| s.answer = |_| 0.0),
    ("decrease of the value returned", RETURNED, |s| s.answer = |ends| ends.first_value - ends.value),
];

fn fixed(settings: &mut Settings, length: f64) {
    settings.accepts = |_, _| true;
    settings.first = length;
}

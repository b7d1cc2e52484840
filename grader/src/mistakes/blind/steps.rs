//! Time steps and Newton's method.

use finite_elements_3d as solved;
use nalgebra::DVector;
use nalgebra_sparse::CsrMatrix;

use super::super::Mistake;

/// The mistakes of this set.
pub const MISTAKES: &[Mistake] = &[
    // dt in place of dt² in the matrix
    wrong!(linearly_implicit_euler, ["dt for dt²"], |q, qdot, dt, mass, force, stiffness, solve| {
        let A = mass - stiffness(q, qdot) * dt;
        let b = mass * &*qdot + force(q, qdot) * dt;
        *qdot = solve(&A, &b);
        *q += dt * &*qdot;
    }),
    // positions moved with the old velocity
    wrong!(linearly_implicit_euler, ["old velocity"], |q, qdot, dt, mass, force, stiffness, solve| {
        let A = mass - stiffness(q, qdot) * (dt * dt);
        let b = mass * &*qdot + force(q, qdot) * dt;
        *q += dt * &*qdot;
        *qdot = solve(&A, &b);
    }),
    // mass left out on the right
    wrong!(linearly_implicit_euler, ["mass left out of the momentum"], |q, qdot, dt, mass, force, stiffness, solve| {
        let A = mass - stiffness(q, qdot) * (dt * dt);
        let b = &*qdot + force(q, qdot) * dt;
        *qdot = solve(&A, &b);
        *q += dt * &*qdot;
    }),
    // velocity change without dt² K v (K at the old velocity left out of the right-hand side)
    wrong!(
        linearly_implicit_euler,
        ["stiffness left out of the change of velocity"],
        |q, qdot, dt, mass, force, stiffness, solve| {
            let A = mass - stiffness(q, qdot) * (dt * dt);
            let b = force(q, qdot) * dt;
            *qdot += solve(&A, &b);
            *q += dt * &*qdot;
        }
    ),
    // M + dt² K
    wrong!(linearly_implicit_euler, ["stiffness with the wrong sign"], |q, qdot, dt, mass, force, stiffness, solve| {
        let A = mass + stiffness(q, qdot) * (dt * dt);
        let b = mass * &*qdot + force(q, qdot) * dt;
        *qdot = solve(&A, &b);
        *q += dt * &*qdot;
    }),
    // force at q and not at q + dt v
    wrong!(implicit_euler, ["force at the start of the step"], |q, qdot, dt, mass, energy, force, stiffness, solve| {
        let (q0, v0) = (q.clone(), qdot.clone());
        let g = |v: &DVector<f64>| mass * (v - &v0) - dt * force(&q0, v);
        let H = |v: &DVector<f64>| mass - stiffness(&(&q0 + dt * v), v) * (dt * dt);
        solved::newtons_method(qdot, energy, g, H, solve, 5);
        *q += dt * &*qdot;
    }),
    // dt in the Hessian
    wrong!(implicit_euler, ["dt for dt²"], |q, qdot, dt, mass, energy, force, stiffness, solve| {
        let (q0, v0) = (q.clone(), qdot.clone());
        let g = |v: &DVector<f64>| mass * (v - &v0) - dt * force(&(&q0 + dt * v), v);
        let H = |v: &DVector<f64>| mass - stiffness(&(&q0 + dt * v), v) * dt;
        solved::newtons_method(qdot, energy, g, H, solve, 5);
        *q += dt * &*qdot;
    }),
    // Newton started at zero velocity
    wrong!(implicit_euler, ["starts at rest"], |q, qdot, dt, mass, energy, force, stiffness, solve| {
        let (q0, v0) = (q.clone(), qdot.clone());
        let g = |v: &DVector<f64>| mass * (v - &v0) - dt * force(&(&q0 + dt * v), v);
        let H = |v: &DVector<f64>| mass - stiffness(&(&q0 + dt * v), v) * (dt * dt);
        let mut v = DVector::zeros(q0.len());
        solved::newtons_method(&mut v, energy, g, H, solve, 5);
        *q += dt * &v;
        *qdot = v;
    }),
    // dt left out of the gradient
    wrong!(implicit_euler, ["missing dt"], |q, qdot, dt, mass, energy, force, stiffness, solve| {
        let (q0, v0) = (q.clone(), qdot.clone());
        let g = |v: &DVector<f64>| mass * (v - &v0) - force(&(&q0 + dt * v), v);
        let H = |v: &DVector<f64>| mass - stiffness(&(&q0 + dt * v), v) * (dt * dt);
        solved::newtons_method(qdot, energy, g, H, solve, 5);
        *q += dt * &*qdot;
    }),
    // positions moved with the old velocity
    wrong!(implicit_euler, ["old velocity"], |q, qdot, dt, mass, energy, force, stiffness, solve| {
        let (q0, v0) = (q.clone(), qdot.clone());
        let g = |v: &DVector<f64>| mass * (v - &v0) - dt * force(&(&q0 + dt * v), v);
        let H = |v: &DVector<f64>| mass - stiffness(&(&q0 + dt * v), v) * (dt * dt);
        solved::newtons_method(qdot, energy, g, H, solve, 5);
        *q += dt * &v0;
    }),
    // absolute tolerance
    wrong!(newtons_method, ["absolute tolerance"], |x0, f, g, H, solve, max_steps| {
        newton(&Slips { absolute: true, ..NONE }, x0, f, g, H, solve, max_steps)
    }),
    // no line search
    wrong!(newtons_method, ["missing backtracking"], |x0, f, g, H, solve, max_steps| {
        newton(&Slips { search: false, ..NONE }, x0, f, g, H, solve, max_steps)
    }),
    // step length carried over
    wrong!(newtons_method, ["step carried over"], |x0, f, g, H, solve, max_steps| {
        newton(&Slips { keep_alpha: true, ..NONE }, x0, f, g, H, solve, max_steps)
    }),
    // the value of the point before
    wrong!(newtons_method, ["value before the last step"], |x0, f, g, H, solve, max_steps| {
        newton(&Slips { stale: true, ..NONE }, x0, f, g, H, solve, max_steps)
    }),
    // NaN accepted
    wrong!(newtons_method, ["accepts NaN"], |x0, f, g, H, solve, max_steps| {
        newton(&Slips { accept_nan: true, ..NONE }, x0, f, g, H, solve, max_steps)
    }),
    // moved though the search gave up
    wrong!(newtons_method, ["smallest step taken anyway"], |x0, f, g, H, solve, max_steps| {
        newton(&Slips { move_on_giving_up: true, ..NONE }, x0, f, g, H, solve, max_steps)
    }),
    // c = 1/2 in place of 1e-8
    wrong!(newtons_method, ["other sufficient decrease"], |x0, f, g, H, solve, max_steps| {
        newton(&Slips { strict_decrease: true, ..NONE }, x0, f, g, H, solve, max_steps)
    }),
    // one direction more than max_steps
    wrong!(newtons_method, ["one step too many"], |x0, f, g, H, solve, max_steps| {
        newton(&Slips { one_more: true, ..NONE }, x0, f, g, H, solve, max_steps)
    }),
    // the full step is never tried
    wrong!(newtons_method, ["line search begins at another step"], |x0, f, g, H, solve, max_steps| {
        newton(&Slips { half_first: true, ..NONE }, x0, f, g, H, solve, max_steps)
    }),
];

struct Slips {
    absolute: bool,
    search: bool,
    keep_alpha: bool,
    stale: bool,
    accept_nan: bool,
    move_on_giving_up: bool,
    strict_decrease: bool,
    one_more: bool,
    half_first: bool,
}
const NONE: Slips = Slips {
    absolute: false,
    search: true,
    keep_alpha: false,
    stale: false,
    accept_nan: false,
    move_on_giving_up: false,
    strict_decrease: false,
    one_more: false,
    half_first: false,
};
#[allow(clippy::too_many_arguments)]
fn newton(
    slips: &Slips,
    x: &mut DVector<f64>,
    f: impl Fn(&DVector<f64>) -> f64,
    g: impl Fn(&DVector<f64>) -> DVector<f64>,
    H: impl Fn(&DVector<f64>) -> CsrMatrix<f64>,
    solve: impl Fn(&CsrMatrix<f64>, &DVector<f64>) -> DVector<f64>,
    max_steps: usize,
) -> f64 {
    let mut start = f64::NAN;
    let mut alpha = 1.0;
    let mut value = f(x);
    for step in 0..max_steps + usize::from(slips.one_more) {
        let gradient = g(x);
        if step == 0 {
            start = gradient.norm();
        }
        if gradient.norm() <= if slips.absolute { 1e-10 } else { 1e-10 * start } {
            break;
        }
        let d = solve(&H(x), &-&gradient);
        let slope = gradient.dot(&d);
        if !slips.search {
            *x += d;
            value = f(x);
            continue;
        }
        if !slips.keep_alpha {
            alpha = if slips.half_first { 0.5 } else { 1.0 };
        }
        let here = f(x);
        let good = |alpha: f64| {
            let there = f(&(&*x + alpha * &d));
            let c = if slips.strict_decrease { 0.5 } else { 1e-8 };
            let enough = here + c * alpha * slope;
            if slips.accept_nan { there.is_nan() || there <= enough } else { there.is_finite() && there <= enough }
        };
        while alpha >= 1e-8 && !good(alpha) {
            alpha *= 0.5;
        }
        if alpha < 1e-8 && !slips.move_on_giving_up {
            break;
        }
        value = here;
        *x += alpha * d;
        if !slips.stale {
            value = f(x);
        }
        if alpha < 1e-8 {
            break;
        }
    }
    value
}

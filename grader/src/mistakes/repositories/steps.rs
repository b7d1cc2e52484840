//! Newton's method and time steps.

use finite_elements_3d as solved;
use nalgebra::DVector;

use super::super::Mistake;

/// The mistakes of this set.
pub const MISTAKES: &[Mistake] = &[
    // dt² on the force, as in a solve for positions
    wrong!(linearly_implicit_euler, ["scaled by dt"], |q, qdot, dt, mass, force, stiffness, solve| {
        let A = mass - stiffness(q, qdot) * (dt * dt);
        let b = mass * &*qdot + force(q, qdot) * (dt * dt);
        *qdot = solve(&A, &b);
        *q += &*qdot * dt;
    }),
    // The solution taken for the change of velocity
    wrong!(
        linearly_implicit_euler,
        ["solution added to the velocity"],
        |q, qdot, dt, mass, force, stiffness, solve| {
            let A = mass - stiffness(q, qdot) * (dt * dt);
            let b = mass * &*qdot + force(q, qdot) * dt;
            let dv = solve(&A, &b);
            *qdot += dv;
            *q += &*qdot * dt;
        }
    ),
    // An absolute tolerance, and ten halvings at most
    wrong!(newtons_method, ["absolute tolerance"], |x0, f, g, H, solve, max_steps| {
        for _ in 0..max_steps {
            let grad = g(x0);
            if grad.norm() < 1e-4 {
                break;
            }
            if !search(x0, &solve(&H(x0), &-&grad), f, &grad, 1e-8) {
                break;
            }
        }
        f(x0)
    }),
    // The value before the last step is returned.
    wrong!(newtons_method, ["value before the last step"], |x0, f, g, H, solve, max_steps| {
        let start = g(x0).norm();
        let mut value = f(x0);
        for _ in 0..max_steps {
            let grad = g(x0);
            if grad.norm() <= 1e-10 * start {
                break;
            }
            value = f(x0);
            if !search(x0, &solve(&H(x0), &-&grad), f, &grad, 1e-8) {
                break;
            }
        }
        value
    }),
    // No line search
    wrong!(newtons_method, ["missing backtracking"], |x0, f, g, H, solve, max_steps| {
        let start = g(x0).norm();
        for _ in 0..max_steps {
            let grad = g(x0);
            if grad.norm() <= 1e-10 * start {
                break;
            }
            *x0 += solve(&H(x0), &-&grad);
        }
        f(x0)
    }),
    // H and g exchanged signs: uphill, so that the search gives up
    wrong!(newtons_method, ["negated"], |x0, f, g, H, solve, max_steps| {
        let start = g(x0).norm();
        for _ in 0..max_steps {
            let grad = g(x0);
            if grad.norm() <= 1e-10 * start {
                break;
            }
            if !search(x0, &solve(&H(x0), &grad), f, &grad, 1e-8) {
                break;
            }
        }
        f(x0)
    }),
    // The gradient without dt on the force
    wrong!(implicit_euler, ["missing dt"], |q, qdot, dt, mass, energy, force, stiffness, solve| {
        let (q0, v0) = (q.clone(), qdot.clone());
        let g = |v: &DVector<f64>| mass * (v - &v0) - force(&(&q0 + v * dt), v);
        let H = |v: &DVector<f64>| mass - stiffness(&(&q0 + v * dt), v) * (dt * dt);
        solved::newtons_method(qdot, energy, g, H, solve, 5);
        *q += &*qdot * dt;
    }),
    // The positions move before Newton's method, with the old velocity
    wrong!(implicit_euler, ["old velocity"], |q, qdot, dt, mass, energy, force, stiffness, solve| {
        let (q0, v0) = (q.clone(), qdot.clone());
        *q += &*qdot * dt;
        let g = |v: &DVector<f64>| mass * (v - &v0) - force(&(&q0 + v * dt), v) * dt;
        let H = |v: &DVector<f64>| mass - stiffness(&(&q0 + v * dt), v) * (dt * dt);
        solved::newtons_method(qdot, energy, g, H, solve, 5);
    }),
    // A single Newton step
    wrong!(implicit_euler, ["one step only"], |q, qdot, dt, mass, energy, force, stiffness, solve| {
        let (q0, v0) = (q.clone(), qdot.clone());
        let g = |v: &DVector<f64>| mass * (v - &v0) - force(&(&q0 + v * dt), v) * dt;
        let H = |v: &DVector<f64>| mass - stiffness(&(&q0 + v * dt), v) * (dt * dt);
        solved::newtons_method(qdot, energy, g, H, solve, 1);
        *q += &*qdot * dt;
    }),
    // The stiffness at the start of the step, once for all
    wrong!(
        implicit_euler,
        ["stiffness at the start of the step", "Hessian not evaluated anew"],
        |q, qdot, dt, mass, energy, force, stiffness, solve| {
            let (q0, v0) = (q.clone(), qdot.clone());
            let K = stiffness(q, qdot);
            let g = |v: &DVector<f64>| mass * (v - &v0) - force(&(&q0 + v * dt), v) * dt;
            let H = |_: &DVector<f64>| mass - &K * (dt * dt);
            solved::newtons_method(qdot, energy, g, H, solve, 5);
            *q += &*qdot * dt;
        }
    ),
];

/// A backtracking line search; false if no step is good enough.
fn search(
    x: &mut DVector<f64>,
    d: &DVector<f64>,
    f: &dyn Fn(&DVector<f64>) -> f64,
    grad: &DVector<f64>,
    c: f64,
) -> bool {
    let (value, slope) = (f(x), grad.dot(d));
    let mut alpha = 1.0;
    while alpha >= 1e-8 {
        let x_new = &*x + d * alpha;
        let new = f(&x_new);
        if new.is_finite() && new <= value + c * alpha * slope {
            *x = x_new;
            return true;
        }
        alpha *= 0.5;
    }
    false
}

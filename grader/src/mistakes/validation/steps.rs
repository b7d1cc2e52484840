//! Integrators and Newton's method.

use finite_elements_3d::given::add_scaled;
use grader_child::{Force, Gradient, Hessian, Objective, Solve, Stiffness};
use nalgebra::DVector;
use nalgebra_sparse::CsrMatrix;

use super::super::Mistake;

/// The mistakes of this set.
pub const MISTAKES: &[Mistake] = &[
    // Explicit Euler with the mass alone.
    wrong!(linearly_implicit_euler, ["stiffness left out"], |q, qdot, dt, mass, force, _, solve| {
        *qdot = &*qdot + solve(mass, &(force(q, qdot) * dt));
        q.axpy(dt, qdot, 1.0);
    }),
    wrong!(linearly_implicit_euler, ["stiffness without dt"], |q, qdot, dt, mass, force, stiffness, solve| {
        let A = add_scaled(mass, -1.0, &stiffness(q, qdot));
        *qdot = solve(&A, &(mass * &*qdot + force(q, qdot) * dt));
        q.axpy(dt, qdot, 1.0);
    }),
    wrong!(
        linearly_implicit_euler,
        ["velocity not changed", "velocity not written back"],
        |q, qdot, dt, mass, force, stiffness, solve| {
            let A = add_scaled(mass, -dt * dt, &stiffness(q, qdot));
            let v = solve(&A, &(mass * &*qdot + force(q, qdot) * dt));
            q.axpy(dt, &v, 1.0);
        }
    ),
    wrong!(
        linearly_implicit_euler,
        ["identity for the mass in the matrix"],
        |q, qdot, dt, mass, force, stiffness, solve| {
            let A = add_scaled(&CsrMatrix::identity(q.len()), -dt * dt, &stiffness(q, qdot));
            *qdot = solve(&A, &(mass * &*qdot + force(q, qdot) * dt));
            q.axpy(dt, qdot, 1.0);
        }
    ),
    // Two steps in one.
    wrong!(linearly_implicit_euler, ["two steps", "step taken twice"], |q, qdot, dt, mass, force, stiffness, solve| {
        right!(linearly_implicit_euler(q, qdot, dt / 2.0, mass, force, stiffness, solve));
        right!(linearly_implicit_euler(q, qdot, dt / 2.0, mass, force, stiffness, solve));
    }),
    wrong!(linearly_implicit_euler, ["positions moved twice"], |q, qdot, dt, mass, force, stiffness, solve| {
        right!(linearly_implicit_euler(q, qdot, dt, mass, force, stiffness, solve));
        q.axpy(dt, qdot, 1.0);
    }),
    // The change of velocity for the system of its own, with the stiffness's force but not times dt.
    wrong!(
        linearly_implicit_euler,
        ["stiffness without dt in the change of velocity"],
        |q, qdot, dt, mass, force, stiffness, solve| {
            let K = stiffness(q, qdot);
            let A = add_scaled(mass, -dt * dt, &K);
            let b = (force(q, qdot) + &K * &*qdot) * dt;
            *qdot += solve(&A, &b);
            q.axpy(dt, qdot, 1.0);
        }
    ),
    wrong!(linearly_implicit_euler, ["momentum with the wrong sign"], |q, qdot, dt, mass, force, stiffness, solve| {
        let A = add_scaled(mass, -dt * dt, &stiffness(q, qdot));
        *qdot = solve(&A, &(force(q, qdot) * dt - mass * &*qdot));
        q.axpy(dt, qdot, 1.0);
    }),
    wrong!(newtons_method, ["value before the last step"], |x0, f, g, H, solve, max_steps| {
        let mut last = f(x0);
        for _ in 0..max_steps {
            let before = x0.clone();
            let value = f(x0);
            right!(newtons_method(x0, f, g, H, solve, 1));
            if *x0 == before {
                break;
            }
            last = value;
        }
        last
    }),
    // The step that is too short is halved before it is tried.
    wrong!(newtons_method, ["line search begins at another step"], |x0, f, g, H, solve, max_steps| {
        descend(x0, f, g, H, solve, max_steps, |x, d, f_x, slope| {
            let mut alpha = 1.0;
            loop {
                alpha *= 0.5;
                let trial = f(&(x + d * alpha));
                if trial.is_finite() && trial <= f_x + 1e-8 * alpha * slope {
                    return alpha;
                }
                if alpha < 1e-8 {
                    return 0.0;
                }
            }
        })
    }),
    // Armijo's condition without α.
    wrong!(
        newtons_method,
        ["sufficient decrease without α", "other sufficient decrease"],
        |x0, f, g, H, solve, max_steps| {
            descend(x0, f, g, H, solve, max_steps, |x, d, f_x, slope| {
                search(f, x, d, |trial, _| trial <= f_x + 0.1 * slope)
            })
        }
    ),
    // At most ten halvings.
    wrong!(newtons_method, ["line search gives up too early"], |x0, f, g, H, solve, max_steps| {
        descend(x0, f, g, H, solve, max_steps, |x, d, f_x, slope| {
            let good = |k: &i32| {
                let alpha = 0.5f64.powi(*k);
                let trial = f(&(x + d * alpha));
                trial.is_finite() && trial <= f_x + 1e-8 * alpha * slope
            };
            (0..3).find(good).map_or(0.0, |k| 0.5f64.powi(k))
        })
    }),
    // Steps while f decreases by more than a tolerance.
    wrong!(newtons_method, ["stops by the change of f", "loose tolerance"], |x0, f, g, H, solve, max_steps| {
        for _ in 0..max_steps {
            let before = f(x0);
            right!(newtons_method(x0, f, g, H, solve, 1));
            if before - f(x0) < 1e-3 {
                break;
            }
        }
        f(x0)
    }),
    // The gradient's norm squared is compared.
    wrong!(newtons_method, ["loose tolerance"], |x0, f, g, H, solve, max_steps| {
        let start = g(x0).norm_squared();
        for _ in 0..max_steps {
            if g(x0).norm_squared() <= 1e-6 * start {
                break;
            }
            right!(newtons_method(x0, f, g, H, solve, 1));
        }
        f(x0)
    }),
    wrong!(newtons_method, ["start not moved"], |x0, f, g, H, solve, max_steps| {
        let mut x = x0.clone();
        right!(newtons_method(&mut x, f, g, H, solve, max_steps))
    }),
    // Fixed damping for every step.
    wrong!(newtons_method, ["missing backtracking", "fixed step"], |x0, f, g, H, solve, max_steps| {
        descend(x0, f, g, H, solve, max_steps, |_, _, _, _| 0.8)
    }),
    wrong!(newtons_method, ["a single step"], |x0, f, g, H, solve, max_steps| {
        right!(newtons_method(x0, f, g, H, solve, max_steps.min(1)))
    }),
    // The comparison is strict with a margin: f must fall by a tenth.
    wrong!(
        newtons_method,
        ["other condition of decrease", "other sufficient decrease"],
        |x0, f, g, H, solve, max_steps| {
            descend(x0, f, g, H, solve, max_steps, |x, d, f_x, _| search(f, x, d, |trial, _| trial < 0.9 * f_x))
        }
    ),
    wrong!(implicit_euler, ["missing dt and dt for dt²"], |q, qdot, dt, mass, energy, force, stiffness, solve| {
        let (start, old) = (q.clone(), qdot.clone());
        let g = |v: &DVector<f64>| mass * (v - &old) - force(&(&start + v * dt), v);
        let H = |v: &DVector<f64>| add_scaled(mass, -dt, &stiffness(&(&start + v * dt), v));
        right!(newtons_method(qdot, energy, &g, &H, solve, 5));
        q.axpy(dt, qdot, 1.0);
    }),
    wrong!(
        implicit_euler,
        ["velocity for the positions", "evaluated at the wrong point"],
        |q, qdot, dt, mass, energy, force, stiffness, solve| {
            // The step of positions is unknown, but treated as a velocity.
            own(q, qdot, dt, mass, energy, &|q, v| force(q, v), &|q, v| stiffness(q, v) * 2.0, solve);
        }
    ),
    wrong!(implicit_euler, ["missing backtracking"], |q, qdot, dt, mass, _, force, stiffness, solve| {
        own(q, qdot, dt, mass, &|_| 0.0, force, stiffness, solve)
    }),
    // Linearly implicit Euler in its place.
    wrong!(implicit_euler, ["one step only"], |q, qdot, dt, mass, _, force, stiffness, solve| {
        right!(linearly_implicit_euler(q, qdot, dt, mass, force, stiffness, solve))
    }),
    wrong!(implicit_euler, ["positions moved half way"], |q, qdot, dt, mass, energy, force, stiffness, solve| {
        let start = q.clone();
        right!(implicit_euler(q, qdot, dt, mass, energy, force, stiffness, solve));
        *q = (start + &*q) * 0.5;
    }),
    wrong!(implicit_euler, ["force left out"], |q, qdot, dt, mass, energy, force, stiffness, solve| {
        own(q, qdot, dt, mass, energy, &|q, v| force(q, v) * 0.0, stiffness, solve)
    }),
    wrong!(implicit_euler, ["stiffness without dt"], |q, qdot, dt, mass, energy, force, stiffness, solve| {
        own(q, qdot, dt, mass, energy, force, &|q, v| stiffness(q, v) / (dt * dt), solve)
    }),
    // The old velocity is added a second time in the update.
    wrong!(implicit_euler, ["both velocities"], |q, qdot, dt, mass, energy, force, stiffness, solve| {
        let old = qdot.clone();
        own(q, qdot, dt, mass, energy, force, stiffness, solve);
        q.axpy(dt, &old, 1.0);
    }),
    wrong!(
        implicit_euler,
        ["positions moved twice", "positions moved before the step"],
        |q, qdot, dt, mass, energy, force, stiffness, solve| {
            // The positions are moved inside of the loop as well.
            own(q, qdot, dt, mass, energy, force, stiffness, solve);
            q.axpy(dt, qdot, 1.0);
        }
    ),
    wrong!(
        implicit_euler,
        ["velocity of the positions' change", "velocity from the positions", "velocity times dt"],
        |q, qdot, dt, mass, energy, force, stiffness, solve| {
            // dt is forgotten where the velocity is taken from the change of positions.
            let start = q.clone();
            own(q, qdot, dt, mass, energy, force, stiffness, solve);
            *qdot = &*q - start;
        }
    ),
];

/// A step by Newton's method as the course has it.
#[allow(clippy::too_many_arguments)] // the course's signature
fn own(
    q: &mut DVector<f64>,
    qdot: &mut DVector<f64>,
    dt: f64,
    mass: &CsrMatrix<f64>,
    energy: Objective,
    force: Force,
    stiffness: Stiffness,
    solve: Solve,
) {
    let (start, old) = (q.clone(), qdot.clone());
    let g = |v: &DVector<f64>| mass * (v - &old) - force(&(&start + v * dt), v) * dt;
    let H = |v: &DVector<f64>| add_scaled(mass, -dt * dt, &stiffness(&(&start + v * dt), v));
    right!(newtons_method(qdot, energy, &g, &H, solve, 5));
    q.axpy(dt, qdot, 1.0);
}

/// Newton's method with a line search of its own.
fn descend(
    x0: &mut DVector<f64>,
    f: Objective,
    g: Gradient,
    H: Hessian,
    solve: Solve,
    max_steps: usize,
    length: impl Fn(&DVector<f64>, &DVector<f64>, f64, f64) -> f64,
) -> f64 {
    let start = g(x0).norm();
    for _ in 0..max_steps {
        let gradient = g(x0);
        if gradient.norm() <= 1e-10 * start {
            break;
        }
        let d = solve(&H(x0), &-&gradient);
        let alpha = length(x0, &d, f(x0), gradient.dot(&d));
        if alpha == 0.0 {
            break;
        }
        x0.axpy(alpha, &d, 1.0);
    }
    f(x0)
}

/// The longest of the steps 1, ½, ¼ … that is good; 0 where no step is.
fn search(f: Objective, x: &DVector<f64>, d: &DVector<f64>, is_good: impl Fn(f64, f64) -> bool) -> f64 {
    let mut alpha = 1.0;
    while alpha >= 1e-8 {
        let trial = f(&(x + d * alpha));
        if trial.is_finite() && is_good(trial, alpha) {
            return alpha;
        }
        alpha *= 0.5;
    }
    0.0
}

//! Integrators and Newton's method.

use finite_elements_3d::given::add_scaled;
use grader_child::{Gradient, Hessian, Objective, Solve};
use nalgebra::DVector;
use nalgebra_sparse::CsrMatrix;

use super::super::Mistake;

/// The mistakes of this set.
pub const MISTAKES: &[Mistake] = &[
    wrong!(linearly_implicit_euler, ["mass left out of the matrix"], |q, qdot, dt, mass, force, stiffness, solve| {
        let A = stiffness(q, qdot) * (-dt * dt);
        *qdot = solve(&A, &(mass * &*qdot + force(q, qdot) * dt));
        q.axpy(dt, qdot, 1.0);
    }),
    wrong!(
        linearly_implicit_euler,
        ["stiffness left out of the change of velocity"],
        |q, qdot, dt, mass, force, stiffness, solve| {
            let A = add_scaled(mass, -dt * dt, &stiffness(q, qdot));
            *qdot += solve(&A, &(force(q, qdot) * dt));
            q.axpy(dt, qdot, 1.0);
        }
    ),
    wrong!(
        linearly_implicit_euler,
        ["solution added to the velocity"],
        |q, qdot, dt, mass, force, stiffness, solve| {
            let A = add_scaled(mass, -dt * dt, &stiffness(q, qdot));
            *qdot += solve(&A, &(mass * &*qdot + force(q, qdot) * dt));
            q.axpy(dt, qdot, 1.0);
        }
    ),
    wrong!(linearly_implicit_euler, ["mass left out of the momentum"], |q, qdot, dt, mass, force, stiffness, solve| {
        let A = add_scaled(mass, -dt * dt, &stiffness(q, qdot));
        *qdot = solve(&A, &(&*qdot + force(q, qdot) * dt));
        q.axpy(dt, qdot, 1.0);
    }),
    wrong!(linearly_implicit_euler, ["damping left out"], |q, qdot, dt, mass, force, stiffness, solve| {
        let A = add_scaled(mass, -dt * dt, &stiffness(q, qdot));
        *qdot = solve(&A, &(mass * &*qdot + force(q, &DVector::zeros(q.len())) * dt));
        q.axpy(dt, qdot, 1.0);
    }),
    wrong!(linearly_implicit_euler, ["positions moved first"], |q, qdot, dt, mass, force, stiffness, solve| {
        q.axpy(dt, qdot, 1.0);
        let A = add_scaled(mass, -dt * dt, &stiffness(q, qdot));
        *qdot = solve(&A, &(mass * &*qdot + force(q, qdot) * dt));
    }),
    wrong!(linearly_implicit_euler, ["positions not moved"], |q, qdot, dt, mass, force, stiffness, solve| {
        let A = add_scaled(mass, -dt * dt, &stiffness(q, qdot));
        *qdot = solve(&A, &(mass * &*qdot + force(q, qdot) * dt));
    }),
    wrong!(linearly_implicit_euler, ["mean velocity"], |q, qdot, dt, mass, force, stiffness, solve| {
        let A = add_scaled(mass, -dt * dt, &stiffness(q, qdot));
        let old = qdot.clone();
        *qdot = solve(&A, &(mass * &*qdot + force(q, qdot) * dt));
        q.axpy(0.5 * dt, &(&old + &*qdot), 1.0);
    }),
    wrong!(linearly_implicit_euler, ["positions moved without dt"], |q, qdot, dt, mass, force, stiffness, solve| {
        let A = add_scaled(mass, -dt * dt, &stiffness(q, qdot));
        *qdot = solve(&A, &(mass * &*qdot + force(q, qdot) * dt));
        *q += &*qdot;
    }),
    wrong!(newtons_method, ["Hessian not evaluated anew"], |x0, f, g, H, solve, max_steps| {
        let fixed = H(x0);
        newton(x0, f, g, &|_| fixed.clone(), solve, max_steps, &Search::default())
    }),
    wrong!(newtons_method, ["gradient not evaluated anew"], |x0, f, g, H, solve, max_steps| {
        let at_start = g(x0);
        newton(x0, f, &|_| at_start.clone(), H, solve, max_steps, &Search::default())
    }),
    wrong!(newtons_method, ["line search begins at another step"], |x0, f, g, H, solve, max_steps| {
        newton(x0, f, g, H, solve, max_steps, &Search { first: 0.5, ..Search::default() })
    }),
    wrong!(newtons_method, ["other sufficient decrease"], |x0, f, g, H, solve, max_steps| {
        newton(x0, f, g, H, solve, max_steps, &Search { decrease: 0.5, ..Search::default() })
    }),
    wrong!(newtons_method, ["other factor of the line search"], |x0, f, g, H, solve, max_steps| {
        newton(x0, f, g, H, solve, max_steps, &Search { shorter: 0.9, ..Search::default() })
    }),
    wrong!(newtons_method, ["other factor of the line search"], |x0, f, g, H, solve, max_steps| {
        newton(x0, f, g, H, solve, max_steps, &Search { shorter: 0.1, ..Search::default() })
    }),
    wrong!(newtons_method, ["line search gives up too early"], |x0, f, g, H, solve, max_steps| {
        newton(x0, f, g, H, solve, max_steps, &Search { shortest: 0.1, ..Search::default() })
    }),
    wrong!(
        newtons_method,
        ["gradient for the direction and smallest step taken anyway"],
        |x0, f, g, _, _, max_steps| {
            for _ in 0..max_steps {
                let gradient = g(x0);
                let (f_x, slope) = (f(x0), -gradient.norm_squared());
                if slope == 0.0 {
                    break;
                }
                let mut alpha = 1.0;
                while alpha > 1e-8 && f(&(&*x0 - &gradient * alpha)) > f_x + 1e-8 * alpha * slope {
                    alpha *= 0.5;
                }
                *x0 -= &gradient * alpha;
            }
            f(x0)
        }
    ),
    wrong!(newtons_method, ["wrong in a limiting case"], |x0, f, g, H, solve, max_steps| {
        newton(x0, f, g, H, solve, max_steps, &Search { takes_the_last: true, ..Search::default() })
    }),
    wrong!(newtons_method, ["norm of the gradient returned"], |x0, f, g, H, solve, max_steps| {
        right!(newtons_method(x0, f, g, H, solve, max_steps));
        g(x0).norm()
    }),
    wrong!(implicit_euler, ["mass left out of the gradient"], |q, qdot, dt, mass, energy, force, stiffness, solve| {
        let old = qdot.clone();
        let g = |v: &DVector<f64>| (v - &old) - force(&(&*q + v * dt), v) * dt;
        let H = |v: &DVector<f64>| add_scaled(mass, -dt * dt, &stiffness(&(&*q + v * dt), v));
        right!(newtons_method(qdot, energy, &g, &H, solve, 5));
        q.axpy(dt, qdot, 1.0);
    }),
    wrong!(implicit_euler, ["mass left out of the Hessian"], |q, qdot, dt, mass, energy, force, stiffness, solve| {
        let old = qdot.clone();
        let g = |v: &DVector<f64>| mass * (v - &old) - force(&(&*q + v * dt), v) * dt;
        let H = |v: &DVector<f64>| stiffness(&(&*q + v * dt), v) * (-dt * dt);
        right!(newtons_method(qdot, energy, &g, &H, solve, 5));
        q.axpy(dt, qdot, 1.0);
    }),
    wrong!(
        implicit_euler,
        ["stiffness at the start of the step"],
        |q, qdot, dt, mass, energy, force, stiffness, solve| {
            let old = qdot.clone();
            let g = |v: &DVector<f64>| mass * (v - &old) - force(&(&*q + v * dt), v) * dt;
            let H = |v: &DVector<f64>| add_scaled(mass, -dt * dt, &stiffness(q, v));
            right!(newtons_method(qdot, energy, &g, &H, solve, 5));
            q.axpy(dt, qdot, 1.0);
        }
    ),
    wrong!(implicit_euler, ["stiffness left out"], |q, qdot, dt, mass, energy, force, stiffness, solve| {
        let old = qdot.clone();
        let g = |v: &DVector<f64>| mass * (v - &old) - force(&(&*q + v * dt), v) * dt;
        let H = |_: &DVector<f64>| mass.clone();
        let _ = stiffness;
        right!(newtons_method(qdot, energy, &g, &H, solve, 5));
        q.axpy(dt, qdot, 1.0);
    }),
    wrong!(implicit_euler, ["velocity not changed"], |q, qdot, dt, mass, energy, force, stiffness, solve| {
        let (mut moved, mut v) = (q.clone(), qdot.clone());
        right!(implicit_euler(&mut moved, &mut v, dt, mass, energy, force, stiffness, solve));
        *q = moved;
    }),
    wrong!(implicit_euler, ["mean velocity"], |q, qdot, dt, mass, energy, force, stiffness, solve| {
        let old = qdot.clone();
        let start = q.clone();
        right!(implicit_euler(q, qdot, dt, mass, energy, force, stiffness, solve));
        *q = start + (old + &*qdot) * (0.5 * dt);
    }),
    wrong!(implicit_euler, ["force with the wrong sign"], |q, qdot, dt, mass, energy, force, stiffness, solve| {
        let old = qdot.clone();
        let g = |v: &DVector<f64>| mass * (v - &old) + force(&(&*q + v * dt), v) * dt;
        let H = |v: &DVector<f64>| add_scaled(mass, -dt * dt, &stiffness(&(&*q + v * dt), v));
        right!(newtons_method(qdot, energy, &g, &H, solve, 5));
        q.axpy(dt, qdot, 1.0);
    }),
    wrong!(
        implicit_euler,
        ["evaluated without dt in its point"],
        |q, qdot, dt, mass, energy, force, stiffness, solve| {
            let old = qdot.clone();
            let g = |v: &DVector<f64>| mass * (v - &old) - force(&(&*q + v), v) * dt;
            let H = |v: &DVector<f64>| add_scaled(mass, -dt * dt, &stiffness(&(&*q + v), v));
            right!(newtons_method(qdot, energy, &g, &H, solve, 5));
            q.axpy(dt, qdot, 1.0);
        }
    ),
    wrong!(implicit_euler, ["missing backtracking"], |q, qdot, dt, mass, energy, force, stiffness, solve| {
        let old = qdot.clone();
        let g = |v: &DVector<f64>| mass * (v - &old) - force(&(&*q + v * dt), v) * dt;
        let H = |v: &DVector<f64>| add_scaled(mass, -dt * dt, &stiffness(&(&*q + v * dt), v));
        for _ in 0..5 {
            let d = solve(&H(qdot), &-g(qdot));
            *qdot += d;
        }
        let _ = energy;
        q.axpy(dt, qdot, 1.0);
    }),
];

/// Numbers in a line search.
struct Search {
    first: f64,
    shorter: f64,
    shortest: f64,
    decrease: f64,
    takes_the_last: bool,
}

impl Default for Search {
    fn default() -> Self {
        Self { first: 1.0, shorter: 0.5, shortest: 1e-8, decrease: 1e-8, takes_the_last: false }
    }
}

fn newton(
    x0: &mut DVector<f64>,
    f: Objective,
    g: Gradient,
    H: Hessian,
    solve: Solve,
    max_steps: usize,
    search: &Search,
) -> f64 {
    let at_start = g(x0).norm();
    for _ in 0..max_steps {
        let gradient = g(x0);
        if gradient.norm() <= 1e-10 * at_start {
            break;
        }
        let A: CsrMatrix<f64> = H(x0);
        let direction = solve(&A, &-&gradient);
        let (f_x, slope) = (f(x0), gradient.dot(&direction));
        let mut alpha = search.first;
        let good = |alpha: f64| {
            let trial = f(&(&*x0 + &direction * alpha));
            trial.is_finite() && trial <= f_x + search.decrease * alpha * slope
        };
        while alpha >= search.shortest && !good(alpha) {
            alpha *= search.shorter;
        }
        if alpha < search.shortest && !search.takes_the_last {
            break;
        }
        x0.axpy(alpha, &direction, 1.0);
    }
    f(x0)
}

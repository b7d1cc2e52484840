//! Mistakes in `implicit_euler`.

use std::cell::RefCell;

use finite_elements_3d::given::add_scaled;
use grader_child::{Force, Objective, Solve, Stiffness};
use nalgebra::DVector;
use nalgebra_sparse::CsrMatrix;

use super::Variant;
use crate::reference::REFERENCE;

/// The mistakes that are known.
pub const VARIANTS: &[Variant] = &[
    variant!(
        implicit_euler,
        "old velocity",
        "The velocity is right, the positions are not: with which velocity do they move?",
        |q, qdot, dt, mass, energy, force, stiffness, solve| {
            let moved = &*q + &*qdot * dt;
            (REFERENCE.implicit_euler)(q, qdot, dt, mass, energy, force, stiffness, solve);
            *q = moved;
        }
    ),
    variant!(
        implicit_euler,
        "evaluated at the wrong point",
        "Force and stiffness belong to the end of the step: where does a trial velocity take the body?",
        |q, qdot, dt, mass, energy, force, stiffness, solve| {
            let start = q.clone();
            let (at_start, K) = (|_: &_, v: &_| force(&start, v), |_: &_, v: &_| stiffness(&start, v));
            (REFERENCE.implicit_euler)(q, qdot, dt, mass, energy, &at_start, &K, solve)
        }
    ),
    variant!(
        implicit_euler,
        "scaled by dt",
        "The gradient does not fit the energy: differentiate with respect to v, and compare with finite differences.",
        |q, qdot, dt, mass, energy, force, stiffness, solve| {
            (REFERENCE.implicit_euler)(q, qdot, dt, mass, energy, &|q, v| force(q, v) * dt, stiffness, solve)
        }
    ),
    variant!(
        implicit_euler,
        "missing dt",
        "The gradient does not fit the energy: positions depend on v through the time step.",
        |q, qdot, dt, mass, energy, force, stiffness, solve| {
            (REFERENCE.implicit_euler)(q, qdot, dt, mass, energy, &|q, v| force(q, v) / dt, stiffness, solve)
        }
    ),
    variant!(
        implicit_euler,
        "dt for dt²",
        "The Hessian does not fit the gradient, so Newton's method crawls. Look at the units of its two terms.",
        |q, qdot, dt, mass, energy, force, stiffness, solve| {
            (REFERENCE.implicit_euler)(q, qdot, dt, mass, energy, force, &|q, v| stiffness(q, v) / dt, solve)
        }
    ),
    variant!(
        implicit_euler,
        "stiffness with the wrong sign",
        "The Hessian does not fit the gradient: the stiffness is the derivative of the force here.",
        |q, qdot, dt, mass, energy, force, stiffness, solve| {
            (REFERENCE.implicit_euler)(q, qdot, dt, mass, energy, force, &|q, v| stiffness(q, v) * -1.0, solve)
        }
    ),
    variant!(
        implicit_euler,
        "missing term",
        "The change of momentum is missing from the gradient: which momentum does the body have from the step before?",
        |q, qdot, dt, mass, energy, force, stiffness, solve| {
            let momentum = mass * &*qdot;
            let without = |q: &_, v: &_| force(q, v) - &momentum / dt;
            (REFERENCE.implicit_euler)(q, qdot, dt, mass, energy, &without, stiffness, solve)
        }
    ),
    variant!(
        implicit_euler,
        "inertia added twice",
        "The energy that is handed in holds the inertia already.",
        |q, qdot, dt, mass, energy, force, stiffness, solve| {
            let old = qdot.clone();
            let twice = |v: &DVector<f64>| energy(v) + inertia(mass, &(v - &old));
            let gradient = |q: &_, v: &DVector<f64>| force(q, v) - mass * (v - &old) / dt;
            let hessian = |q: &_, v: &_| add_scaled(&stiffness(q, v), -1.0 / (dt * dt), mass);
            (REFERENCE.implicit_euler)(q, qdot, dt, mass, &twice, &gradient, &hessian, solve)
        }
    ),
    variant!(
        implicit_euler,
        "changes the old velocity",
        "The velocity at the start of the step is needed until the step is done. Does Newton's method overwrite it?",
        |q, qdot, dt, mass, energy, force, stiffness, solve| {
            let (old, start) = (RefCell::new(qdot.clone()), q.clone());
            let g = |v: &DVector<f64>| {
                let last = old.replace(v.clone());
                mass * (v - last) - force(&(&start + v * dt), v) * dt
            };
            let H = |v: &DVector<f64>| add_scaled(mass, -dt * dt, &stiffness(&(&start + v * dt), v));
            (REFERENCE.newtons_method)(qdot, energy, &g, &H, solve, 5);
            q.axpy(dt, qdot, 1.0);
        }
    ),
    variant!(
        implicit_euler,
        "one step only",
        "One direction is not enough for a force that is not linear: the equations do not hold at the end of the step.",
        |q, qdot, dt, mass, energy, force, stiffness, solve| {
            steps(1, q, qdot, dt, mass, energy, force, stiffness, solve)
        }
    ),
    variant!(
        implicit_euler,
        "too many steps",
        "Count the directions: the page says how many there may be in one time step.",
        |q, qdot, dt, mass, energy, force, stiffness, solve| {
            steps(50, q, qdot, dt, mass, energy, force, stiffness, solve)
        }
    ),
    variant!(
        implicit_euler,
        "arguments exchanged",
        "The closures take positions first and velocities second.",
        |q, qdot, dt, mass, energy, force, stiffness, solve| {
            (REFERENCE.implicit_euler)(q, qdot, dt, mass, energy, &|q, v| force(v, q), &|q, v| stiffness(v, q), solve)
        }
    ),
];

fn inertia(mass: &CsrMatrix<f64>, change: &DVector<f64>) -> f64 {
    0.5 * change.dot(&(mass * change))
}

/// The step with another number of Newton's steps in it.
#[allow(clippy::too_many_arguments)] // the course's signature and one more
fn steps(
    max_steps: usize,
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
    (REFERENCE.newtons_method)(qdot, energy, &g, &H, solve, max_steps);
    q.axpy(dt, qdot, 1.0);
}

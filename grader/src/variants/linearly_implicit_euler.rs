//! Mistakes in `linearly_implicit_euler`.

use finite_elements_3d::given;
use grader_child::{Force, Solve, Stiffness};
use nalgebra::DVector;
use nalgebra_sparse::CsrMatrix;

use super::Variant;
use crate::reference::REFERENCE;

/// The mistakes that are known.
pub const VARIANTS: &[Variant] = &[
    variant!(
        linearly_implicit_euler,
        "old velocity",
        "The velocity is right, the positions are not: with which velocity do they move?",
        |q, qdot, dt, mass, force, stiffness, solve| {
            let with_old = moved(q, qdot, dt);
            step(q, qdot, dt, mass, force, stiffness, solve);
            *q = with_old;
        }
    ),
    variant!(
        linearly_implicit_euler,
        "stiffness with the wrong sign",
        "The stiffness is the derivative of the force here, negative for a stiff body. The system's matrix must become stiffer by it.",
        |q, qdot, dt, mass, force, stiffness, solve| {
            step(q, qdot, dt, mass, force, &|q, v| stiffness(q, v) * -1.0, solve)
        }
    ),
    variant!(
        linearly_implicit_euler,
        "dt for dt²",
        "Look at the units in the system's matrix: each term must be a mass.",
        |q, qdot, dt, mass, force, stiffness, solve| {
            step(q, qdot, dt, mass, force, &|q, v| stiffness(q, v) / dt, solve)
        }
    ),
    variant!(
        linearly_implicit_euler,
        "missing dt",
        "Look at the units on the right-hand side: a force times a duration is a momentum.",
        |q, qdot, dt, mass, force, stiffness, solve| step(
            q,
            qdot,
            dt,
            mass,
            &|q, v| force(q, v) / dt,
            stiffness,
            solve
        )
    ),
    variant!(
        linearly_implicit_euler,
        "scaled by dt",
        "Look at the units on the right-hand side: the force counts too little in a short step.",
        |q, qdot, dt, mass, force, stiffness, solve| step(
            q,
            qdot,
            dt,
            mass,
            &|q, v| force(q, v) * dt,
            stiffness,
            solve
        )
    ),
    variant!(
        linearly_implicit_euler,
        "missing term",
        "Each step starts from rest: which momentum does the body have from the step before?",
        |q, qdot, dt, mass, force, stiffness, solve| {
            let momentum = mass * &*qdot;
            step(q, qdot, dt, mass, &|q, v| force(q, v) - &momentum / dt, stiffness, solve)
        }
    ),
    variant!(
        linearly_implicit_euler,
        "evaluated at the wrong point",
        "Force and stiffness belong to the state at the start of the step.",
        |q, qdot, dt, mass, force, stiffness, solve| {
            let (on, ahead) =
                (|q: &_, v: &_| force(&moved(q, v, dt), v), |q: &_, v: &_| stiffness(&moved(q, v, dt), v));
            step(q, qdot, dt, mass, &on, &ahead, solve)
        }
    ),
    variant!(
        linearly_implicit_euler,
        "arguments exchanged",
        "The closures take positions first and velocities second.",
        |q, qdot, dt, mass, force, stiffness, solve| {
            step(q, qdot, dt, mass, &|q, v| force(v, q), &|q, v| stiffness(v, q), solve)
        }
    ),
    variant!(
        linearly_implicit_euler,
        "stiffness left out",
        "The stiffness has no effect: this step is explicit, and stiff springs blow it up.",
        |q, qdot, dt, mass, force, stiffness, solve| {
            step(q, qdot, dt, mass, force, &|q, v| stiffness(q, v) * 0.0, solve)
        }
    ),
    variant!(
        linearly_implicit_euler,
        "own solver",
        "Solve with the closure that is handed in, not with another solver.",
        |q, qdot, dt, mass, force, stiffness, _| step(q, qdot, dt, mass, force, stiffness, &given::solve)
    ),
];

fn moved(q: &DVector<f64>, v: &DVector<f64>, dt: f64) -> DVector<f64> {
    q + v * dt
}

/// The right step; the mistakes are in its arguments.
fn step(
    q: &mut DVector<f64>,
    qdot: &mut DVector<f64>,
    dt: f64,
    mass: &CsrMatrix<f64>,
    force: Force,
    stiffness: Stiffness,
    solve: Solve,
) {
    (REFERENCE.linearly_implicit_euler)(q, qdot, dt, mass, force, stiffness, solve)
}

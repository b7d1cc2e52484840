//! A step of linearly implicit Euler: A x = b, then velocity and positions from x.

use nalgebra::{DMatrix, DVector};
use nalgebra_sparse::CsrMatrix;

use crate::diagnosis::switches::Switch;
use crate::reference::systems::solve;
use crate::reference::trial::{Input, Observed, Trial};

type Vector = DVector<f64>;
type Matrix = DMatrix<f64>;

/// The parts of a step.
#[derive(Clone, Copy)]
pub struct Settings {
    mass_in_matrix: fn(&Matrix, f64) -> Matrix,
    stiffness_factor: fn(f64) -> f64,
    momentum: fn(&Matrix, &Vector, f64) -> Vector,
    force_factor: fn(f64) -> f64,
    /// The state at which force and stiffness are evaluated, from q, v and dt.
    force_at: fn(&Vector, &Vector, f64) -> (Vector, Vector),
    stiffness_at: fn(&Vector, &Vector, f64) -> Vector,
    /// The new velocity, from the solution and the old one.
    velocity: fn(&Vector, &Vector, f64) -> Vector,
    /// The term that is added to the right-hand side, from the stiffness.
    more: fn(&Matrix, &Vector, f64) -> Vector,
    /// The velocity that is left at the end, from the new and the old one.
    left: fn(&Vector, &Vector) -> Vector,
    /// The new positions, from the old ones, the old velocity and the new one.
    positions: fn(&Vector, &Vector, &Vector, f64) -> Vector,
}

/// The step of the course.
pub const RIGHT: Settings = Settings {
    mass_in_matrix: |M, _| M.clone(),
    stiffness_factor: |dt| -dt * dt,
    momentum: |M, v, _| M * v,
    force_factor: |dt| dt,
    force_at: |q, v, _| (q.clone(), v.clone()),
    stiffness_at: |q, _, _| q.clone(),
    velocity: |x, _, _| x.clone(),
    more: |_, v, _| v * 0.0,
    left: |new, _| new.clone(),
    positions: |q, _, new, dt| q + new * dt,
};

const UNITS_OF_MATRIX: &str = "Look at the units in the system's matrix: each of its terms must be a mass.";
const UNITS_OF_RIGHT: &str = "Look at the units on the right-hand side: each of its terms must be a momentum.";
const OLD_STATE: &str = "Force and stiffness belong to the state at the start of the step.";
const POSITIONS: &str = "The velocity is right and the positions are not: how far does a body move in one step?";
const WRITTEN: &str = "The positions move, and the velocity stays that at the start. What else does a step change?";
const SOLUTION: &str = "The system of equations and the use of its solution do not fit: is it solved for a velocity, for its change, or for an acceleration?";

/// The mistakes.
pub const SWITCHES: &[Switch<Settings>] = &[
    ("mass left out of the matrix", UNITS_OF_MATRIX, |s| s.mass_in_matrix = |M, _| M * 0.0),
    ("identity for the mass in the matrix", UNITS_OF_MATRIX, |s| {
        s.mass_in_matrix = |M, _| Matrix::identity(M.nrows(), M.nrows());
    }),
    ("mass divided by dt in the matrix", UNITS_OF_MATRIX, |s| s.mass_in_matrix = |M, dt| M / dt),
    ("mass times dt in the matrix", UNITS_OF_MATRIX, |s| s.mass_in_matrix = |M, dt| M * dt),
    (
        "mass with the wrong sign in the matrix",
        "Mass resists a change of velocity: look at its sign in the system's matrix.",
        |s| {
            s.mass_in_matrix = |M, _| -M;
        },
    ),
    (
        "only the diagonal of the mass",
        "The mass matrix has entries off its diagonal, and the system's matrix needs them.",
        |s| {
            s.mass_in_matrix = |M, _| Matrix::from_diagonal(&M.diagonal());
        },
    ),
    (
        "stiffness with the wrong sign",
        "The stiffness is the derivative of the force here: the system's matrix must become stiffer by it.",
        |s| {
            s.stiffness_factor = |dt| dt * dt;
        },
    ),
    ("dt for dt²", UNITS_OF_MATRIX, |s| s.stiffness_factor = |dt| -dt),
    ("dt for dt² and stiffness with the wrong sign", UNITS_OF_MATRIX, |s| s.stiffness_factor = |dt| dt),
    ("stiffness without dt", UNITS_OF_MATRIX, |s| s.stiffness_factor = |_| -1.0),
    ("stiffness without dt and with the wrong sign", UNITS_OF_MATRIX, |s| s.stiffness_factor = |_| 1.0),
    (
        "half of the stiffness",
        "The stiffness enters with half of its weight: is this step the trapezoidal rule?",
        |s| {
            s.stiffness_factor = |dt| -0.5 * dt * dt;
        },
    ),
    ("quarter of the stiffness", "The stiffness enters with a quarter of its weight.", |s| {
        s.stiffness_factor = |dt| -0.25 * dt * dt
    }),
    ("stiffness left out", "The stiffness has no effect: this step is explicit, and stiff springs blow it up.", |s| {
        s.stiffness_factor = |_| 0.0
    }),
    ("missing term", "Each step starts from rest: which momentum does the body have from the step before?", |s| {
        s.momentum = |_, v, _| v * 0.0
    }),
    ("mass left out of the momentum", UNITS_OF_RIGHT, |s| s.momentum = |_, v, _| v.clone()),
    ("momentum times dt", UNITS_OF_RIGHT, |s| s.momentum = |M, v, dt| M * v * dt),
    ("momentum divided by dt", UNITS_OF_RIGHT, |s| s.momentum = |M, v, dt| M * v / dt),
    ("momentum with the wrong sign", "Without any force a body keeps its velocity: does it in your step?", |s| {
        s.momentum = |M, v, _| -(M * v)
    }),
    ("missing dt", UNITS_OF_RIGHT, |s| s.force_factor = |_| 1.0),
    ("scaled by dt", UNITS_OF_RIGHT, |s| s.force_factor = |dt| dt * dt),
    ("half of the force", "The force enters with half of its weight.", |s| s.force_factor = |dt| 0.5 * dt),
    (
        "force with the wrong sign",
        "The force acts the wrong way: is f the gradient of the energy or its opposite?",
        |s| s.force_factor = |dt| -dt,
    ),
    ("force left out", "The force has no effect: a body at rest stays at rest under any load.", |s| {
        s.force_factor = |_| 0.0
    }),
    ("force at the wrong point", OLD_STATE, |s| s.force_at = |q, v, dt| (q + v * dt, v.clone())),
    ("stiffness at the wrong point", OLD_STATE, |s| s.stiffness_at = |q, v, dt| q + v * dt),
    ("evaluated at the wrong point", OLD_STATE, |s| {
        s.force_at = |q, v, dt| (q + v * dt, v.clone());
        s.stiffness_at = |q, v, dt| q + v * dt;
    }),
    ("damping left out", "The force is not asked for at the present velocity. Which two vectors does it take?", |s| {
        s.force_at = |q, v, _| (q.clone(), v * 0.0);
    }),
    ("positions for velocities", "The force takes positions first and velocities second.", |s| {
        s.force_at = |q, _, _| (q.clone(), q.clone())
    }),
    ("arguments exchanged", "The closures take positions first and velocities second.", |s| {
        s.force_at = |q, v, _| (v.clone(), q.clone());
        s.stiffness_at = |_, v, _| v.clone();
    }),
    ("arguments of the force exchanged", "The closures take positions first and velocities second.", |s| {
        s.force_at = |q, v, _| (v.clone(), q.clone());
    }),
    ("arguments of the stiffness exchanged", "The closures take positions first and velocities second.", |s| {
        s.stiffness_at = |_, v, _| v.clone()
    }),
    ("stiffness left out of the change of velocity", SOLUTION, |s| {
        s.momentum = |_, v, _| v * 0.0;
        s.velocity = |x, v, _| v + x;
    }),
    ("solution added to the velocity", SOLUTION, |s| s.velocity = |x, v, _| v + x),
    ("solution taken for an acceleration", SOLUTION, |s| s.velocity = |x, v, dt| v + x * dt),
    ("velocity times dt", SOLUTION, |s| s.velocity = |x, _, dt| x * dt),
    ("velocity not written back", WRITTEN, |s| s.left = |_, old| old.clone()),
    ("stiffness without dt in the change of velocity", SOLUTION, |s| {
        s.momentum = |_, v, _| v * 0.0;
        s.velocity = |x, v, _| v + x;
        s.more = |K, v, dt| K * v * dt;
    }),
    ("wrong sign in the change of velocity", SOLUTION, |s| {
        s.momentum = |_, v, _| v * 0.0;
        s.velocity = |x, v, _| v + x;
        s.more = |K, v, dt| K * v * (-dt * dt);
    }),
    ("velocity not changed", "The velocity at the end is that at the start. What else does a step change?", |s| {
        s.velocity = |_, v, _| v.clone()
    }),
    ("old velocity", POSITIONS, |s| s.positions = |q, old, _, dt| q + old * dt),
    ("mean velocity", POSITIONS, |s| s.positions = |q, old, new, dt| q + (old + new) * (0.5 * dt)),
    ("both velocities", POSITIONS, |s| s.positions = |q, old, new, dt| q + (old + new) * dt),
    ("positions moved without dt", POSITIONS, |s| s.positions = |q, _, new, _| q + new),
    ("positions moved by dt²", POSITIONS, |s| s.positions = |q, _, new, dt| q + new * (dt * dt)),
    ("positions moved half way", POSITIONS, |s| s.positions = |q, _, new, dt| q + new * (0.5 * dt)),
    ("positions moved twice", POSITIONS, |s| s.positions = |q, _, new, dt| q + new * (2.0 * dt)),
    ("positions moved backwards", POSITIONS, |s| s.positions = |q, _, new, dt| q - new * dt),
    ("positions moved by the change of velocity", POSITIONS, |s| s.positions = |q, old, new, dt| q + (new - old) * dt),
    ("positions not moved", "The positions are those at the start of the step. What else does a step change?", |s| {
        s.positions = |q, _, _, _| q.clone();
    }),
    ("positions not added to", POSITIONS, |s| s.positions = |_, _, new, dt| new * dt),
    (
        "positions moved first",
        "The positions are moved before the velocity is known. In which order does the method update the two?",
        |s| {
            s.force_at = |q, v, dt| (q + v * dt, v.clone());
            s.stiffness_at = |q, v, dt| q + v * dt;
            s.positions = |q, old, _, dt| q + old * dt;
        },
    ),
];

/// The step with these settings.
pub fn run(settings: &Settings, trial: &Trial) -> Option<Observed> {
    let Input::Step(step) = &trial.input else { return None };
    let (system, q, v, dt) = (&step.system, &step.q, &step.qdot, step.dt);
    let (at, velocity) = (settings.force_at)(q, v, dt);
    let K = DMatrix::from(&system.stiffness(&(settings.stiffness_at)(q, v, dt)));
    let more = (settings.more)(&K, v, dt);
    let A = (settings.mass_in_matrix)(&system.mass, dt) + K * (settings.stiffness_factor)(dt);
    let b =
        more + (settings.momentum)(&system.mass, v, dt) + system.force(&at, &velocity) * (settings.force_factor)(dt);
    let new = (settings.velocity)(&solve(&CsrMatrix::from(&A), &b), v, dt);
    let positions = (settings.positions)(q, v, &new, dt);
    let left = (settings.left)(&new, v);
    Some(Observed::vector(positions.iter().chain(&left).copied().collect()))
}

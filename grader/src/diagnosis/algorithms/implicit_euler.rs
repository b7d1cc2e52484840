//! A step of implicit Euler: Newton's method on the velocity at its end.

use std::cell::Cell;

use nalgebra::{DMatrix, DVector};

use super::newton::{self, Problem, minimise};
use crate::diagnosis::switches::Switch;
use crate::reference::trial::{Input, Observed, Trial};

type Vector = DVector<f64>;
type Matrix = DMatrix<f64>;

/// The parts of a step.
#[derive(Clone, Copy)]
pub struct Settings {
    newton: newton::Settings,
    gradient_mass: fn(&Matrix) -> Matrix,
    /// The velocity that the trial velocity is compared with.
    from: fn(&Vector) -> Vector,
    force_factor: fn(f64) -> f64,
    /// The state at which force and stiffness are evaluated, from q, the trial velocity, the old one and dt.
    force_at: fn(&Vector, &Vector, &Vector, f64) -> Vector,
    hessian_mass: fn(&Matrix) -> Matrix,
    stiffness_factor: fn(f64) -> f64,
    stiffness_at: fn(&Vector, &Vector, &Vector, f64) -> Vector,
    /// Value of the line search, from the energy handed in, the inertia and a length of the gradient.
    energy: fn(f64, f64) -> f64,
    start: fn(&Vector) -> Vector,
    velocity: fn(&Vector, &Vector, f64) -> Vector,
    positions: fn(&Vector, &Vector, &Vector, f64) -> Vector,
}

/// The step of the course.
pub const RIGHT: Settings = Settings {
    newton: newton::RIGHT,
    gradient_mass: Clone::clone,
    from: Clone::clone,
    force_factor: |dt| dt,
    force_at: |q, v, _, dt| q + v * dt,
    hessian_mass: Clone::clone,
    stiffness_factor: |dt| -dt * dt,
    stiffness_at: |q, v, _, dt| q + v * dt,
    energy: |given, _| given,
    start: Clone::clone,
    velocity: |_, new, _| new.clone(),
    positions: |q, _, new, dt| q + new * dt,
};

const GRADIENT: &str =
    "The gradient does not fit the energy: differentiate with respect to v, and compare with finite differences.";
const HESSIAN: &str =
    "The Hessian does not fit the gradient, so Newton's method crawls. Look at the units of its two terms.";
const AHEAD: &str = "Force and stiffness belong to the end of the step: where does a trial velocity take the body?";
const LINEAR: &str =
    "This is a step of linearly implicit Euler: one direction from the state at the start, without Newton's method.";
const POSITIONS: &str = "The velocity is right and the positions are not: how far does a body move in one step?";
const ENERGY: &str =
    "The line search compares the wrong values: what does the energy that is handed in contain already?";

/// The mistakes.
pub const SWITCHES: &[Switch<Settings>] = &[
    ("mass left out of the gradient", GRADIENT, |s| s.gradient_mass = |M| Matrix::identity(M.nrows(), M.nrows())),
    ("inertia left out of the gradient", GRADIENT, |s| s.gradient_mass = |M| M * 0.0),
    (
        "missing term",
        "The change of momentum is missing from the gradient: which momentum does the body have from the step before?",
        |s| {
            s.from = |old| old * 0.0;
        },
    ),
    ("sum of the velocities in the gradient", GRADIENT, |s| s.from = |old| -old),
    ("missing dt", GRADIENT, |s| s.force_factor = |_| 1.0),
    ("scaled by dt", GRADIENT, |s| s.force_factor = |dt| dt * dt),
    ("force with the wrong sign", GRADIENT, |s| s.force_factor = |dt| -dt),
    ("force left out", GRADIENT, |s| s.force_factor = |_| 0.0),
    ("force at the start of the step", AHEAD, |s| s.force_at = |q, _, _, _| q.clone()),
    ("force where the old velocity leads", AHEAD, |s| s.force_at = |q, _, old, dt| q + old * dt),
    ("force without dt in its point", AHEAD, |s| s.force_at = |q, v, _, _| q + v),
    ("stiffness without dt in its point", AHEAD, |s| s.stiffness_at = |q, v, _, _| q + v),
    ("evaluated without dt in its point", AHEAD, |s| {
        s.force_at = |q, v, _, _| q + v;
        s.stiffness_at = |q, v, _, _| q + v
    }),
    ("evaluated at the wrong point", AHEAD, |s| {
        s.force_at = |q, _, _, _| q.clone();
        s.stiffness_at = |q, _, _, _| q.clone();
    }),
    ("velocity for the positions", AHEAD, |s| {
        s.force_at = |_, v, _, _| v.clone();
        s.stiffness_at = |_, v, _, _| v.clone()
    }),
    ("evaluated half a step ahead", AHEAD, |s| {
        s.force_at = |q, v, _, dt| q + v * (0.5 * dt);
        s.stiffness_at = |q, v, _, dt| q + v * (0.5 * dt);
    }),
    ("stiffness at the start of the step", AHEAD, |s| s.stiffness_at = |q, _, _, _| q.clone()),
    ("stiffness where the old velocity leads", AHEAD, |s| s.stiffness_at = |q, _, old, dt| q + old * dt),
    ("mass left out of the Hessian", HESSIAN, |s| s.hessian_mass = |M| M * 0.0),
    ("identity for the mass in the Hessian", HESSIAN, |s| s.hessian_mass = |M| Matrix::identity(M.nrows(), M.nrows())),
    ("only the diagonal of the mass", HESSIAN, |s| s.hessian_mass = |M| Matrix::from_diagonal(&M.diagonal())),
    ("dt for dt²", HESSIAN, |s| s.stiffness_factor = |dt| -dt),
    ("stiffness without dt", HESSIAN, |s| s.stiffness_factor = |_| -1.0),
    (
        "stiffness with the wrong sign",
        "The Hessian does not fit the gradient: the stiffness is the derivative of the force here.",
        |s| {
            s.stiffness_factor = |dt| dt * dt;
        },
    ),
    ("dt for dt² and stiffness with the wrong sign", HESSIAN, |s| s.stiffness_factor = |dt| dt),
    ("half of the stiffness", HESSIAN, |s| s.stiffness_factor = |dt| -0.5 * dt * dt),
    ("stiffness left out", HESSIAN, |s| s.stiffness_factor = |_| 0.0),
    ("inertia added twice", "The energy that is handed in holds the inertia already.", |s| {
        s.energy = |given, inertia| given + inertia;
    }),
    ("inertia taken out of the energy", ENERGY, |s| s.energy = |given, inertia| given - inertia),
    ("energy with the wrong sign", ENERGY, |s| s.energy = |given, _| -given),
    ("energy not used", "Newton's method needs the energy for its line search.", |s| s.energy = |_, _| 0.0),
    ("missing backtracking", "A full step can overshoot: Newton's method needs the energy for its line search.", |s| {
        newton::without_search(&mut s.newton);
    }),
    (
        "Hessian not evaluated anew",
        "The first direction is right, the later ones are not: what must be computed anew at each velocity?",
        |s| {
            s.newton.anew[2] = false;
        },
    ),
    ("start from rest", "Newton's method is to start from the old velocity.", |s| s.start = |old| old * 0.0),
    (
        "one step only",
        "One direction is not enough for a force that is not linear: the equations do not hold at the end of the step.",
        |s| {
            s.newton.most = |_| 1;
        },
    ),
    ("linearly implicit", LINEAR, |s| {
        s.newton.most = |_| 1;
        newton::without_search(&mut s.newton);
        s.force_at = |q, _, _, _| q.clone();
        s.stiffness_at = |q, _, _, _| q.clone();
    }),
    ("too few steps", "Count the directions: the page says how many there may be in one time step.", |s| {
        s.newton.most = |_| 2
    }),
    ("too few steps", "Count the directions: the page says how many there may be in one time step.", |s| {
        s.newton.most = |_| 3
    }),
    ("too few steps", "Count the directions: the page says how many there may be in one time step.", |s| {
        s.newton.most = |_| 4
    }),
    ("no step", "Newton's method takes no direction at all: how many may it take in one time step?", |s| {
        s.newton.most = |_| 0
    }),
    ("velocity not changed", "The velocity at the end is that at the start. What else does a step change?", |s| {
        s.velocity = |old, _, _| old.clone()
    }),
    ("change of velocity left", "What Newton's method finds is the velocity itself, not its change.", |s| {
        s.velocity = |old, new, _| new - old
    }),
    ("velocity added twice", "What Newton's method finds is the velocity itself, not its change.", |s| {
        s.velocity = |old, new, _| old + new
    }),
    ("velocity times dt", "The velocity at the end has the wrong unit.", |s| s.velocity = |_, new, dt| new * dt),
    ("old velocity", "The velocity is right, the positions are not: with which velocity do they move?", |s| {
        s.positions = |q, old, _, dt| q + old * dt
    }),
    ("both velocities", POSITIONS, |s| s.positions = |q, old, new, dt| q + (old + new) * dt),
    ("mean velocity", POSITIONS, |s| s.positions = |q, old, new, dt| q + (old + new) * (0.5 * dt)),
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
];

/// The step with these settings.
pub fn run(s: &Settings, trial: &Trial) -> Option<Observed> {
    let Input::Step(step) = &trial.input else { return None };
    let (system, q, old, dt) = (&step.system, &step.q, &step.qdot, step.dt);
    let inertia = |v: &Vector| 0.5 * (v - old).dot(&(&system.mass * (v - old)));
    let (mass, from) = ((s.gradient_mass)(&system.mass), (s.from)(old));
    let hessian_mass = (s.hessian_mass)(&system.mass);
    let problem = Problem {
        value: &|v| (s.energy)(inertia(v) + system.potential(&(q + v * dt)), inertia(v)),
        gradient: &|v| &mass * (v - &from) - system.force(&(s.force_at)(q, v, old, dt), v) * (s.force_factor)(dt),
        hessian: &|v| {
            let K = DMatrix::from(&system.stiffness(&(s.stiffness_at)(q, v, old, dt)));
            &hessian_mass + K * (s.stiffness_factor)(dt)
        },
        solves: Cell::default(),
    };
    let mut v = (s.start)(old);
    minimise(&s.newton, &problem, &mut v, 5);
    let positions = (s.positions)(q, old, &v, dt);
    let velocity = (s.velocity)(old, &v, dt);
    let calls = vec![("solve", problem.solves.get())];
    Some(Observed { calls, ..Observed::vector(positions.iter().chain(&velocity).copied().collect()) })
}

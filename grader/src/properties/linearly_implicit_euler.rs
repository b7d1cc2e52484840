//! To do: one step of linearly implicit Euler. Read include-docs/linearly_implicit_euler.md.

use std::cell::{Cell, RefCell};

use nalgebra::{DMatrix, DVector, dmatrix, dvector};
use nalgebra_sparse::CsrMatrix;

use super::bodies::{FreeBody, by_elimination, sparse};
use super::outcome::{Outcome, holds, near, near_number};
use super::random::for_some;
use super::{Check, Course};

/// The properties of the function.
pub const CHECKS: &[Check] = checks![
    a_spring_follows_the_exact_recurrence,
    coupled_unknowns_solve_the_system_of_the_page,
    force_stiffness_and_solve_are_called_once_each_at_the_old_state,
    mass_and_stiffness_may_have_entries_in_different_places,
    free_fall_is_the_sum_of_its_steps,
    a_free_body_keeps_its_momentum,
];

/// One step of a linear system with force(q, v) = `f` + K q + `B` v.
fn step(course: &Course, q: &mut DVector<f64>, v: &mut DVector<f64>, dt: f64, system: &System) -> Outcome {
    let n = q.len();
    let fits = Cell::new(true);
    let force = |q: &DVector<f64>, v: &DVector<f64>| {
        if (q.len(), v.len()) != (n, n) {
            fits.set(false);
            return DVector::from_element(n, f64::NAN);
        }
        &system.f + &system.K * q + &system.B * v
    };
    let stiffness = |_: &DVector<f64>, _: &DVector<f64>| sparse(&system.K);
    course.subject.linearly_implicit_euler(q, v, dt, &sparse(&system.M), &force, &stiffness, &by_elimination)?;
    holds("force and stiffness are called with vectors as long as q", fits.get())?;
    holds("q and qdot keep their lengths", (q.len(), v.len()) == (n, n))
}

struct System {
    M: DMatrix<f64>,
    K: DMatrix<f64>,
    B: DMatrix<f64>,
    f: DVector<f64>,
}

fn a_spring_follows_the_exact_recurrence(course: &Course) -> Outcome {
    for_some(course.seed, (0.1..10.0f64, 1.0..1e4f64, 1e-3..1.0f64), |(m, k, dt)| {
        let one = |number: f64| DMatrix::from_element(1, 1, number);
        let system = System { M: one(m), K: one(-k), B: one(0.0), f: dvector![0.0] };
        let (mut q, mut v) = (dvector![1.0], dvector![-0.5]);
        for _ in 0..20 {
            let expected_v = (m * v[0] - dt * k * q[0]) / (m + dt * dt * k);
            let expected_q = q[0] + dt * expected_v;
            step(course, &mut q, &mut v, dt, &system)?;
            near_number("v⁺ = (m v − dt k x) / (m + dt² k)", v[0], expected_v, 1e-12 * (k / m).sqrt())?;
            near_number("x⁺ = x + dt v⁺ (the new velocity)", q[0], expected_q, 1e-12)?;
        }
        Ok(())
    })
}

fn coupled_unknowns_solve_the_system_of_the_page(course: &Course) -> Outcome {
    let system = System {
        M: dmatrix![2.0, 0.3, 0.0; 0.3, 1.5, 0.1; 0.0, 0.1, 3.0],
        K: dmatrix![-5.0, 2.0, 1.0; 2.0, -7.0, 0.0; 1.0, 0.0, -4.0],
        B: dmatrix![-0.3, 0.0, 0.2; 0.0, -0.1, 0.0; 0.5, 0.0, -0.7],
        f: dvector![0.7, -0.4, 0.2],
    };
    let (q0, v0, dt) = (dvector![0.1, 0.5, -0.3], dvector![1.0, -2.0, 0.4], 0.3);
    let (mut q, mut v) = (q0.clone(), v0.clone());
    step(course, &mut q, &mut v, dt, &system)?;
    let residual = (&system.M - &system.K * (dt * dt)) * &v
        - &system.M * &v0
        - (&system.f + &system.K * &q0 + &system.B * &v0) * dt;
    let rule = "(M − dt² K) v⁺ = M v + dt f, with f at the old q and v";
    near(rule, &residual, &DVector::<f64>::zeros(3), 1e-13)?;
    near("q⁺ = q + dt v⁺", &q, &(q0 + v * dt), 1e-14)
}

fn force_stiffness_and_solve_are_called_once_each_at_the_old_state(course: &Course) -> Outcome {
    let (q0, v0) = (dvector![1.0, 2.0], dvector![3.0, -4.0]);
    let (mut q, mut v) = (q0.clone(), v0.clone());
    let M = sparse(&DMatrix::identity(2, 2));
    let (states, solves) = (RefCell::new(Vec::new()), Cell::new(0));
    let see = |name: &'static str, q: &DVector<f64>, v: &DVector<f64>| {
        states.borrow_mut().push((name, q.clone(), v.clone()));
    };
    let force = |q: &DVector<f64>, v: &DVector<f64>| {
        see("force", q, v);
        dvector![0.5, 0.25]
    };
    let stiffness = |q: &DVector<f64>, v: &DVector<f64>| {
        see("stiffness", q, v);
        sparse(&(DMatrix::identity(2, 2) * -2.0))
    };
    let solve = |A: &CsrMatrix<f64>, b: &DVector<f64>| {
        solves.set(solves.get() + 1);
        by_elimination(A, b)
    };
    course.subject.linearly_implicit_euler(&mut q, &mut v, 0.1, &M, &force, &stiffness, &solve)?;
    let mut names: Vec<_> = states.borrow().iter().map(|(name, ..)| *name).collect();
    names.sort_unstable();
    holds("one force and one stiffness in a step", names == ["force", "stiffness"])?;
    holds("one linear solve in a step", solves.get() == 1)?;
    for (_, q, v) in states.borrow().iter() {
        near("force and stiffness are evaluated at the old positions", q, &q0, 0.0)?;
        near("force and stiffness receive the old velocity", v, &v0, 0.0)?;
    }
    Ok(())
}

fn mass_and_stiffness_may_have_entries_in_different_places(course: &Course) -> Outcome {
    let system = System {
        M: DMatrix::identity(2, 2),
        K: dmatrix![0.0, 3.0; 3.0, 0.0],
        B: DMatrix::zeros(2, 2),
        f: dvector![4.0, 6.0],
    };
    let (mut q, mut v) = (dvector![0.0, 0.0], dvector![1.0, 2.0]);
    step(course, &mut q, &mut v, 0.5, &system)?;
    let A = dmatrix![1.0, -0.75; -0.75, 1.0];
    near("(M − dt² K) v⁺ = M v + dt f", &(A * &v), &dvector![3.0, 5.0], 1e-13)?;
    near("q⁺ = q + dt v⁺", &q, &(v * 0.5), 1e-14)
}

fn free_fall_is_the_sum_of_its_steps(course: &Course) -> Outcome {
    // x_n = x_0 + n dt v_0 + g dt² n (n + 1) / 2.
    let (g, m, dt, steps) = (-9.81, 3.0, 0.01, 400);
    let one = |number: f64| DMatrix::from_element(1, 1, number);
    let system = System { M: one(m), K: one(0.0), B: one(0.0), f: dvector![m * g] };
    let (mut q, mut v) = (dvector![5.0], dvector![2.0]);
    for _ in 0..steps {
        step(course, &mut q, &mut v, dt, &system)?;
    }
    let n = f64::from(steps);
    near_number("v_n = v_0 + n g dt", v[0], 2.0 + n * g * dt, 1e-10)?;
    near_number("x_n after free fall", q[0], 5.0 + n * dt * 2.0 + g * dt * dt * n * (n + 1.0) / 2.0, 1e-9)
}

fn a_free_body_keeps_its_momentum(course: &Course) -> Outcome {
    for size in [1.0, 1e-2, 1e-3] {
        let mut body = FreeBody::new(course, size)?;
        let before = body.momentum();
        for _ in 0..100 {
            body.linearly_implicit_step(0.01)?;
        }
        near("the momentum of a free body stays", &body.momentum(), &before, 1e-12 * before.norm())?;
    }
    Ok(())
}

//! To do: one step of implicit Euler by Newton's method. Read include-docs/implicit_euler.md.

use std::cell::{Cell, RefCell};

use nalgebra::{DMatrix, DVector, dmatrix, dvector};
use nalgebra_sparse::CsrMatrix;

use super::bodies::{FreeBody, by_elimination, sparse};
use super::outcome::{Mistake, Outcome, dense_of, holds, near, near_number};
use super::random::{for_some, vector};
use super::{Check, Course};

/// The properties of the function.
pub const CHECKS: &[Check] = checks![
    a_spring_follows_the_exact_recurrence,
    the_force_is_that_at_the_end_of_the_step,
    newton_starts_from_the_old_velocity_at_the_positions_it_leads_to,
    the_linear_systems_are_those_of_the_page,
    at_most_five_directions_are_followed,
    the_energy_is_evaluated_at_velocities,
    free_fall_is_the_sum_of_its_steps,
    a_body_at_rest_stays_without_a_solve,
    a_step_that_would_go_through_a_wall_stays_before_it,
    a_step_of_an_elastic_body_minimises_its_energy,
    a_free_body_keeps_its_momentum,
];

/// A potential, its force and its stiffness (the derivative of the force), as functions of positions.
struct Potential {
    V: fn(&DVector<f64>) -> f64,
    f: fn(&DVector<f64>) -> DVector<f64>,
    K: fn(&DVector<f64>) -> DMatrix<f64>,
}

/// The calls of a step's closures. Vectors of another length than q's are counted and not kept.
#[derive(Default)]
struct Asked {
    energies: RefCell<Vec<DVector<f64>>>,
    forces: RefCell<Vec<(DVector<f64>, DVector<f64>)>>,
    stiffnesses: RefCell<Vec<(DVector<f64>, DVector<f64>)>>,
    systems: RefCell<Vec<Solved>>,
    misfits: Cell<usize>,
}

/// A linear system that was solved.
struct Solved {
    A: CsrMatrix<f64>,
    b: DVector<f64>,
    solution: DVector<f64>,
    /// Numbers of forces and of stiffnesses that had been evaluated by then.
    after: [usize; 2],
}

impl Asked {
    fn fits(&self, n: usize, lengths: &[usize]) -> bool {
        let fits = lengths.iter().all(|&length| length == n);
        self.misfits.set(self.misfits.get() + usize::from(!fits));
        fits
    }
}

fn step(
    course: &Course,
    q: &mut DVector<f64>,
    v: &mut DVector<f64>,
    dt: f64,
    M: &CsrMatrix<f64>,
    potential: &Potential,
) -> Result<Asked, Mistake> {
    let (q0, v0, n, asked) = (q.clone(), v.clone(), q.len(), Asked::default());
    let energy = |v: &DVector<f64>| {
        if !asked.fits(n, &[v.len()]) {
            return f64::NAN;
        }
        asked.energies.borrow_mut().push(v.clone());
        0.5 * (v - &v0).dot(&(M * (v - &v0))) + (potential.V)(&(&q0 + v * dt))
    };
    let force = |q: &DVector<f64>, v: &DVector<f64>| {
        if !asked.fits(n, &[q.len(), v.len()]) {
            return DVector::from_element(n, f64::NAN);
        }
        asked.forces.borrow_mut().push((q.clone(), v.clone()));
        (potential.f)(q)
    };
    let stiffness = |q: &DVector<f64>, v: &DVector<f64>| {
        if !asked.fits(n, &[q.len(), v.len()]) {
            return CsrMatrix::zeros(n, n);
        }
        asked.stiffnesses.borrow_mut().push((q.clone(), v.clone()));
        sparse(&(potential.K)(q))
    };
    let solve = |A: &CsrMatrix<f64>, b: &DVector<f64>| {
        let solution = by_elimination(A, b);
        if asked.fits(n, &[A.nrows(), A.ncols(), b.len()]) {
            let after = [asked.forces.borrow().len(), asked.stiffnesses.borrow().len()];
            asked.systems.borrow_mut().push(Solved { A: A.clone(), b: b.clone(), solution: solution.clone(), after });
        }
        solution
    };
    course.subject.implicit_euler(q, v, dt, M, &energy, &force, &stiffness, &solve)?;
    holds("closures are called with vectors as long as q", asked.misfits.get() == 0)?;
    holds("q and qdot keep their lengths", (q.len(), v.len()) == (n, n))?;
    Ok(asked)
}

/// ½ xᵀ A x with coupled coordinates.
fn coupled() -> Potential {
    fn A() -> DMatrix<f64> {
        dmatrix![5.0, -2.0; -2.0, 7.0]
    }
    Potential { V: |q| 0.5 * q.dot(&(A() * q)), f: |q| -(A() * q), K: |_| -A() }
}

/// ¼ |x|⁴.
fn quartic() -> Potential {
    Potential {
        V: |q| 0.25 * q.norm_squared().powi(2),
        f: |q| -q * q.norm_squared(),
        K: |q| -(DMatrix::identity(q.len(), q.len()) * q.norm_squared() + q * q.transpose() * 2.0),
    }
}

/// M (v⁺ − v) − dt f(q⁺), which a step makes zero.
fn residual(M: &CsrMatrix<f64>, dt: f64, old: &DVector<f64>, new: &DVector<f64>, f: DVector<f64>) -> DVector<f64> {
    M * (new - old) - f * dt
}

fn a_spring_follows_the_exact_recurrence(course: &Course) -> Outcome {
    for_some(course.seed, (0.1..10.0, 1e-3..1.0), |(m, dt)| {
        let M = sparse(&dmatrix![m]);
        let spring = Potential { V: |q| 25.0 * q[0] * q[0], f: |q| q * -50.0, K: |_| dmatrix![-50.0] };
        let (mut q, mut v) = (dvector![1.0], dvector![-0.5]);
        for _ in 0..20 {
            let expected_v = (m * v[0] - dt * 50.0 * q[0]) / (m + dt * dt * 50.0);
            let expected_q = q[0] + dt * expected_v;
            step(course, &mut q, &mut v, dt, &M, &spring)?;
            near_number("v⁺ = (m v − dt k x) / (m + dt² k)", v[0], expected_v, 1e-9)?;
            near_number("x⁺ = x + dt v⁺ (the new velocity)", q[0], expected_q, 1e-9)?;
        }
        Ok(())
    })
}

fn the_force_is_that_at_the_end_of_the_step(course: &Course) -> Outcome {
    let M = sparse(&dmatrix![2.0, 0.5; 0.5, 1.0]);
    for_some(course.seed, (vector(-1.0..1.0), vector(-1.0..1.0), 0.01..0.3), |(q0, v0, dt)| {
        for potential in [coupled(), quartic()] {
            let (mut q, mut v) = (dvector![q0.x, q0.y], dvector![v0.x, v0.y]);
            let (q_old, v_old) = (q.clone(), v.clone());
            step(course, &mut q, &mut v, dt, &M, &potential)?;
            let rest = residual(&M, dt, &v_old, &v, (potential.f)(&q));
            near("M (v⁺ − v) = dt f(q⁺)", &rest, &DVector::<f64>::zeros(2), 1e-8)?;
            near("q⁺ = q + dt v⁺", &q, &(q_old + v * dt), 1e-14)?;
        }
        Ok(())
    })
}

fn newton_starts_from_the_old_velocity_at_the_positions_it_leads_to(course: &Course) -> Outcome {
    let M = sparse(&DMatrix::identity(2, 2));
    let (q0, v0, dt) = (dvector![1.0, 2.0], dvector![3.0, -4.0], 0.1);
    let (mut q, mut v) = (q0.clone(), v0.clone());
    let asked = step(course, &mut q, &mut v, dt, &M, &quartic())?;
    let expected = &q0 + &v0 * dt;
    for (rule, states) in [("force", asked.forces.borrow()), ("stiffness", asked.stiffnesses.borrow())] {
        let (at, with) = states.first().cloned().unwrap_or_default();
        near(&format!("the first {rule} is evaluated at q + dt v"), &at, &expected, 1e-15)?;
        near(&format!("the first {rule} receives v"), &with, &v0, 0.0)?;
    }
    for (at, with) in asked.forces.borrow().iter().chain(asked.stiffnesses.borrow().iter()) {
        near("q and v of a call belong together", at, &(&q0 + with * dt), 1e-14)?;
    }
    Ok(())
}

fn the_linear_systems_are_those_of_the_page(course: &Course) -> Outcome {
    let mass = dmatrix![2.0, 0.5; 0.5, 1.0];
    let (q0, v0, dt) = (dvector![1.0, 2.0], dvector![3.0, -4.0], 0.3);
    let (mut q, mut v) = (q0.clone(), v0.clone());
    let asked = step(course, &mut q, &mut v, dt, &sparse(&mass), &quartic())?;
    holds("a step that is not at rest needs a linear system", !asked.systems.borrow().is_empty())?;
    let (forces, stiffnesses) = (asked.forces.borrow(), asked.stiffnesses.borrow());
    for Solved { A, b, solution, after: [f, k] } in asked.systems.borrow().iter() {
        let states = forces[..*f].last().zip(stiffnesses[..*k].last());
        let Some(((_, of_force), (q, v))) = states else {
            return holds("force and stiffness are evaluated before the linear system is solved", false);
        };
        near("force and stiffness of a Newton step belong to the same velocity", of_force, v, 1e-13)?;
        let H = sparse(&(&mass - (quartic().K)(q) * (dt * dt)));
        let direction = by_elimination(&H, &-residual(&sparse(&mass), dt, &v0, v, (quartic().f)(q)));
        // H d = −g, or H d = g for the opposite; and both sides of the equations may be multiplied by a number.
        let solution = solution * solution.dot(&direction).signum();
        let rule =
            "a linear system has Newton's direction as its solution, with H = M − dt² K and g = M (v − qdot) − dt f";
        near(rule, &solution, &direction, 1e-12)?;
        near(
            "the matrix that is solved with is symmetric",
            &dense_of((2, 2), A)?,
            &dense_of((2, 2), A)?.transpose(),
            1e-12,
        )?;
        holds("the right-hand side is finite", b.iter().all(|entry| entry.is_finite()))?;
    }
    Ok(())
}

fn at_most_five_directions_are_followed(course: &Course) -> Outcome {
    // Far out on ¼ |x|⁴ each Newton step goes a third of the way, so five do not get to the bottom.
    let M = sparse(&dmatrix![1.0]);
    let (mut q, mut v) = (dvector![1e6], dvector![0.0]);
    let asked = step(course, &mut q, &mut v, 10.0, &M, &quartic())?;
    holds("five Newton steps, no more and no fewer", asked.systems.borrow().len() == 5)?;
    let ratio = q[0] / 1e6;
    near_number("each of them goes as far as Newton's method does", ratio, (2.0f64 / 3.0).powi(5), 1e-6)
}

fn the_energy_is_evaluated_at_velocities(course: &Course) -> Outcome {
    let M = sparse(&dmatrix![1.0]);
    let (mut q, mut v) = (dvector![100.0], dvector![0.25]);
    let spring = Potential { V: |q| 0.5 * q[0] * q[0], f: |q| -q, K: |_| dmatrix![-1.0] };
    let asked = step(course, &mut q, &mut v, 0.01, &M, &spring)?;
    let near_v = asked.energies.borrow().iter().all(|asked| asked[0].abs() < 2.0);
    holds("energy is a function of the velocity, not of positions", near_v && !asked.energies.borrow().is_empty())
}

fn free_fall_is_the_sum_of_its_steps(course: &Course) -> Outcome {
    // x_n = x_0 + n dt v_0 + g dt² n (n + 1) / 2.
    let M = sparse(&dmatrix![3.0]);
    let weight = Potential { V: |q| 3.0 * 9.81 * q[0], f: |_| dvector![-3.0 * 9.81], K: |_| dmatrix![0.0] };
    let (mut q, mut v, dt, n) = (dvector![5.0], dvector![2.0], 0.01, 200.0);
    for _ in 0..200 {
        step(course, &mut q, &mut v, dt, &M, &weight)?;
    }
    near_number("v_n = v_0 + n g dt", v[0], 2.0 - n * 9.81 * dt, 1e-8)?;
    near_number("x_n after free fall", q[0], 5.0 + n * dt * 2.0 - 9.81 * dt * dt * n * (n + 1.0) / 2.0, 1e-8)
}

fn a_body_at_rest_stays_without_a_solve(course: &Course) -> Outcome {
    let M = sparse(&DMatrix::identity(2, 2));
    let (mut q, mut v) = (dvector![0.0, 0.0], dvector![0.0, 0.0]);
    let asked = step(course, &mut q, &mut v, 0.1, &M, &coupled())?;
    near("q", &q, &dvector![0.0, 0.0], 0.0)?;
    near("v", &v, &dvector![0.0, 0.0], 0.0)?;
    holds("g = 0 needs no Hessian", asked.stiffnesses.borrow().is_empty())
}

fn a_step_that_would_go_through_a_wall_stays_before_it(course: &Course) -> Outcome {
    // x − ln x is infinite at zero, and a full Newton step from x = 3 leads beyond.
    fn of(x: f64, value: fn(f64) -> f64, beyond: f64) -> f64 {
        if x > 0.0 { value(x) } else { beyond }
    }
    let wall = Potential {
        V: |q| of(q[0], |x| x - x.ln(), f64::INFINITY),
        f: |q| dvector![of(q[0], |x| 1.0 / x - 1.0, f64::NAN)],
        K: |q| dmatrix![of(q[0], |x| -1.0 / (x * x), f64::NAN)],
    };
    let (mut q, mut v, dt) = (dvector![3.0], dvector![0.0], 10.0);
    step(course, &mut q, &mut v, dt, &sparse(&dmatrix![1.0]), &wall)?;
    holds("a step that leads where the energy is infinite is refused", q[0] > 0.0)?;
    let energy = 0.5 * v[0] * v[0] + (wall.V)(&q);
    holds("the energy at the end of a step is less than at the old velocity", energy < 3.0 - 3f64.ln())?;
    near_number("q⁺ = q + dt v⁺", q[0], 3.0 + dt * v[0], 1e-12)
}

fn a_step_of_an_elastic_body_minimises_its_energy(course: &Course) -> Outcome {
    let mut body = FreeBody::new(course, 1.0)?;
    let old = FreeBody::new(course, 1.0)?;
    body.implicit_step(0.05)?;
    let least = old.step_energy(&body.qdot, 0.05)?;
    for entry in 0..body.qdot.len() {
        for by in [-1e-2, 1e-2] {
            let mut other = body.qdot.clone();
            other[entry] += by;
            holds("no other velocity has less energy", old.step_energy(&other, 0.05)? > least)?;
        }
    }
    near("q⁺ = q + dt v⁺", &body.q, &(&old.q + &body.qdot * 0.05), 1e-14)
}

fn a_free_body_keeps_its_momentum(course: &Course) -> Outcome {
    for size in [1.0, 1e-2, 1e-3] {
        let mut body = FreeBody::new(course, size)?;
        let before = body.momentum();
        for _ in 0..30 {
            body.implicit_step(0.01)?;
        }
        near("the momentum of a free body stays", &body.momentum(), &before, 1e-12 * before.norm())?;
    }
    Ok(())
}

//! Arguments that the closures receive: the first system of equations shows whether its matrix or its right-hand side is wrong.

use std::cell::RefCell;

use grader::implementation::{Answer, Implementation, Local};
use grader_child::Solve;
use nalgebra::{DMatrix, DVector};
use nalgebra_sparse::CsrMatrix;

use super::super::Case;
use crate::reference::REFERENCE;
use crate::reference::systems::solve;
use crate::reference::trial::{Input, Step, Trial};

/// Relative difference from which on two systems of equations differ.
const DIFFERENCE: f64 = 1e-7;

/// A system of equations.
type System = (DMatrix<f64>, DVector<f64>);

/// Sentences about the first solve, and about numbers of calls; empty if the function takes no closures.
pub fn told(wrong: &[&Case], subject: &dyn Implementation) -> Vec<String> {
    let mut all = Vec::new();
    all.extend(first_system(wrong, subject));
    all.extend(numbers(wrong));
    all
}

fn first_system(wrong: &[&Case], subject: &dyn Implementation) -> Option<String> {
    let [mut matrix_is_right, mut vector_is_right] = [true; 2];
    for case in wrong.iter().take(super::PROBED) {
        let (asked, expected) = (first_solve(&case.trial, subject)?, first_solve(&case.trial, &Local(REFERENCE))?);
        let alike = |a: &DMatrix<f64>, b: &DMatrix<f64>| {
            a.shape() == b.shape() && (a - b).amax() <= DIFFERENCE * b.amax().max(f64::MIN_POSITIVE)
        };
        matrix_is_right &= alike(&asked.0, &expected.0);
        let column = |b: &DVector<f64>| DMatrix::from_column_slice(b.len(), 1, b.as_slice());
        vector_is_right &= alike(&column(&asked.1), &column(&expected.1));
    }
    let sentence = match (matrix_is_right, vector_is_right) {
        (true, true) => "The first system of equations is right: look at what is done with its solution and after it.",
        (true, false) => "In the first system of equations the matrix is right, the right-hand side is not.",
        (false, true) => "In the first system of equations the right-hand side is right, the matrix is not.",
        (false, false) => return None,
    };
    Some(sentence.to_owned())
}

/// The first system that a function wants solved; `None` if there is none.
fn first_solve(trial: &Trial, who: &dyn Implementation) -> Option<System> {
    let first = RefCell::new(None);
    let recorded = |A: &CsrMatrix<f64>, b: &DVector<f64>| {
        first.borrow_mut().get_or_insert_with(|| (DMatrix::from(A), b.clone()));
        solve(A, b)
    };
    run(trial, who, &recorded)?.ok()?;
    first.into_inner()
}

fn run(trial: &Trial, who: &dyn Implementation, solve: Solve) -> Option<Answer<()>> {
    match &trial.input {
        Input::Minimum { objective: f, start, max_steps } => {
            let (f_of, g, H) = (|x: &_| f.value(x), |x: &_| f.gradient(x), |x: &_| f.hessian(x));
            Some(who.newtons_method(&mut start.clone(), &f_of, &g, &H, solve, *max_steps).map(|_| ()))
        }
        Input::Step(step) => Some(take(trial.function, step, who, solve)),
        _ => None,
    }
}

fn take(function: &str, step: &Step, who: &dyn Implementation, solve: Solve) -> Answer<()> {
    let (mut q, mut v, system, dt) = (step.q.clone(), step.qdot.clone(), &step.system, step.dt);
    let mass = CsrMatrix::from(&system.mass);
    let force = |q: &DVector<f64>, v: &DVector<f64>| system.force(q, v);
    let stiffness = |q: &DVector<f64>, _: &DVector<f64>| system.stiffness(q);
    if function == "linearly_implicit_euler" {
        return who.linearly_implicit_euler(&mut q, &mut v, dt, &mass, &force, &stiffness, solve);
    }
    let energy = |v: &DVector<f64>| {
        let gained = v - &step.qdot;
        0.5 * gained.dot(&(&system.mass * &gained)) + system.potential(&(&step.q + v * dt))
    };
    who.implicit_euler(&mut q, &mut v, dt, &mass, &energy, &force, &stiffness, solve)
}

/// Closures that are called too often or not often enough in the same way everywhere.
fn numbers(wrong: &[&Case]) -> Option<String> {
    let first = wrong.first()?;
    let told = first.observed.calls.iter().enumerate().filter_map(|(k, (name, _))| {
        let pairs = wrong.iter().map(|case| (case.observed.calls[k].1, case.expected.calls[k].1));
        let (more, less) = (pairs.clone().all(|(n, wanted)| n > wanted), pairs.clone().all(|(n, wanted)| n < wanted));
        match (more, less) {
            (true, _) => Some(format!("`{name}` is called too often")),
            (_, true) => Some(format!("`{name}` is not called often enough")),
            _ => None,
        }
    });
    let told: Vec<_> = told.collect();
    (!told.is_empty()).then(|| format!("{}.", told.join(", ")))
}

//! To do: the line search α = 1, ½, ¼ … of Newton's method. Read include-docs/newtons_method.md.

use nalgebra::{DVector, dmatrix, dvector};

use super::super::Course;
use super::super::outcome::{Mistake, Outcome, holds, near, near_number};
use super::objectives::{NewtonRun, Objective, bowl, line, log_barrier, overshooting, rosenbrock};

/// Returns true if two evaluations are at the same point, up to round-off.
fn is_same(a: &DVector<f64>, b: &DVector<f64>) -> bool {
    (a - b).norm() <= 1e-14 * b.norm()
}

/// The values of α at which f was evaluated along each direction. Evaluations at the start of the search, and repeated evaluations at
/// its end, are left out.
fn alphas(run: &NewtonRun, start: &[f64]) -> Result<Vec<Vec<f64>>, Mistake> {
    let mut x = DVector::from_column_slice(start);
    let mut all = Vec::new();
    for (direction, trials) in run.directions().into_iter().zip(run.trials()) {
        let mut along: Vec<_> = trials.into_iter().filter(|trial| !is_same(trial, &x)).collect();
        along.dedup_by(|again, before| is_same(again, before));
        // The direction may be solved for with either sign.
        let alpha = |trial: &&DVector<f64>| (*trial - &x).dot(direction).abs() / direction.norm_squared();
        all.push(along.iter().map(alpha).collect());
        let Some(last) = along.last() else {
            holds("f is evaluated along every direction", false)?;
            break;
        };
        x.clone_from(last);
    }
    Ok(all)
}

pub(super) fn every_direction_is_tried_in_full_first_and_then_halved(course: &Course) -> Outcome {
    for (objective, start) in [(overshooting(), vec![5.0]), (rosenbrock(), vec![-1.2, 1.0])] {
        let run = objective.minimise(course, &start, 20)?;
        let alphas = alphas(&run, &start)?;
        holds("this objective needs shorter steps", alphas.iter().any(|list| list.len() > 2))?;
        for list in alphas {
            for (k, alpha) in list.iter().enumerate() {
                let expected = 0.5f64.powi(k as i32);
                near_number("α = 1, ½, ¼ … anew for each direction", *alpha, expected, 1e-6 * expected)?;
            }
        }
    }
    Ok(())
}

pub(super) fn the_direction_solves_the_hessian_against_minus_the_gradient(course: &Course) -> Outcome {
    let H = dmatrix![4.0, 1.0; 1.0, 3.0];
    // Not a minimum: f is flat, so the full step is the only one that the first direction may end with.
    let start = dvector![1.0, 2.0];
    let tilted = Objective::new(|x| -x[0] - x[1], |_| dvector![-1.0, -1.0], move |_| H.clone());
    let run = tilted.minimise(course, start.as_slice(), 1)?;
    let d = dmatrix![4.0, 1.0; 1.0, 3.0].lu().solve(&dvector![1.0, 1.0]).unwrap_or_default();
    let trials = run.trials();
    let first = trials.first().and_then(|trials| trials.iter().find(|trial| !is_same(trial, &start)));
    let tried = first.map(|trial| *trial - &start).unwrap_or_default();
    near("the first step that is tried is d, with H d = −g", &tried, &d, 1e-13)?;
    near("a step that is good enough is taken", &(run.x - start), &d, 1e-13)
}

pub(super) fn the_decrease_is_at_least_1e_8_of_that_of_the_linear_model(course: &Course) -> Outcome {
    // The slope is −1, so the full step must gain 1e-8 and the half step 0.5e-8.
    let enough = |t: f64| if t == 1.0 { -1.5e-8 } else { 0.0 };
    let rule = "a decrease a little above the bound is enough";
    near(rule, &line(enough).minimise(course, &[0.0], 1)?.x, &dvector![1.0], 0.0)?;
    let too_little = |t: f64| if t == 1.0 || t == 0.5 { -0.8e-8 } else { 0.0 };
    let run = line(too_little).minimise(course, &[0.0], 1)?;
    near(
        "a decrease a little below the bound is too little, and a shorter step has a lower bound",
        &run.x,
        &dvector![0.5],
        0.0,
    )?;
    near_number("f there", run.f, -0.8e-8, 0.0)?;
    let later = |t: f64| if t == 0.0 { 0.0 } else { -0.3e-8 };
    near("the bound shrinks with α", &line(later).minimise(course, &[0.0], 1)?.x, &dvector![0.25], 0.0)?;
    let exactly = |t: f64| if t == 1.0 { -1e-8 } else { 0.0 };
    near("exactly the bound is enough", &line(exactly).minimise(course, &[0.0], 1)?.x, &dvector![1.0], 0.0)
}

/// Round-off where a point is left by a step and reached again by its opposite.
const MOVED_BACK: f64 = 1e-14;

pub(super) fn it_gives_up_below_1e_8_and_leaves_x_as_it_was(course: &Course) -> Outcome {
    // No step decreases f, because the Hessian has the wrong sign: d points uphill.
    let uphill = Objective::new((bowl()).f, |x| x.clone(), |_| dmatrix![-1.0, 0.0; 0.0, -1.0]);
    let run = uphill.minimise(course, &[1.0, 2.0], 10)?;
    near("x0 stays where no step decreases f", &run.x, &dvector![1.0, 2.0], MOVED_BACK)?;
    near_number("and f(x0) is returned", run.f, 5.5, MOVED_BACK)?;
    holds("giving up ends it", run.directions().len() == 1)?;
    let run = line(|t| if t == 0.0 { 0.0 } else { 1.0 }).minimise(course, &[0.0], 10)?;
    near("x0 stays where no step decreases f", &run.x, &dvector![0.0], MOVED_BACK)?;
    let alphas = alphas(&run, &[0.0])?;
    let tried = alphas.first().map_or(0, Vec::len);
    // 27 of them are not below 1e-8. A function that tests α after the trial makes one more.
    holds("every halving of α down to 1e-8 is tried, and then no more than one", tried == 27 || tried == 28)
}

pub(super) fn the_smallest_step_above_1e_8_is_still_tried(course: &Course) -> Outcome {
    let last = 0.5f64.powi(26);
    let only_there = move |t: f64| if t == last { -1.0 } else { 0.0 };
    near(
        "the last α that is not below 1e-8 is tried",
        &line(only_there).minimise(course, &[0.0], 1)?.x,
        &dvector![last],
        0.0,
    )?;
    let only_beyond = move |t: f64| if t != 0.0 && t < last / 2.0 { -1.0 } else { 0.0 };
    near("an α far below 1e-8 is not", &line(only_beyond).minimise(course, &[0.0], 1)?.x, &dvector![0.0], 0.0)
}

pub(super) fn infinite_and_undefined_values_are_never_accepted(course: &Course) -> Outcome {
    for value in [f64::NAN, f64::INFINITY] {
        // Only a quarter of the step has a value.
        let objective = line(move |t| {
            if t == 0.25 {
                -1.0
            } else if t == 0.0 {
                0.0
            } else {
                value
            }
        });
        near("the first step with a finite f", &objective.minimise(course, &[0.0], 1)?.x, &dvector![0.25], 0.0)?;
        let nowhere = line(move |t| if t == 0.0 { 7.0 } else { value });
        let run = nowhere.minimise(course, &[0.0], 3)?;
        near("x0 stays where no step has a finite f", &run.x, &dvector![0.0], 0.0)?;
        near_number("and f(x0) is returned", run.f, 7.0, 0.0)?;
    }
    Ok(())
}

pub(super) fn an_infinite_start_takes_the_first_finite_step_and_no_other(course: &Course) -> Outcome {
    let lost = |t: f64| if t == 0.5 { 100.0 } else { f64::INFINITY };
    let run = line(lost).minimise(course, &[0.0], 1)?;
    near("from f = +∞ any finite f is a decrease", &run.x, &dvector![0.5], 0.0)?;
    near_number("f there", run.f, 100.0, 0.0)?;
    let run = line(|_| f64::INFINITY).minimise(course, &[0.0], 3)?;
    near("∞ ≤ ∞ is true, but no reason to move", &run.x, &dvector![0.0], 0.0)?;
    near_number("f stays infinite", run.f, f64::INFINITY, 0.0)?;
    let run = log_barrier(f64::NAN).minimise(course, &[0.5], 20)?;
    near("a start with a finite f is not affected", &run.x, &dvector![1.0], 1e-7)
}

pub(super) fn a_direction_without_an_answer_leaves_x_as_it_was(course: &Course) -> Outcome {
    // The Hessian is singular, so the solve of these checks answers NaN.
    let singular = Objective::new((bowl()).f, |x| x.clone(), |_| dmatrix![0.0, 0.0; 0.0, 0.0]);
    let run = singular.minimise(course, &[1.0, 2.0], 5)?;
    near("x0 stays where the solve gives NaN", &run.x, &dvector![1.0, 2.0], 0.0)?;
    near_number("and f(x0) is returned", run.f, 5.5, MOVED_BACK)
}

//! To do: the line search α = 1, ½, ¼ … of Newton's method. Read include-docs/newtons_method.md.

use nalgebra::{DVector, dmatrix, dvector};

use super::objectives::{Asked, Objective, Run, bowl, line, log_barrier, overshooting, rosenbrock};
use crate::outcome::{Outcome, holds, near, near_number};

/// The α at which f was asked along each direction; questions about the start of the direction do not count.
fn alphas(run: &Run, start: &[f64]) -> Vec<Vec<f64>> {
    let mut x = DVector::from_column_slice(start);
    let mut all = Vec::new();
    for (direction, trials) in run.directions().into_iter().zip(run.trials()) {
        let along: Vec<_> = trials.into_iter().filter(|trial| **trial != x).collect();
        let alpha = |trial: &&DVector<f64>| (*trial - &x).dot(direction) / direction.norm_squared();
        all.push(along.iter().map(alpha).collect());
        x.clone_from(along.last().expect("a direction is tried"));
    }
    all
}

#[test]
fn every_direction_is_tried_in_full_first_and_then_halved() -> Outcome {
    for (objective, start) in [(overshooting(), vec![5.0]), (rosenbrock(), vec![-1.2, 1.0])] {
        let run = objective.minimise(&start, 20);
        let alphas = alphas(&run, &start);
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

#[test]
fn the_direction_solves_the_hessian_against_minus_the_gradient() -> Outcome {
    let H = dmatrix![4.0, 1.0; 1.0, 3.0];
    let run = Objective::quadratic(H.clone(), dvector![0.0, 0.0]).minimise(&[1.0, 2.0], 1);
    let solve = run.asked.iter().find_map(|asked| if let Asked::Solve(b, _) = asked { Some(b.clone()) } else { None });
    let expected = -(H * dvector![1.0, 2.0]);
    near("the right-hand side of the solve is −g", &solve.unwrap_or_default(), &expected, 1e-14)
}

#[test]
fn a_decrease_must_be_at_least_1e_8_of_what_the_slope_promises() -> Outcome {
    // The slope is −1, so the full step must gain 1e-8 and the half step 0.5e-8.
    let enough = |t: f64| if t == 1.0 { -1.5e-8 } else { 0.0 };
    near("1.5e-8 gained at α = 1 is enough", &line(enough).minimise(&[0.0], 1).x, &dvector![1.0], 0.0)?;
    let too_little = |t: f64| if t == 1.0 || t == 0.5 { -0.8e-8 } else { 0.0 };
    let run = line(too_little).minimise(&[0.0], 1);
    near("0.8e-8 gained is too little at α = 1 and enough at ½", &run.x, &dvector![0.5], 0.0)?;
    near_number("f there", run.f, -0.8e-8, 0.0)?;
    let later = |t: f64| if t == 0.0 { 0.0 } else { -0.3e-8 };
    near("the bound shrinks with α", &line(later).minimise(&[0.0], 1).x, &dvector![0.25], 0.0)?;
    let exactly = |t: f64| if t == 1.0 { -1e-8 } else { 0.0 };
    near("exactly the bound is enough", &line(exactly).minimise(&[0.0], 1).x, &dvector![1.0], 0.0)
}

#[test]
fn it_gives_up_below_1e_8_and_leaves_x_as_it_was() -> Outcome {
    // No step decreases f, because the Hessian has the wrong sign: d points uphill.
    let uphill = Objective::new((bowl()).f, |x| x.clone(), |_| dmatrix![-1.0, 0.0; 0.0, -1.0]);
    let run = uphill.minimise(&[1.0, 2.0], 10);
    near("x0 stays where no step decreases f", &run.x, &dvector![1.0, 2.0], 0.0)?;
    near_number("and f(x0) is returned", run.f, 5.5, 0.0)?;
    holds("giving up ends it", run.directions().len() == 1)?;
    let trials = run.trials()[0].iter().filter(|x| x[0] != 1.0).count();
    holds("27 halvings from 1 down to 2⁻²⁶, the last above 1e-8", trials == 27)
}

#[test]
fn the_smallest_step_above_1e_8_is_still_tried() -> Outcome {
    let last = 0.5f64.powi(26);
    let only_there = move |t: f64| if t == last { -1.0 } else { 0.0 };
    near("α = 2⁻²⁶ = 1.5e-8", &line(only_there).minimise(&[0.0], 1).x, &dvector![last], 0.0)?;
    let only_beyond = move |t: f64| if t != 0.0 && t < last { -1.0 } else { 0.0 };
    near("α = 2⁻²⁷ = 0.7e-8 is not", &line(only_beyond).minimise(&[0.0], 1).x, &dvector![0.0], 0.0)
}

#[test]
fn infinite_and_undefined_values_are_never_accepted() -> Outcome {
    for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
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
        near("the first step with a finite f", &objective.minimise(&[0.0], 1).x, &dvector![0.25], 0.0)?;
        let nowhere = line(move |t| if t == 0.0 { 7.0 } else { value });
        let run = nowhere.minimise(&[0.0], 3);
        near("x0 stays where no step has a finite f", &run.x, &dvector![0.0], 0.0)?;
        near_number("and f(x0) is returned", run.f, 7.0, 0.0)?;
    }
    Ok(())
}

#[test]
fn an_infinite_start_takes_the_first_finite_step_and_no_other() -> Outcome {
    let lost = |t: f64| if t == 0.5 { 100.0 } else { f64::INFINITY };
    let run = line(lost).minimise(&[0.0], 1);
    near("from f = +∞ any finite f is a decrease", &run.x, &dvector![0.5], 0.0)?;
    near_number("f there", run.f, 100.0, 0.0)?;
    let run = line(|_| f64::INFINITY).minimise(&[0.0], 3);
    near("∞ ≤ ∞ is true, but no reason to move", &run.x, &dvector![0.0], 0.0)?;
    near_number("f stays infinite", run.f, f64::INFINITY, 0.0)?;
    let run = log_barrier(f64::NAN).minimise(&[0.5], 20);
    near("a start inside is not disturbed", &run.x, &dvector![1.0], 1e-7)
}

#[test]
fn a_direction_without_an_answer_leaves_x_as_it_was() -> Outcome {
    // The Hessian is singular, so the solve of these checks answers NaN.
    let singular = Objective::new((bowl()).f, |x| x.clone(), |_| dmatrix![0.0, 0.0; 0.0, 0.0]);
    let run = singular.minimise(&[1.0, 2.0], 5);
    near("x0 stays where the solve gives NaN", &run.x, &dvector![1.0, 2.0], 0.0)?;
    near_number("and f(x0) is returned", run.f, 5.5, 0.0)
}

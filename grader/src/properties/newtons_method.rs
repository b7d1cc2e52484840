//! To do: minimisation by Newton's method with a backtracking line search. Read include-docs/newtons_method.md.

mod line_search;
mod objectives;

use nalgebra::{DVector, dmatrix, dvector};

use self::line_search::{
    a_direction_without_an_answer_leaves_x_as_it_was, an_infinite_start_takes_the_first_finite_step_and_no_other,
    every_direction_is_tried_in_full_first_and_then_halved, infinite_and_undefined_values_are_never_accepted,
    it_gives_up_below_1e_8_and_leaves_x_as_it_was, the_decrease_is_at_least_1e_8_of_that_of_the_linear_model,
    the_direction_solves_the_hessian_against_minus_the_gradient, the_smallest_step_above_1e_8_is_still_tried,
};
use self::objectives::{NewtonRun, Objective, bowl, halving, ill_conditioned, log_barrier, overshooting, rosenbrock};
use super::outcome::{Outcome, holds, near, near_number};
use super::random::{for_all, for_some, vector};
use super::{Check, Course};

/// The properties of the function.
pub const CHECKS: &[Check] = checks![
    a_quadratic_is_solved_by_one_direction,
    rosenbrocks_valley_is_followed_to_its_end,
    a_full_step_that_overshoots_is_cut_back,
    states_without_an_energy_are_refused,
    conditioning_of_1e12_does_no_harm,
    the_value_returned_is_f_at_the_x_that_is_left,
    f_never_rises,
    zero_steps_leave_the_start_and_return_f_there,
    a_start_at_the_minimum_needs_no_hessian,
    at_most_max_steps_directions_are_followed,
    it_ends_when_the_gradient_is_1e_10_of_that_at_the_start,
    the_gradient_is_compared_with_that_at_the_start,
    every_direction_is_tried_in_full_first_and_then_halved,
    the_direction_solves_the_hessian_against_minus_the_gradient,
    the_decrease_is_at_least_1e_8_of_that_of_the_linear_model,
    it_gives_up_below_1e_8_and_leaves_x_as_it_was,
    the_smallest_step_above_1e_8_is_still_tried,
    infinite_and_undefined_values_are_never_accepted,
    an_infinite_start_takes_the_first_finite_step_and_no_other,
    a_direction_without_an_answer_leaves_x_as_it_was,
];

fn a_quadratic_is_solved_by_one_direction(course: &Course) -> Outcome {
    let H = dmatrix![4.0, 1.0, 0.0; 1.0, 3.0, -0.5; 0.0, -0.5, 2.0];
    for_all(course.seed, (vector(-9.0..9.0), vector(-3.0..3.0)), |(start, bottom)| {
        let bottom = DVector::from_column_slice(bottom.as_slice());
        let run = Objective::quadratic(H.clone(), bottom.clone()).minimise(course, start.as_slice(), 10)?;
        near("the minimum of a quadratic", &run.x, &bottom, 1e-12)?;
        holds("a quadratic needs one direction", run.directions().len() == 1)
    })
}

fn rosenbrocks_valley_is_followed_to_its_end(course: &Course) -> Outcome {
    for start in [[-1.2, 1.0], [0.0, 0.0], [2.0, -3.0]] {
        let run = rosenbrock().minimise(course, &start, 100)?;
        near("the minimum of Rosenbrock's function", &run.x, &dvector![1.0, 1.0], 1e-8)?;
        holds("Newton's method needs few directions there", run.directions().len() < 40)?;
    }
    Ok(())
}

fn a_full_step_that_overshoots_is_cut_back(course: &Course) -> Outcome {
    // sqrt(1 + x²): full steps from |x| > 1 go to −x³ and diverge.
    let run = overshooting().minimise(course, &[5.0], 30)?;
    near(
        "the minimum is found where full steps overshoot; α must start at 1 for every direction",
        &run.x,
        &dvector![0.0],
        1e-9,
    )?;
    holds("quadratic convergence needs few directions", run.directions().len() < 15)
}

fn states_without_an_energy_are_refused(course: &Course) -> Outcome {
    for outside in [f64::NAN, f64::INFINITY] {
        let run = log_barrier(outside).minimise(course, &[3.0], 30)?;
        near("the minimum is found though f has no value beyond a wall", &run.x, &dvector![1.0], 1e-7)?;
        near_number("f there", run.f, 1.0, 1e-12)?;
    }
    Ok(())
}

fn conditioning_of_1e12_does_no_harm(course: &Course) -> Outcome {
    let run = ill_conditioned().minimise(course, &[1.0, 1.0], 20)?;
    near("the minimum of an ill-conditioned quadratic", &run.x, &dvector![0.0, 0.0], 1e-9)
}

fn the_value_returned_is_f_at_the_x_that_is_left(course: &Course) -> Outcome {
    for steps in [0, 1, 2, 3, 7, 50] {
        for (objective, start) in [(rosenbrock(), [-1.2, 1.0]), (ill_conditioned(), [3.0, -2.0])] {
            let run = objective.minimise(course, &start, steps)?;
            is_f_at_x(&run, &objective)?;
        }
        for (objective, start) in [(overshooting(), 5.0), (log_barrier(f64::INFINITY), 3.0), (halving(1.0), 1.0)] {
            let run = objective.minimise(course, &[start], steps)?;
            is_f_at_x(&run, &objective)?;
        }
    }
    Ok(())
}

/// Tolerance for round-off: the final point and the point at which f was evaluated may differ in the order of additions.
fn is_f_at_x(run: &NewtonRun, objective: &Objective) -> Outcome {
    let expected = (objective.f)(&run.x);
    near_number("the returned f", run.f, expected, 1e-12 * (1.0 + expected.abs()))
}

fn f_never_rises(course: &Course) -> Outcome {
    for_some(course.seed, (-3.0..3.0, -3.0..3.0), |(x, y)| {
        let mut before = (rosenbrock().f)(&dvector![x, y]);
        for steps in 0..8 {
            let run = rosenbrock().minimise(course, &[x, y], steps)?;
            holds("more steps give no larger f", run.f <= before)?;
            before = run.f;
        }
        Ok(())
    })
}

fn zero_steps_leave_the_start_and_return_f_there(course: &Course) -> Outcome {
    let run = rosenbrock().minimise(course, &[-1.2, 1.0], 0)?;
    near("max_steps = 0 leaves x0", &run.x, &dvector![-1.2, 1.0], 0.0)?;
    near_number("and returns f(x0)", run.f, (rosenbrock().f)(&dvector![-1.2, 1.0]), 0.0)?;
    holds("and needs no solve", run.directions().is_empty())
}

fn a_start_at_the_minimum_needs_no_hessian(course: &Course) -> Outcome {
    let run = bowl().minimise(course, &[0.0, 0.0], 10)?;
    holds("g = 0 at the start: nothing to solve", run.hessians() == 0 && run.directions().is_empty())?;
    near("x0 stays", &run.x, &dvector![0.0, 0.0], 0.0)?;
    near_number("f there", run.f, 3.0, 0.0)
}

fn at_most_max_steps_directions_are_followed(course: &Course) -> Outcome {
    // Each direction of this objective goes half the way.
    for steps in 1..12 {
        let run = halving(1.0).minimise(course, &[1.0], steps)?;
        holds("max_steps counts directions", run.directions().len() == steps)?;
        near("x after max_steps halvings", &run.x, &dvector![0.5f64.powi(steps as i32)], 0.0)?;
    }
    Ok(())
}

fn it_ends_when_the_gradient_is_1e_10_of_that_at_the_start(course: &Course) -> Outcome {
    // 2⁻³³ > 1e-10 > 2⁻³⁴, whatever the unit of f is.
    for unit in [1e-20, 1.0, 1e20] {
        let run = halving(unit).minimise(course, &[1.0], 100)?;
        holds(
            "it ends as soon as the gradient is 1e-10 of that at the start, whatever the unit of f",
            run.directions().len() == 34,
        )?;
    }
    Ok(())
}

fn the_gradient_is_compared_with_that_at_the_start(course: &Course) -> Outcome {
    // Full steps that divide the gradient by a million each: two are enough.
    let run = objectives::shrinking(1e-6).minimise(course, &[1.0], 100)?;
    holds("the gradient is measured against that at the start, not against the one before", run.directions().len() == 2)
}

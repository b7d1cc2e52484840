//! To do: minimisation by Newton's method with a backtracking line search. Read include-docs/newtons_method.md.

mod line_search;
mod objectives;

use nalgebra::{DVector, dmatrix, dvector};

use self::objectives::{Objective, bowl, halving, ill_conditioned, log_barrier, overshooting, rosenbrock};
use crate::outcome::{Outcome, for_all, holds, near, near_number};
use crate::random::vector;

#[test]
fn a_quadratic_is_solved_by_one_direction() -> Outcome {
    let H = dmatrix![4.0, 1.0, 0.0; 1.0, 3.0, -0.5; 0.0, -0.5, 2.0];
    for_all((vector(-9.0..9.0), vector(-3.0..3.0)), |(start, bottom)| {
        let bottom = DVector::from_column_slice(bottom.as_slice());
        let run = Objective::quadratic(H.clone(), bottom.clone()).minimise(start.as_slice(), 10);
        near("the minimum of a quadratic", &run.x, &bottom, 1e-12)?;
        holds("a quadratic needs one Hessian and one solve", (run.hessians(), run.directions().len()) == (1, 1))
    })
}

#[test]
fn rosenbrocks_valley_is_followed_to_its_end() -> Outcome {
    for start in [[-1.2, 1.0], [0.0, 0.0], [2.0, -3.0]] {
        let run = rosenbrock().minimise(&start, 100);
        near("the minimum of Rosenbrock's function", &run.x, &dvector![1.0, 1.0], 1e-8)?;
        holds("Newton's method needs less than 40 directions there", run.directions().len() < 40)?;
    }
    Ok(())
}

#[test]
fn a_full_step_that_overshoots_is_cut_back() -> Outcome {
    // sqrt(1 + x²): full steps from |x| > 1 go to −x³ and diverge.
    let run = overshooting().minimise(&[5.0], 30);
    near("the minimum of sqrt(1 + x²); α must start at 1 for every direction", &run.x, &dvector![0.0], 1e-9)?;
    holds("quadratic convergence needs less than 15 directions", run.directions().len() < 15)
}

#[test]
fn states_without_an_energy_are_refused() -> Outcome {
    for outside in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let run = log_barrier(outside).minimise(&[3.0], 30);
        near("x − ln x, and no energy for x ≤ 0", &run.x, &dvector![1.0], 1e-7)?;
        near_number("f there", run.f, 1.0, 1e-12)?;
    }
    Ok(())
}

#[test]
fn conditioning_of_1e12_does_no_harm() -> Outcome {
    let run = ill_conditioned().minimise(&[1.0, 1.0], 20);
    near("½ (x² + 1e12 y²)", &run.x, &dvector![0.0, 0.0], 1e-9)
}

#[test]
fn the_value_returned_is_f_at_the_x_that_is_left() -> Outcome {
    for steps in [0, 1, 2, 3, 7, 50] {
        for (objective, start) in [(rosenbrock(), [-1.2, 1.0]), (ill_conditioned(), [3.0, -2.0])] {
            let run = objective.minimise(&start, steps);
            near_number("the returned f", run.f, (objective.f)(&run.x), 0.0)?;
        }
        for (objective, start) in [(overshooting(), 5.0), (log_barrier(f64::NAN), 3.0), (halving(1.0), 1.0)] {
            let run = objective.minimise(&[start], steps);
            near_number("the returned f", run.f, (objective.f)(&run.x), 0.0)?;
        }
    }
    Ok(())
}

#[test]
fn f_never_rises() -> Outcome {
    for_all((-3.0..3.0, -3.0..3.0), |(x, y)| {
        let mut before = (rosenbrock().f)(&dvector![x, y]);
        for steps in 0..8 {
            let run = rosenbrock().minimise(&[x, y], steps);
            holds("more steps give no larger f", run.f <= before)?;
            before = run.f;
        }
        Ok(())
    })
}

#[test]
fn no_steps_leave_the_start_and_return_f_there() -> Outcome {
    let run = rosenbrock().minimise(&[-1.2, 1.0], 0);
    near("max_steps = 0 leaves x0", &run.x, &dvector![-1.2, 1.0], 0.0)?;
    near_number("and returns f(x0)", run.f, (rosenbrock().f)(&dvector![-1.2, 1.0]), 0.0)?;
    holds("and needs neither Hessian nor solve", run.hessians() == 0 && run.directions().is_empty())
}

#[test]
fn a_start_at_the_minimum_asks_for_no_hessian() -> Outcome {
    let run = bowl().minimise(&[0.0, 0.0], 10);
    holds("g = 0 at the start: nothing to solve", run.hessians() == 0 && run.directions().is_empty())?;
    near("x0 stays", &run.x, &dvector![0.0, 0.0], 0.0)?;
    near_number("f there", run.f, 3.0, 0.0)
}

#[test]
fn at_most_max_steps_directions_are_followed() -> Outcome {
    // Each direction of this objective goes half the way.
    for steps in 1..12 {
        let run = halving(1.0).minimise(&[1.0], steps);
        holds("max_steps counts directions", run.hessians() == steps && run.directions().len() == steps)?;
        near("x after max_steps halvings", &run.x, &dvector![0.5f64.powi(steps as i32)], 0.0)?;
    }
    Ok(())
}

#[test]
fn it_ends_when_the_gradient_is_1e_10_of_that_at_the_start() -> Outcome {
    // 2⁻³³ > 1e-10 > 2⁻³⁴, whatever the unit of f is.
    for unit in [1e-20, 1.0, 1e20] {
        let run = halving(unit).minimise(&[1.0], 100);
        holds("34 halvings of the gradient, whatever the unit of f", run.directions().len() == 34)?;
    }
    Ok(())
}

#[test]
fn the_gradient_at_the_start_is_the_measure_not_the_one_before() -> Outcome {
    // Full steps that divide the gradient by a million each: two are enough.
    let run = objectives::shrinking(1e-6).minimise(&[1.0], 100);
    holds("1e-12 after two directions is below 1e-10", run.directions().len() == 2)
}

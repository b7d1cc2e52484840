//! Trials of the integrators and of Newton's method.

use nalgebra::{DMatrix, DVector, dmatrix, dvector};

use super::elements::trial;
use super::random::Random;
use super::systems::{Objective, System};
use super::trial::{Input, Step, Trial};

/// A line search sees the energy only, whose round-off hides a distance of its square root from the minimum. Where the last
/// step is refused for that, the answer is still right, so it is judged against numbers that are larger by this.
const LINE_SEARCH: f64 = 1e3;

/// Springs from masses to the ground and from each mass to the next.
fn chain(random: &mut Random, masses: usize, stiffness: f64) -> System {
    let mass = random.numbers(masses, 0.5..2.0);
    let mut springs = DMatrix::from_diagonal(&random.numbers(masses, 0.1 * stiffness..stiffness));
    for i in 1..masses {
        let k = random.number(0.5 * stiffness..stiffness);
        springs[(i, i)] += k;
        springs[(i - 1, i - 1)] += k;
        springs[(i, i - 1)] -= k;
        springs[(i - 1, i)] -= k;
    }
    let load = random.numbers(masses, -10.0..10.0);
    let mass = if masses == 1 { DMatrix::from_diagonal(&mass) } else { consistent(&mass) };
    System { mass, springs, hardening: 0.0, load, damping: 0.0, wall: 0.0, force_factor: 1.0, stiffness_factor: 1.0 }
}

/// A mass matrix that couples neighbours.
fn consistent(mass: &DVector<f64>) -> DMatrix<f64> {
    let n = mass.len();
    DMatrix::from_fn(n, n, |i, j| if i == j { mass[i] } else { 0.2 / (1.0 + i.abs_diff(j) as f64) })
}

fn body(random: &mut Random, index: usize) -> (&'static str, System) {
    match index % 7 {
        0 => ("one spring", chain(random, 1, 100.0)),
        1 => {
            let mut free = chain(random, 3, 0.0);
            free.springs.fill(0.0);
            ("free fall", free)
        }
        2 => ("stiff", chain(random, 2, 1e8)),
        3 => ("coupled masses", chain(random, 2 + index / 7 % 2, 500.0)),
        4 => ("hardening springs", System { hardening: 20.0, ..chain(random, 3, 100.0) }),
        5 => ("soft and stiff", soft_and_stiff(random)),
        _ => ("a wall", wall(random)),
    }
}

fn soft_and_stiff(random: &mut Random) -> System {
    let mut system = chain(random, 2, 10.0);
    system.springs[(0, 0)] += 1e6;
    system
}

/// The load pushes towards a wall at zero, harder than a full step of Newton's method from 1 can bear; after the half step
/// it converges in four more.
fn wall(random: &mut Random) -> System {
    let wall = random.number(5.0..20.0);
    let load = dvector![-random.number(2.2..2.3) * wall];
    System { wall, load, ..chain(random, 1, 0.1) }
}

/// A time step in which the wall matters ten times as much as the mass.
fn wall_step(system: &System) -> f64 {
    (10.0 * system.mass[(0, 0)] / system.wall).sqrt()
}

/// `linearly_implicit_euler` and `implicit_euler`.
pub fn steps(function: &'static str, random: &mut Random) -> Vec<Trial> {
    let one = |index: usize| {
        let (name, mut system) = body(random, index);
        let n = system.load.len();
        let dt = if name == "a wall" { wall_step(&system) } else { [0.01, 0.03, 0.1][index % 3] };
        let (q, qdot) = match name {
            "a wall" => (dvector![1.0], dvector![0.0]),
            _ => (random.numbers(n, -0.5..0.5), random.numbers(n, -1.0..1.0)),
        };
        if function == "linearly_implicit_euler" {
            system.damping = random.number(0.1..1.0);
        }
        let velocity = 1.0 + system.force(&q, &qdot).amax() * dt / 0.3;
        let mut scales = vec![1.0 + dt * velocity; n];
        scales.push(velocity);
        if function == "implicit_euler" {
            scales.iter_mut().for_each(|scale| *scale *= LINE_SEARCH);
        }
        Trial { scales, ..trial(function, name, Input::Step(Step { system, q, qdot, dt }), 1.0) }
    };
    (0..28).map(one).collect()
}

/// `newtons_method`.
pub fn minima(function: &'static str, random: &mut Random) -> Vec<Trial> {
    let mut trials = Vec::new();
    let mut add = |name, edge, objective: Objective, start: DVector<f64>, max_steps| {
        let scales = vec![1.0 + objective.value(&start).abs(), LINE_SEARCH * (1.0 + start.amax())];
        let input = Input::Minimum { objective, start, max_steps };
        trials.push(Trial { edge, scales, ..trial(function, name, input, 1.0) });
    };
    for size in [1, 2, 3, 5] {
        let objective = quadratic(random, size);
        add("a quadratic", false, objective.clone(), random.numbers(size, -2.0..2.0), 10);
        add("one step", false, objective.clone(), random.numbers(size, -2.0..2.0), 1);
        add("no steps at all", true, objective.clone(), random.numbers(size, -2.0..2.0), 0);
        if let Objective::Quadratic { bottom, .. } = &objective {
            add("already there", true, objective.clone(), bottom.clone(), 10);
        }
    }
    for _ in 0..3 {
        let far = random.number(1.5..6.0);
        add("a step that goes too far", false, Objective::Overshooting, dvector![far], 30);
        add("one shortened step", false, Objective::Overshooting, dvector![-far], 1);
        add("two shortened steps", false, Objective::Overshooting, dvector![far], 2);
        // Every comparison refuses an infinite value; a value that is none needs a test that is written with care.
        for (name, edge, outside) in
            [("not a number outside", true, f64::NAN), ("infinite outside", false, f64::INFINITY)]
        {
            add(name, edge, Objective::Barrier { outside }, dvector![random.number(2.5..8.0)], 60);
            add(name, edge, Objective::Barrier { outside }, dvector![random.number(0.1..0.9)], 60);
        }
        add("uphill", true, Objective::Uphill, random.numbers(2, 0.5..2.0), 10);
        add("half the way each time", false, Objective::Halving, dvector![far], 50);
        let H = dmatrix![1.0, 0.0; 0.0, 1e12];
        add("ill-conditioned", false, Objective::Quadratic { H, bottom: dvector![0.0, 0.0] }, dvector![far, -1.0], 10);
    }
    trials
}

/// A bowl with curvatures between 1 and about 30.
fn quadratic(random: &mut Random, size: usize) -> Objective {
    let A = DMatrix::from_fn(size, size, |_, _| random.number(-2.0..2.0));
    // Round numbers, so that the gradient at the minimum is exactly zero.
    let bottom = random.numbers(size, -4.0..4.0).map(f64::round);
    Objective::Quadratic { H: &A * A.transpose() + DMatrix::identity(size, size), bottom }
}

//! Bodies at rest: the forces of the planes carry the weight.

use fem_engine::simulator::Simulator;
use fem_model::simulation::{Diagnostics, Simulation};

use crate::{
    CUBE, METHODS, SQUARE, build, contact_force, dissipative, floor, gravity, is_implicit, momentum, run, text,
};

const WEIGHT: f64 = 9810.0;

/// b'(s) of the barrier b(s) = −(s − 1)² ln s, Li et al. (2020).
fn slope(s: f64) -> f64 {
    -2.0 * (s - 1.0) * s.ln() - (s - 1.0).powi(2) / s
}

#[test]
fn a_block_of_quadratic_triangles_rests_where_the_barrier_carries_its_weight() {
    let (mesh, young) = (format!("{SQUARE}\norder = 2"), 2e11);
    let tables = gravity(0.0, -9.81) + &floor(-5e-4, "");
    let mut simulation = build(&text(&mesh, "corotated", young, "implicit_euler", 0.1, &tables));
    run(&mut simulation, 400);
    assert!((simulation.weight().unwrap() - WEIGHT).abs() < 1e-12 * WEIGHT);
    let contact = &simulation.contacts()[0];
    // Newton's method stops where the energy can no longer fall by more than its rounding.
    assert!((contact.force[1] - WEIGHT).abs() < 1e-6 * WEIGHT, "{:?}", contact.force);
    // κ |b'(gap/d̂)| times the area of the nodes below is m g: they have the whole lower side.
    let (area, distance, stiffness) = (1.0, 1e-3, young / 2.6 + WEIGHT);
    let (mut lower, mut upper) = (1e-6, 1.0);
    for _ in 0..200 {
        let middle = 0.5 * (lower + upper);
        *(if -area * stiffness * slope(middle) > WEIGHT { &mut lower } else { &mut upper }) = middle;
    }
    let error = contact.smallest_gap - lower * distance;
    // The middle of the side sinks deeper than its ends.
    assert!(error.abs() < WEIGHT / young, "{} and {}", contact.smallest_gap, lower * distance);
}

#[test]
fn a_body_that_touches_the_floor_at_the_start_comes_to_rest_on_it_with_every_method() {
    for method in dissipative() {
        let (dt, steps) = if is_implicit(method) { (0.02, 500) } else { (1e-3, 8000) };
        let tables = gravity(0.0, -9.81) + &floor(0.0, "friction = 0.3") + "[damping]\nbeta = 0.02\n";
        let mut simulation = build(&text(CUBE, "neo_hookean", 1e5, method, dt, &tables));
        for _ in 0..steps {
            run(&mut simulation, 1);
            assert!(simulation.contacts()[0].smallest_gap > 0.0, "{method}");
        }
        let force = contact_force(&simulation);
        assert!((force[1] - WEIGHT).abs() < 1e-5 * WEIGHT, "{method}: {force:?}");
        let nodes = simulation.contact_forces().unwrap();
        let sum: f64 = nodes.iter().skip(1).step_by(3).sum();
        assert!((sum - force[1]).abs() < 1e-9 * WEIGHT, "{method}");
        // All forces on the nodes, the contact's included, are in balance.
        assert!(simulation.nodal_forces().unwrap().amax() < 1e-4 * WEIGHT, "{method}");
    }
}

#[test]
fn quadratic_elements_come_to_rest_on_the_floor() {
    let (square, cube) =
        ("rectangle = { size = [1, 1], cells_per_unit = 2 }", "box = { size = [1, 1, 1], cells_per_unit = 1 }");
    for (mesh, method, dt, steps) in [
        (square, "implicit_euler", 0.02, 300),
        (square, "verlet", 5e-4, 8000),
        (cube, "implicit_euler", 0.02, 300),
        (cube, "verlet", 5e-4, 30000),
    ] {
        let mesh = &format!("{mesh}\norder = 2");
        let tables = gravity(0.0, -9.81) + &floor(-0.01, "friction = 0.3") + "[damping]\nbeta = 0.02\n";
        let mut simulation = build(&text(mesh, "neo_hookean", 1e5, method, dt, &tables));
        for _ in 0..steps {
            run(&mut simulation, 1);
            assert!(simulation.contacts()[0].smallest_gap > 0.0, "{method}");
        }
        let force = contact_force(&simulation);
        assert!((force[1] - WEIGHT).abs() < 1e-4 * WEIGHT, "{method}: {force:?}");
        assert!(simulation.nodal_forces().unwrap().amax() < 1e-3 * WEIGHT, "{method}");
    }
}

#[test]
fn the_impulses_of_the_planes_are_the_change_of_momentum_less_the_weight() {
    for method in METHODS {
        let dt = if is_implicit(method) { 5e-3 } else { 5e-4 };
        let wall = "[[planes]]\npoint = [-0.05, 0, 0]\nnormal = [1, 0.1, 0]\nfriction = 0.5\n";
        let start = "[[initial_velocity]]\nvelocity = [-1, -2, 0.5]\n";
        let tables = gravity(0.0, -9.81) + &floor(-0.05, "friction = 0.3") + wall + start;
        let mut simulation = build(&text(CUBE, "neo_hookean", 1e5, method, dt, &tables));
        let (before, mut impulse) = (momentum(&simulation), [0.0; 3]);
        let steps = 200;
        for _ in 0..steps {
            run(&mut simulation, 1);
            let force = contact_force(&simulation);
            (0..3).for_each(|i| impulse[i] += dt * force[i]);
        }
        let (after, time) = (momentum(&simulation), f64::from(steps) * dt);
        let expected = [0, 1, 2].map(|i| after[i] - before[i] + if i == 1 { WEIGHT * time } else { 0.0 });
        for i in 0..3 {
            assert!((impulse[i] - expected[i]).abs() < 1e-6 * 1000.0, "{method}: {impulse:?} {expected:?}");
        }
        assert!(expected[1] > 100.0, "{method}: the cube has not landed");
    }
}

/// A block of 1 × 0.5 × 1 m on a plane through its lower side, under gravity at an angle to its normal, rad.
fn touching(method: &str, young: f64, dt: f64, angle: f64) -> Simulator<f64> {
    let tables =
        gravity(9.81 * angle.sin(), -9.81 * angle.cos()) + &floor(0.0, if angle > 0.0 { "friction = 0.8" } else { "" });
    build(&text("box = { size = [1, 0.5, 1], cells_per_unit = 2 }", "stable_neo_hookean", young, method, dt, &tables))
}

#[test]
fn a_block_that_touches_its_plane_stays_there_with_every_method_and_step_and_gains_no_energy() {
    // m g h
    let height_energy = 0.5 * WEIGHT * 0.5;
    for method in METHODS {
        for (young, angle) in [(1e6, 0.0), (1e6, 0.3), (1e9, 0.0)] {
            let steps = match method {
                // At a higher rate its vibrations grow without damping.
                "explicit_euler" => continue,
                _ if is_implicit(method) => [4e-3, 1e-3, 2.5e-4],
                _ if young > 1e8 => continue,
                _ => [5e-4, 2e-4, 1e-4],
            };
            for dt in steps {
                let mut simulation = touching(method, young, dt, angle);
                let (d_hat, before) = (1e-3, simulation.energies().total());
                for _ in 0..(0.1 / dt) as usize {
                    run(&mut simulation, 1);
                    let gain = simulation.energies().total() - before;
                    assert!(gain < 0.01 * height_energy, "{method}, E = {young:e}, dt = {dt:e}: {gain} J");
                    let gap = simulation.contacts()[0].smallest_gap;
                    assert!(gap > 0.0 && gap < 1.001 * d_hat, "{method}, E = {young:e}, dt = {dt:e}: {gap:e} m");
                }
            }
        }
    }
}

#[test]
fn a_plane_that_is_touched_stands_back_to_where_its_barrier_bears_the_body_and_says_so() {
    for (gap, stands) in [(0.0, true), (5e-4, true), (9.99e-4, false)] {
        let tables = gravity(0.0, -9.81) + &floor(-gap, "");
        let simulation = build(&text(CUBE, "corotated", 1e6, "bdf2", 1e-3, &tables));
        let notes = simulation.notes();
        assert_eq!(notes.len(), usize::from(stands), "{notes:?}");
        if stands {
            let force = contact_force(&simulation)[1];
            assert!((force - WEIGHT).abs() < 1e-6 * WEIGHT, "{gap:e}: {force} N");
            assert!(
                notes[0].starts_with("planes[0] is nearer")
                    && notes[0].contains("stands back")
                    && notes[0].contains("9.810e3 N"),
                "{notes:?}"
            );
        }
    }
    // A load step finds its balance by itself, and impulses have no reach.
    let top = "[[prescribed]]\non = { axis = \"y\", side = \"max\", within = 1e-9 }\ndisplacement = [0, -0.01, 0]\n";
    for (method, tables) in [("static", top), ("verlet", "")] {
        let simulation = build(&text(CUBE, "corotated", 1e6, method, 1e-4, &(tables.to_owned() + &floor(0.0, ""))));
        assert!(simulation.notes().is_empty() && simulation.planes()[0].point.y == 0.0, "{method}");
    }
}

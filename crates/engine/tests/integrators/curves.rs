//! Loads and motions that change in time: impulses in closed form, prescribed positions.

use nalgebra::Vector3;

use crate::{DYNAMIC, build, distance, run, soft};

const DT: f64 = 0.01;
const STEPS: usize = 12;

/// ∫ factor dt by the rule that each method integrates with, s.
fn impulse(integrator: &str, factor: impl Fn(f64) -> f64) -> f64 {
    match integrator {
        "generalized_alpha" => return generalized_alpha(factor),
        "bdf2" => return bdf2(factor),
        "bathe" => return bathe(factor),
        _ => {}
    }
    let step = |k: usize| {
        let at = |part: f64| factor((k as f64 + part) * DT);
        match integrator {
            "explicit_euler" | "semi_implicit_euler" => at(0.0),
            "rk2" | "implicit_midpoint" => at(0.5),
            "rk4" => (at(0.0) + 4.0 * at(0.5) + at(1.0)) / 6.0,
            "verlet" | "newmark" => (at(0.0) + at(1.0)) / 2.0,
            _ => at(1.0),
        }
    };
    DT * (0..STEPS).map(step).sum::<f64>()
}

/// The trapezoidal rule up to the stage, and the backward formula through start, stage and end.
fn bathe(factor: impl Fn(f64) -> f64) -> f64 {
    let stage = 2.0 - 2f64.sqrt();
    let step = |v: f64, k: usize| {
        let at = |part: f64| factor((k as f64 + part) * DT);
        let middle = v + 0.5 * stage * DT * (at(0.0) + at(stage));
        // v' = c₁ v₀ + c₂ v_γ + c₃ v₁ at the end.
        let c = [(1.0 - stage) / stage, -1.0 / ((1.0 - stage) * stage), (2.0 - stage) / (1.0 - stage)];
        (DT * at(1.0) - c[0] * v - c[1] * middle) / c[2]
    };
    (0..STEPS).fold(0.0, step)
}

/// Chung and Hulbert's formulas for ρ∞ = 0.8.
fn generalized_alpha(factor: impl Fn(f64) -> f64) -> f64 {
    let rho = 0.8;
    let (of_mass, of_force) = ((2.0 * rho - 1.0) / (rho + 1.0), rho / (rho + 1.0));
    let gamma = 0.5 - of_mass + of_force;
    let (mut v, mut a) = (0.0, factor(0.0));
    for k in 0..STEPS {
        let next = (factor((k as f64 + 1.0 - of_force) * DT) - of_mass * a) / (1.0 - of_mass);
        v += DT * ((1.0 - gamma) * a + gamma * next);
        a = next;
    }
    v
}

/// The formula of two steps, and Alexander's method for the first.
fn bdf2(factor: impl Fn(f64) -> f64) -> f64 {
    let part = 1.0 - 0.5f64.sqrt();
    let (mut before, mut v) = (0.0, DT * ((1.0 - part) * factor(part * DT) + part * factor(DT)));
    for k in 1..STEPS {
        (before, v) = (v, (4.0 * v - before + 2.0 * DT * factor((k as f64 + 1.0) * DT)) / 3.0);
    }
    v
}

/// Mean velocity of the 2 m³ of the body after all steps, m/s: its momentum over its mass.
fn mean_velocity(integrator: &str, tables: &str) -> Vector3<f64> {
    let mut simulation = build(&soft(integrator, DT, tables));
    run(&mut *simulation, STEPS);
    let (v, masses) = (simulation.velocities(), crate::node_masses(&*simulation, 1000.0));
    let sum: Vector3<f64> = masses.iter().enumerate().map(|(i, m)| *m * v.fixed_rows::<3>(3 * i)).sum();
    sum / 2000.0
}

#[test]
fn the_impulse_of_each_load_is_the_integral_of_its_curve() {
    let ramp = |time: f64| (time / 0.07f64).clamp(0.0, 1.0);
    let sine = |time: f64| (std::f64::consts::TAU * 3.0 * time + 0.4).sin();
    let tables = "[gravity]\nacceleration = [0, -10, 0]\ncurve = { ramp = 0.07 }\n\
         [body_force]\ndensity = [500, 0, 0]\n\
         [[traction]]\non = { axis = \"z\", side = \"max\", within = 1e-9 }\nforce_per_area = [0, 0, 300]\n\
         curve = { sine = { frequency = 3, phase = 0.4 } }\n";
    for integrator in DYNAMIC {
        let found = mean_velocity(integrator, tables);
        let along = |size: f64, factor: &dyn Fn(f64) -> f64| size * impulse(integrator, factor);
        let expected = Vector3::new(along(0.5, &|_| 1.0), along(-10.0, &ramp), along(300.0 * 2.0 / 2000.0, &sine));
        assert!((found - expected).norm() < 1e-12, "{integrator}: {found} {expected}");
    }
}

#[test]
fn a_load_that_is_switched_off_before_the_end_leaves_the_momentum_that_it_gave() {
    // Verlet and RK4 evaluate at the switch itself, where the load is off.
    for (integrator, seconds) in [("explicit_euler", 0.06), ("verlet", 0.055), ("implicit_euler", 0.05)] {
        let found = mean_velocity(integrator, "[gravity]\nacceleration = [0, -10, 0]\ncurve = { off = 0.06 }\n");
        assert!((found - Vector3::new(0.0, -10.0 * seconds, 0.0)).norm() < 1e-12, "{integrator}: {found}");
    }
}

#[test]
fn a_pressure_has_its_factor_at_the_end_of_an_implicit_step() {
    let tables = "[[traction]]\non = { axis = \"x\", side = \"min\", within = 1e-9 }\npressure = 1000\n\
         curve = { table = [[0, 0], [0.01, 0.25], [0.02, 4]] }\n";
    let mut simulation = build(&soft("linearly_implicit_euler", DT, tables));
    run(&mut *simulation, 1);
    let (v, masses) = (simulation.velocities(), crate::node_masses(&*simulation, 1000.0));
    let momentum: f64 = masses.iter().enumerate().map(|(i, m)| m * v[3 * i]).sum();
    // 1000 Pa on 1 m², a quarter of it, for a step: the surface has not moved yet.
    assert!((momentum - 2.5).abs() < 1e-10, "{momentum}");
}

#[test]
fn a_prescribed_motion_follows_its_curve_under_every_method() {
    let tables = "[fixed]\nplane = { axis = \"x\", below = 1e-9 }\n[[prescribed]]\nnodes = [2]\n\
         displacement = [0.1, 0.2, 0]\ncurve = { sine = { frequency = 2 } }\n";
    for integrator in DYNAMIC {
        let mut simulation = build(&soft(integrator, 1e-3, tables));
        for step in 1..=40 {
            run(&mut *simulation, 1);
            let part = (std::f64::consts::TAU * 2.0 * 1e-3 * f64::from(step)).sin();
            let found: Vector3<f64> = simulation.positions().fixed_rows::<3>(6).into();
            let expected = Vector3::new(2.0 + 0.1 * part, 0.2 * part, 0.0);
            assert!((found - expected).norm() < 1e-13, "{integrator}, step {step}: {found}");
        }
    }
}

#[test]
fn a_curve_of_constant_1_changes_nothing() {
    for integrator in DYNAMIC {
        let end = |curve: &str| {
            let load = format!("[gravity]\nacceleration = [0, -10, 0]\n{curve}[fixed]\nnodes = [0, 3, 6, 9]\n");
            let mut simulation = build(&soft(integrator, 1e-3, &load));
            run(&mut *simulation, 30);
            simulation.positions()
        };
        assert_eq!(distance(&end(""), &end("curve = { table = [[0, 1]] }\n")), 0.0, "{integrator}");
    }
}

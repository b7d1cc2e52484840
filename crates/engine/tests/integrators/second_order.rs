//! Implicit methods of second order: orders, the damping of fast vibrations, and what they conserve.

use nalgebra::DVector;

use fem_engine::simulator::Simulator;
use fem_model::simulation::Simulation;
use nalgebra::Vector3;

use crate::vibrations::{frequency, oscillator};
use crate::{SECOND_ORDER, build, distance, node_masses, of_kuhn, of_law, run, scene, soft};

const EXTERNAL: &str = r#"[gravity]
acceleration = [0, -20, 3]
[drag]
vertex = 5
stiffness = 2e3
direction = [1, 0, 0.5]
amplitude = 0.3
frequency = 2.0
[newton]
tolerance = 1e-14
"#;

const CLAMP: &str = "[fixed]\nplane = { axis = \"x\", below = 1e-9 }\n";

const DAMPING: &str = "[damping]\nalpha = 2.0\nbeta = 0.004\n";

const PRESSURE: &str = "[[traction]]\non = { axis = \"x\", side = \"max\", within = 1e-9 }\npressure = 4e3\n";

/// A side that turns and moves at a changing speed.
const MOTION: &str = "[[prescribed]]\non = { axis = \"x\", side = \"min\", within = 1e-9 }\ndisplacement = [0.1, 0.2, 0]\n\
                      rotation = { axis = \"x\", center = [0, 0.3, 0.4], turns = 0.1 }\n\
                      curve = { sine = { frequency = 1.5 } }\n";

/// Positions and velocities after so many steps of 0.2 s in all.
fn end(integrator: &str, steps: usize, rest: &str) -> DVector<f64> {
    let mut simulation = build(&of_kuhn(&soft(integrator, 0.2 / steps as f64, rest)));
    run(&mut *simulation, steps);
    let (q, v) = (simulation.positions(), simulation.velocities());
    DVector::from_iterator(q.len() + v.len(), q.iter().chain(v.iter()).copied())
}

/// The order between 160 and 320 steps, against a method of the family with many more, which other tests compare with others.
fn order(integrator: &str, reference: &DVector<f64>, rest: &str) -> f64 {
    let errors = [160, 320].map(|steps| distance(&end(integrator, steps, rest), reference));
    println!("{integrator}: {errors:?}");
    (errors[0] / errors[1]).log2()
}

#[test]
fn their_order_is_two_with_damping_pressure_and_prescribed_motion() {
    let cases = [
        ("clamped", format!("{EXTERNAL}{CLAMP}")),
        ("damped", format!("{EXTERNAL}{CLAMP}{DAMPING}")),
        ("pressed", format!("{EXTERNAL}{CLAMP}{PRESSURE}")),
        ("moved", format!("{EXTERNAL}{MOTION}")),
        ("all", format!("{EXTERNAL}{MOTION}{DAMPING}{PRESSURE}")),
    ];
    for (name, rest) in cases {
        let newton = rest.find("[newton]").unwrap();
        let explicit = rest[..newton].to_owned() + rest[newton..].split_once("1e-14\n").unwrap().1;
        let reference = if rest.contains("[[prescribed]]") {
            end("implicit_midpoint", 20_000, &rest)
        } else {
            end("rk4", 2000, &explicit)
        };
        for integrator in SECOND_ORDER {
            let measured = order(integrator, &reference, &rest);
            println!("{name} {integrator}: {measured}");
            assert!((measured - 2.0).abs() < 0.05, "{integrator}, {name}: order {measured}");
        }
    }
}

/// Distances from rest, over the first one, of a vibration that is much faster than the step.
fn distances(integrator: &str, rest: &str) -> [f64; 4] {
    let text = oscillator(integrator, 1e4 / frequency(), &format!("[newton]\ntolerance = 2e-15\n{rest}"));
    // A linear spring, whose node starts 1 m from its other end.
    let scene = scene(&text.replace("stiffness = 1e6", "stiffness = 1e6\nrest_length = 0"));
    let body = fem_scene::body(&scene, std::path::Path::new("no data")).unwrap();
    let mut simulation = Simulator::<f64>::new(body, &scene.method()).unwrap();
    simulation.accept_gain(true);
    let mut away = || {
        run(&mut simulation, 1);
        simulation.positions()[15] - 1.0 - 1.0 / frequency().powi(2)
    };
    [0; 4].map(|_| away())
}

#[test]
fn vibrations_faster_than_the_step_are_damped_as_the_theory_of_each_method_says() {
    for rho in [0.0, 0.3, 0.5, 0.8, 0.9, 1.0] {
        let d = distances("generalized_alpha", &format!("[generalized_alpha]\nspectral_radius = {rho}\n"));
        // The start has no acceleration of such vibrations, so each distance is −ρ∞ times the one before.
        let error = match rho {
            0.0 => d.iter().fold(0.0, |most: f64, d| most.max(d.abs())),
            _ => f64::max((d[1] / d[0] + rho).abs(), (d[2] / d[1] + rho).abs()),
        };
        println!("ρ∞ = {rho}: error {error:e}");
        assert!(error.abs() < 1e-6, "{error:e} for {rho}");
    }
    for integrator in ["implicit_midpoint", "newmark"] {
        let d = distances(integrator, "");
        assert!((d[3] / d[2] + 1.0).abs() < 1e-6 && d[3].abs() > 0.5, "{integrator}: {d:?}");
    }
    for integrator in ["bdf2", "bathe"] {
        let d = distances(integrator, "");
        assert!(d.iter().all(|d| d.abs() < 1e-6), "{integrator}: {d:?}");
    }
}

/// A free body that turns at 1 rad/s and vibrates.
const TURNING: &str = "[[initial_velocity]]\nangular = { axis = [0.3, 1, 0.2], rate = 1.0 }\nvelocity = [0.1, 0, 0.2]\n\
                       [mass]\nlumped = true\n[newton]\ntolerance = 1e-14\n";

/// Σ m v, Σ m x × v of a lumped body.
fn momenta(simulation: &dyn Simulation) -> [Vector3<f64>; 2] {
    let (x, v) = (simulation.positions(), simulation.velocities());
    let at = |of: &DVector<f64>, node: usize| Vector3::from(of.fixed_rows::<3>(3 * node));
    node_masses(simulation, 1000.0).into_iter().enumerate().fold([Vector3::zeros(); 2], |[linear, angular], (i, m)| {
        [linear + m * at(&v, i), angular + m * at(&x, i).cross(&at(&v, i))]
    })
}

#[test]
fn the_midpoint_rule_keeps_momentum_angular_momentum_and_energy_of_a_turning_body() {
    let mut simulation = build(&soft("implicit_midpoint", 1e-4, TURNING));
    let ([linear, angular], energy) = (momenta(&*simulation), simulation.energies().total());
    let mut worst: f64 = 0.0;
    for _ in 0..10_000 {
        run(&mut *simulation, 1);
        worst = worst.max((simulation.energies().total() / energy - 1.0).abs());
    }
    let [linear, angular] = [(linear, 0), (angular, 1)]
        .map(|(before, which)| (momenta(&*simulation)[which] - before).norm() / before.norm());
    println!("energy {worst:e}, momentum {linear:e}, angular momentum {angular:e}");
    assert!(simulation.energies().potential > 1e-4 * energy, "the body is deformed");
    assert!(worst < 1e-8 && linear < 1e-12 && angular < 1e-10, "{worst:e} {linear:e} {angular:e}");
}

#[test]
fn energy_changes_by_what_damping_takes() {
    let tables = "[gravity]\nacceleration = [1, -3, 2]\n[damping]\nalpha = 2.0\n[mass]\nlumped = true\n\
                  [newton]\ntolerance = 1e-14\n";
    for integrator in ["implicit_midpoint", "newmark"] {
        let mut simulation = build(&of_law("linear", &soft(integrator, 0.01, &format!("{tables}{CLAMP}"))));
        let masses = node_masses(&*simulation, 1000.0);
        let (start, mut lost, mut largest) = (simulation.energies().total(), 0.0, 0.0f64);
        for _ in 0..200 {
            let before = simulation.velocities();
            run(&mut *simulation, 1);
            let mean = 0.5 * (before + simulation.velocities());
            let square: f64 = masses.iter().enumerate().map(|(i, m)| m * mean.rows(3 * i, 3).norm_squared()).sum();
            lost += 0.01 * 2.0 * square;
            largest = largest.max(simulation.energies().kinetic);
        }
        let missing = simulation.energies().total() + lost - start;
        println!("{integrator}: {missing:e} J of {largest} J, {lost} J lost");
        assert!(lost > largest && missing.abs() < 1e-9 * largest, "{integrator}: {missing:e} J");
    }
}

#[test]
fn each_step_can_be_repeated_from_its_start() {
    // Friction repeats steps: a method that moved on with each repetition would leave its order.
    let floor = "[[planes]]\npoint = [0, -0.002, 0]\nnormal = [0, 1, 0]\nfriction = 0.5\n\
                 [gravity]\nacceleration = [2, -10, 0]\n";
    for integrator in SECOND_ORDER.into_iter().filter(|integrator| *integrator != "bathe") {
        let mut simulation = build(&soft(integrator, 2e-3, floor));
        let start = simulation.positions();
        run(&mut *simulation, 150);
        let lowest =
            (0..start.len() / 3).map(|node| simulation.positions()[3 * node + 1]).fold(f64::INFINITY, f64::min);
        assert!(lowest > -0.002, "{integrator}: {lowest}");
        assert!(simulation.lag_residual().unwrap() < 1e-2, "{integrator}");
        let slid = simulation.positions()[0] - start[0];
        assert!(slid < 0.5 * 2.0 * 0.09, "{integrator}: friction lets it slide {slid} m");
    }
}

#[test]
fn planes_are_refused_with_bathes_method() {
    let floor = "[[planes]]\npoint = [0, -0.002, 0]\nnormal = [0, 1, 0]\n";
    let message = fem_scene::parse(&soft("bathe", 1e-3, floor), "floor.toml".as_ref()).unwrap_err().to_string();
    assert!(message.contains("planes stand beside time.integrator = \"bathe\""), "{message}");
}

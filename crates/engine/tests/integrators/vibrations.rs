//! One node on one spring: limits of stability, damping.

use fem_model::simulation::Simulation;
use nalgebra::Complex;

use crate::{build, node_masses};

/// A box with one free node. Its material is so soft that only an anchor spring along x acts on that node.
pub fn oscillator(integrator: &str, dt: f64, damping: &str) -> String {
    format!(
        r#"pipeline = "engine"
[mesh]
box = {{ size = [2, 1, 1], cells_per_unit = 1 }}
[material]
model = "linear"
young = 1e-9
poisson = 0.0
density = 1000.0
[mass]
lumped = true
[gravity]
acceleration = [1, 0, 0]
[fixed]
nodes = [0, 1, 2, 3, 4, 6, 7, 8, 9, 10, 11]
[[springs]]
nodes = [4, 5]
stiffness = 1e6
[time]
dt = {dt:e}
integrator = "{integrator}"
{damping}"#
    )
}

/// √(k/m), 1/s.
pub fn frequency() -> f64 {
    let masses = node_masses(&*build(&oscillator("verlet", 1.0, "")), 1000.0);
    (1e6 / masses[5]).sqrt()
}

/// Newmark's method with the most accurate periods.
const FOX_GOODWIN: &str = "[newmark]\nbeta = 0.083333333333333\n";

/// Largest distance from rest in the last of many steps, over that of the true motion.
fn swing(integrator: &str, z: f64, rest: &str) -> f64 {
    let omega = frequency();
    let mut simulation = build(&oscillator(integrator, z / omega, rest));
    let largest = 2.0 / (omega * omega);
    let mut swing: f64 = 0.0;
    for step in 0..4000 {
        if simulation.step().is_err() {
            return f64::INFINITY;
        }
        if step > 3900 {
            swing = swing.max((simulation.positions()[15] - 2.0).abs() / largest);
        }
    }
    swing
}

#[test]
fn methods_are_stable_up_to_their_limit_and_not_beyond() {
    let limit = 8f64.sqrt();
    for (integrator, stable, rest) in [
        ("verlet", 2.0, ""),
        ("semi_implicit_euler", 2.0, ""),
        ("rk4", limit, ""),
        ("newmark", 6f64.sqrt(), FOX_GOODWIN),
        ("newmark", 12f64.sqrt(), "[newmark]\nbeta = 0.166666666667\n"),
    ] {
        let (below, above) = (swing(integrator, 0.99 * stable, rest), swing(integrator, 1.01 * stable, rest));
        assert!(below < 20.0 && above > 1e3, "{integrator} {rest}: {below} below, {above} above");
    }
    for integrator in ["rk2", "explicit_euler"] {
        let at = swing(integrator, 0.5, "");
        assert!(at > 1e3, "{integrator} does not grow: {at}");
    }
    for integrator in ["linearly_implicit_euler", "implicit_euler", "generalized_alpha", "bdf2", "bathe"] {
        let at = swing(integrator, 50.0, "");
        assert!(at < 1.0, "{integrator}: {at}");
    }
}

/// Distance from x(t) = x∞ (1 − cos ωt), over x∞, after 62 rad, about 10 periods.
fn distance_of_newmark(steps_per_radian: f64, rest: &str) -> f64 {
    let omega = frequency();
    let mut simulation = build(&oscillator("newmark", 1.0 / (omega * steps_per_radian), rest));
    for _ in 0..(62.0 * steps_per_radian) as usize {
        simulation.step().unwrap();
    }
    ((simulation.positions()[15] - 2.0) * omega * omega - (1.0 - (omega * simulation.time()).cos())).abs()
}

#[test]
fn vibrations_by_newmarks_method_are_of_fourth_order_where_beta_is_a_twelfth() {
    for (rest, expected) in [("", 2.0), (FOX_GOODWIN, 4.0)] {
        let rest = format!("{rest}[newton]\ntolerance = 1e-14\n");
        let [coarse, fine] = [20.0, 40.0].map(|steps| distance_of_newmark(steps, &rest));
        let order = (coarse / fine).log2();
        assert!((order - expected).abs() < 0.1, "{rest}: {coarse:e} and {fine:e}, order {order}");
    }
}

/// Largest distance from x(t) = x∞ (1 − e^(−γt) (cos ω't + γ/ω' sin ω't)), over x∞.
fn damping_error(integrator: &str, alpha: f64, beta: f64, steps_per_radian: f64) -> f64 {
    let omega = frequency();
    let dt = 1.0 / (omega * steps_per_radian);
    let damping = format!("[damping]\nalpha = {:e}\nbeta = {:e}\n", alpha * omega, beta / omega);
    let mut simulation = build(&oscillator(integrator, dt, &damping));
    let gamma = 0.5 * (alpha + beta) * omega;
    let damped = (omega * omega - gamma * gamma).sqrt();
    let mut worst: f64 = 0.0;
    for _ in 0..(20.0 * steps_per_radian) as usize {
        simulation.step().unwrap();
        let t = simulation.time();
        let decay = (-gamma * t).exp() * ((damped * t).cos() + gamma / damped * (damped * t).sin());
        worst = worst.max(((simulation.positions()[15] - 2.0) * omega * omega - (1.0 - decay)).abs());
    }
    worst
}

#[test]
fn damping_decays_at_its_rate() {
    for (alpha, beta) in [(0.1, 0.0), (0.0, 0.1), (0.05, 0.1)] {
        for (integrator, steps, tolerance) in [
            ("rk4", 40.0, 1e-6),
            ("verlet", 200.0, 1e-4),
            ("rk2", 200.0, 1e-4),
            ("implicit_midpoint", 200.0, 1e-4),
            ("newmark", 200.0, 1e-4),
            ("generalized_alpha", 200.0, 1e-4),
            ("bdf2", 200.0, 1e-3),
            ("bathe", 200.0, 1e-4),
            ("semi_implicit_euler", 400.0, 5e-3),
            ("implicit_euler", 400.0, 2e-2),
            ("linearly_implicit_euler", 400.0, 2e-2),
        ] {
            let error = damping_error(integrator, alpha, beta, steps);
            assert!(error < tolerance, "{integrator}, {alpha} and {beta}: {error:e}");
        }
    }
}

/// The factor by which Bathe's method multiplies the amplitude of a vibration in a step, z = ω dt: |R(iz)| of its stability function.
pub fn bathes_factor(z: f64) -> f64 {
    let stage = 2.0 - 2f64.sqrt();
    let half = Complex::new(0.0, 0.5 * stage * z);
    let at_stage = (1.0 + half) / (1.0 - half);
    let c = [(1.0 - stage) / stage, -1.0 / ((1.0 - stage) * stage), (2.0 - stage) / (1.0 - stage)];
    ((-c[0] - c[1] * at_stage) / (c[2] - Complex::new(0.0, z))).norm()
}

/// Amplitudes of a slow and of a fast vibration after so many steps, relative to those at the start: √(ω² x² + v²) of two nodes on linear
/// springs, of which the second one is 10⁴ times as stiff.
fn amplitudes(integrator: &str, z: f64, steps: usize) -> [f64; 2] {
    let slow = frequency();
    let text = oscillator(integrator, z / slow, "[newton]\ntolerance = 1e-12\n")
        .replace("nodes = [0, 1, 2, 3, 4, 6,", "nodes = [0, 1, 2, 4, 6,")
        .replace(
            "stiffness = 1e6",
            "stiffness = 1e6\nrest_length = 0\n[[springs]]\nnodes = [4, 3]\nstiffness = 1e10\nrest_length = 0",
        );
    let mut simulation = build(&text);
    let masses = node_masses(&*simulation, 1000.0);
    let of = |simulation: &dyn Simulation, node: usize, stiffness: f64| {
        let square = stiffness / masses[node];
        // Gravity is 1 m/s².
        let x = simulation.positions()[3 * node] - 1.0 - 1.0 / square;
        (square * x * x + simulation.velocities()[3 * node].powi(2)).sqrt()
    };
    let both = |simulation: &dyn Simulation| [of(simulation, 5, 1e6), of(simulation, 3, 1e10)];
    let start = both(&*simulation);
    (0..steps).for_each(|_| simulation.step().unwrap());
    let end = both(&*simulation);
    [0, 1].map(|mode| end[mode] / start[mode])
}

#[test]
fn bathes_method_ends_fast_vibrations_and_keeps_slow_ones_as_its_stability_function_says() {
    let masses = node_masses(&*build(&oscillator("verlet", 1.0, "")), 1000.0);
    let ratio = (1e4 * masses[5] / masses[3]).sqrt();
    for z in [0.02, 0.1, 0.5, 2.0] {
        let [slow, fast] = amplitudes("bathe", z, 4);
        let expected = [z, ratio * z].map(|z| bathes_factor(z).powi(4));
        println!("{z}: {slow:e}, {fast:e}, expected {expected:?}");
        assert!(
            (slow - expected[0]).abs() < 1e-8 && (fast - expected[1]).abs() < 1e-8,
            "{z}: {slow} {fast} {expected:?}"
        );
    }
    // In 40 steps the generalized-α method with ρ∞ = 0.8 leaves 0.8⁴⁰ = 1e-4 of the fast vibration.
    let (bathe, alpha) = (amplitudes("bathe", 0.1, 40), amplitudes("generalized_alpha", 0.1, 40));
    println!("{bathe:?} {alpha:?}");
    assert!(bathe[1] < 1e-6 && alpha[1] > 1e-5, "{bathe:?} {alpha:?}");
}

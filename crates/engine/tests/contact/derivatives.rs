//! Gradient and Hessian of contact and friction against finite differences.

use fem_engine::forces::{HessianKind, Moment, Potential};
use fem_model::simulation::{Diagnostics, Simulation};

use crate::{CUBE, build, floor, gravity, run, text};

/// Numbers in −1…1 from a fixed seed: a linear congruential generator.
fn numbers(mut seed: u64) -> impl FnMut() -> f64 {
    move || {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (seed >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }
}

/// A cube that slides over a floor and along a slanting wall.
fn sliding() -> String {
    let wall = "[[planes]]\npoint = [-0.0001, 0, 0]\nnormal = [1, 0.2, 0.1]\nfriction = 0.7\n";
    let contact = "[contact]\nactivation_distance = 0.05\ntransition_speed = 0.1\n";
    let start = "[[initial_velocity]]\nvelocity = [-0.02, 0, 0.08]\n";
    let rest = gravity(0.0, -9.81) + &floor(-0.01, "friction = 0.4") + wall + contact + start;
    text(CUBE, "neo_hookean", 1e5, "implicit_euler", 0.01, &rest)
}

type Vectors = Vec<[f64; 3]>;

fn gradient(force: &dyn Potential<f64>, u: &Vectors, moment: Moment) -> Vectors {
    let mut gradient = vec![[0.0; 3]; u.len()];
    force.add_gradient(u, moment, &mut gradient);
    gradient
}

fn moved(u: &Vectors, h: f64, direction: &Vectors) -> Vectors {
    u.iter().zip(direction).map(|(u, d)| std::array::from_fn(|i| u[i] + h * d[i])).collect()
}

fn dot(a: &Vectors, b: &Vectors) -> f64 {
    a.as_flattened().iter().zip(b.as_flattened()).map(|(a, b)| a * b).sum()
}

#[test]
fn gradient_and_hessian_of_contact_and_friction_are_the_derivatives_of_their_energies() {
    const SEED: u64 = 7;
    let mut simulation = build(&sliding());
    run(&mut simulation, 3);
    let mut number = numbers(SEED);
    let mut vectors = |nodes: usize| -> Vectors { (0..nodes).map(|_| [number(), number(), number()]).collect() };
    let (system, moment) = (simulation.system(), Moment::at(simulation.time()));
    for name in ["contact", "friction"] {
        let force = system.forces.active().find(|(force, _)| force.name() == name).unwrap().0;
        for round in 0..20 {
            let u = moved(&simulation.state().u, 2e-4, &vectors(system.nodes()));
            let d = vectors(system.nodes());
            let h = 1e-7;
            let at = |h: f64| moved(&u, h, &d);
            let energy = |h: f64| force.energy(&at(h), moment).value;
            assert!(energy(0.0).is_finite() && energy(0.0) > 0.0, "{name}, round {round}, seed {SEED}");
            let slope = dot(&gradient(force, &u, moment), &d);
            let by_differences = (energy(h) - energy(-h)) / (2.0 * h);
            assert!((slope - by_differences).abs() < 1e-6 * slope.abs().max(1.0), "{name}: {slope} {by_differences}");
            let mut product = vec![[0.0; 3]; u.len()];
            force.add_hessian_times(1.0, &u, moment, &d, &mut product);
            let difference = moved(&gradient(force, &at(h), moment), -1.0, &gradient(force, &at(-h), moment));
            let error = moved(&product, -0.5 / h, &difference);
            let size = dot(&product, &product).sqrt();
            assert!(dot(&error, &error).sqrt() < 1e-5 * size, "{name}, round {round}, seed {SEED}");
            assert!(dot(&d, &product) >= 0.0, "{name}: the Hessian is not positive semi-definite");
            assert_matrix(system, force, (&u, moment), &d, &product);
        }
    }
}

/// The assembled Hessian times d is the product without a matrix.
fn assert_matrix(
    system: &fem_engine::model::system::System<f64>,
    force: &dyn Potential<f64>,
    (u, moment): (&Vectors, Moment),
    d: &Vectors,
    product: &Vectors,
) {
    let mut values = vec![[[0.0; 3]; 3]; system.pattern.blocks()];
    force.add_hessian(1.0, u, moment, HessianKind::Projected, &system.pattern, &mut values);
    for (node, block) in system.pattern.diagonal().enumerate() {
        for i in 0..3 {
            let row: f64 = (0..3).map(|j| values[block][i][j] * d[node][j]).sum();
            assert!((row - product[node][i]).abs() <= 1e-12 * (1.0 + product[node][i].abs()), "node {node}");
        }
    }
}

#[test]
fn the_largest_step_ends_at_the_first_plane_and_a_guess_behind_it_is_moved_out() {
    let mut simulation = build(&sliding());
    run(&mut simulation, 1);
    let (system, u) = (simulation.system(), &simulation.state().u);
    let down = vec![[0.0, -1.0, 0.0]; u.len()];
    let gap = simulation.contacts()[0].smallest_gap;
    let contact = system.forces.active().find(|(force, _)| force.name() == "contact").unwrap().0;
    // The wall slants, so that sinking along it opens no gap.
    let wall = simulation.contacts()[1].smallest_gap;
    let slant = 0.2 / (1.0f64 + 0.04 + 0.01).sqrt();
    let expected = gap.min(wall / slant);
    let end = Moment::at(simulation.time());
    let found = system.largest_step(u, end, &down);
    assert!((found - expected).abs() < 1e-9, "{found} {expected}");
    let mut guess: Vectors = down.iter().map(|d| d.map(|d| 0.3 * d)).collect();
    assert!(contact.barrier().unwrap().make_feasible(u, end, &mut guess));
    assert!(contact.energy(&moved(u, 1.0, &guess), end).value.is_finite());
}

//! Gravity towards a point: its derivatives, orbits, softening, and what is refused.

use std::f64::consts::TAU;
use std::path::Path;

use fem_engine::forces::{HessianKind, Moment};
use fem_engine::simulator::Simulator;
use fem_mesh::{Pattern, box_mesh};
use fem_model::simulation::Simulation;
use fem_model::{Body, CentralGravity, Elastic, Integrator, Law, Material, Method};
use nalgebra::{DVector, Vector3};

use crate::{SECOND_ORDER, build, run, scene, try_build};

/// A cube of 0.1 m about (0.05, 0.05, 0.05) m that starts with a velocity along y, m/s.
fn cube(integrator: &str, dt: f64, speed: f64, gravity: &str) -> String {
    format!(
        "pipeline = \"engine\"\n[mesh]\nbox = {{ size = [0.1, 0.1, 0.1], cells_per_unit = 10 }}\n[material]\nmodel = \"neo_hookean\"\n\
         young = 1e6\npoisson = 0.3\ndensity = 1000.0\n[[initial_velocity]]\nvelocity = [0, {speed}, 0]\n[time]\ndt = {dt:e}\n\
         integrator = \"{integrator}\"\n[central_gravity]\n{gravity}"
    )
}

/// A point 10 m before the cube, whose circular orbit has a speed of 10 m/s.
const PLANET: &str = "center = [-9.95, 0.05, 0.05]\nstrength = 1000\n";

/// Mean position of the nodes.
fn middle(q: &DVector<f64>) -> Vector3<f64> {
    (0..q.len() / 3).map(|node| Vector3::from(q.fixed_rows::<3>(3 * node))).sum::<Vector3<f64>>() / (q.len() / 3) as f64
}

#[test]
fn a_small_stiff_body_returns_after_keplers_period_with_its_energy_and_angular_momentum() {
    let (r, speed, strength) = (10.0, 8.0, 1000.0);
    let axis: f64 = 1.0 / (2.0 / r - speed * speed / strength);
    let period = TAU * (axis.powi(3) / strength).sqrt();
    let steps = 8000;
    for (integrator, most) in [("verlet", 1e-4), ("rk4", 1e-4)].into_iter().chain(SECOND_ORDER.map(|name| (name, 1e-3)))
    {
        let mut simulation = build(&cube(integrator, period / f64::from(steps), speed, PLANET));
        let center = Vector3::new(-9.95, 0.05, 0.05);
        let spin = |simulation: &dyn Simulation| {
            (middle(&simulation.positions()) - center).cross(&middle(&simulation.velocities()))
        };
        let (start, before) = (middle(&simulation.positions()), spin(&*simulation));
        let (energy, kinetic) = (simulation.energies().total(), simulation.energies().kinetic);
        let (mut drift, mut nearest) = (0f64, r);
        for _ in 0..steps {
            run(&mut *simulation, 1);
            drift = drift.max((simulation.energies().total() - energy).abs() / kinetic);
            nearest = f64::min(nearest, (middle(&simulation.positions()) - center).norm());
        }
        let missed = (middle(&simulation.positions()) - start).norm() / r;
        let lost = (spin(&*simulation) - before).norm() / before.norm();
        println!(
            "{integrator}: {missed:.1e} of the distance, energy {drift:.1e}, angular momentum {lost:.1e}, nearest {nearest}"
        );
        // The cube is a point up to (0.1 m/10 m)².
        assert!(missed < 2e-3 && drift < most && lost < most, "{integrator}: {missed:e} {drift:e} {lost:e}");
        assert!((nearest - (2.0 * axis - r)).abs() < 1e-2, "{integrator}: {nearest}");
    }
}

#[test]
fn in_the_core_of_a_softened_point_a_body_swings_as_a_pendulum() {
    // −μ d/ε³: half a period takes the body to the other side.
    let (softening, strength): (f64, f64) = (2.0, 50.0);
    let half = 0.5 * TAU * (softening.powi(3) / strength).sqrt();
    let gravity = format!("center = [0.06, 0.05, 0.05]\nstrength = {strength}\nsoftening = {softening}\n");
    let mut simulation = build(&cube("implicit_midpoint", half / 1000.0, 0.0, &gravity));
    run(&mut *simulation, 1000);
    let x = middle(&simulation.positions()).x;
    assert!((x - 0.07).abs() < 5e-5, "{x}");
}

#[test]
fn gradient_and_hessian_are_the_derivatives_of_the_energy() {
    let gravity = "center = [0.3, -0.2, 0.1]\nstrength = 20\nsoftening = 0.1\n";
    for gravity in [gravity, &gravity.replace("0.1\n", "0\n")] {
        let scene = scene(&cube("implicit_euler", 0.01, 0.0, gravity));
        let body = fem_scene::body(&scene, Path::new("no data")).unwrap();
        let simulation = Simulator::<f64>::new(body, &scene.method()).unwrap();
        let force = simulation.system().forces.active().find(|(force, _)| force.name() == "central_gravity").unwrap().0;
        let (nodes, moment) = (simulation.system().nodes(), Moment::at(0.0));
        let vectors = |seed: f64, size: f64| -> Vec<[f64; 3]> {
            (0..nodes)
                .map(|node| [0, 1, 2].map(|i| size * (seed + 7.3 * node as f64 + 2.1 * f64::from(i)).sin()))
                .collect()
        };
        let dot = |a: &[[f64; 3]], b: &[[f64; 3]]| -> f64 {
            a.iter().flatten().zip(b.iter().flatten()).map(|(a, b)| a * b).sum()
        };
        assert_eq!(force.energy(&vec![[0.0; 3]; nodes], moment).value, 0.0);
        for seed in 0..10 {
            let (u, d) = (vectors(f64::from(seed), 0.1), vectors(100.0 + f64::from(seed), 1.0));
            let at = |h: f64| -> Vec<[f64; 3]> {
                u.iter().zip(&d).map(|(u, d)| [0, 1, 2].map(|i| u[i] + h * d[i])).collect()
            };
            let gradient = |u: &[[f64; 3]]| {
                let mut gradient = vec![[0.0; 3]; nodes];
                force.add_gradient(u, moment, &mut gradient);
                gradient
            };
            let h = 1e-5;
            let slope = dot(&gradient(&u), &d);
            let by_differences = (force.energy(&at(h), moment).value - force.energy(&at(-h), moment).value) / (2.0 * h);
            assert!((slope - by_differences).abs() < 1e-6 * slope.abs(), "{slope} and {by_differences}");
            let mut product = vec![[0.0; 3]; nodes];
            force.add_hessian_times(1.0, &u, moment, &d, &mut product);
            let (after, before) = (gradient(&at(h)), gradient(&at(-h)));
            for (found, (after, before)) in
                product.iter().flatten().zip(after.iter().flatten().zip(before.iter().flatten()))
            {
                let expected = (after - before) / (2.0 * h);
                assert!((found - expected).abs() < 1e-5 * dot(&product, &product).sqrt(), "{found} and {expected}");
            }
            let mut curvature = 0.0;
            force.hessian(&u, moment, HessianKind::Projected, &mut |row, column, block| {
                curvature += [0, 1, 2]
                    .map(|i| d[row][i] * [0, 1, 2].map(|j| block[i][j] * d[column][j]).iter().sum::<f64>())
                    .iter()
                    .sum::<f64>();
            });
            assert!(curvature >= 0.0, "{curvature}");
        }
    }
}

#[test]
fn what_has_no_force_is_refused() {
    let refused = |gravity: &str| {
        let text = cube("implicit_euler", 0.01, 0.0, gravity);
        match fem_scene::parse(&text, Path::new("orbit.toml")) {
            Err(error) => error.to_string(),
            Ok(_) => try_build(&text).err().expect("a refusal").to_string(),
        }
    };
    for (gravity, expected) in [
        (
            "center = [9, 0, 0]\nstrength = -1",
            "line 16: central_gravity.strength is -1; give a positive number of m³/s²",
        ),
        ("center = [9, 0, 0]\nstrength = nan", "central_gravity.strength is NaN; give a positive number of m³/s²"),
        ("center = [nan, 0, 0]\nstrength = 1", "central_gravity.center is NaN; give finite numbers"),
        ("center = [9, 0, 0]\nstrength = 1\nsoftening = -1", "central_gravity.softening is -1; give 0 m or more"),
        (
            "center = [0, 0, 0]\nstrength = 1",
            "central_gravity.center lies on node 0, where the force is infinite; move it, or give central_gravity.softening",
        ),
        ("center = [9, 0, 0]\nstrength = 1\nmass = 1", "unknown field `mass`"),
    ] {
        let message = refused(gravity);
        assert!(message.contains(expected), "{gravity}: {message}");
    }
    build(&cube("implicit_euler", 0.01, 0.0, "center = [0, 0, 0]\nstrength = 1\nsoftening = 0.1\n"));
}

#[test]
fn a_body_made_by_a_program_falls_towards_two_points_as_the_scene_says() {
    let soft = Material::new(Law::StableNeoHookean(Elastic::new(1e6, 0.3)), 1000.0);
    let mesh = box_mesh([0.1; 3], 10, Pattern::default()).unwrap();
    let body = Body::new(mesh, soft).unwrap();
    let on_a_node = body.clone().field(CentralGravity::new([0.1, 0.0, 0.0], 1.0)).unwrap_err();
    assert!(on_a_node.to_string().contains("lies on node 1"), "{on_a_node}");
    // Two equal points on both sides of the cube leave its middle where it is.
    let body = body.field(CentralGravity::new([3.05, 0.05, 0.05], 10.0)).unwrap();
    let body = body.field(CentralGravity::new([-2.95, 0.05, 0.05], 10.0)).unwrap();
    let mut simulation = fem_engine::simulator::build(body, &Method::new(Integrator::ImplicitEuler, 0.01)).unwrap();
    run(&mut *simulation, 20);
    assert!((middle(&simulation.positions()) - Vector3::repeat(0.05)).norm() < 1e-9);
    let parts = simulation.parts();
    let part = parts.iter().find(|part| part.name == "central_gravity").unwrap();
    assert!(part.built && part.why.contains("μ = 1.0000e1 m³/s²"), "{}", part.why);
}

//! Stiffness-proportional damping: it brakes vibrations and no rigid motion, and depends on no rounding error.

use fem_engine::simulator::double::{self, System};
use fem_engine::solvers::SolverChoice;
use fem_model::element::shares::lumped_mass_shares;
use fem_model::simulation::Simulation;
use nalgebra::{Matrix3, Vector3};
use std::f64::consts::PI;

use crate::{build, of_kuhn, of_law, run, scene, soft};

const BOX: &str = "box = { size = [1.5, 0.5, 0.5], cells_per_unit = 4 }";
const RECTANGLE: &str = "rectangle = { size = [1.5, 0.5], cells_per_unit = 4 }";
const LAWS: [&str; 9] = [
    "corotated",
    "st_venant_kirchhoff",
    "neo_hookean",
    "stable_neo_hookean",
    "hencky",
    "mooney_rivlin",
    "yeoh",
    "gent",
    "ogden",
];

/// A body with E = 1e5 Pa and ν = 0.3; `rest` are further tables.
fn body(law: &str, mesh: &str, integrator: &str, dt: f64, rest: &str) -> String {
    let text = of_law(law, &soft(integrator, dt, rest));
    text.replace("box = { size = [2, 1, 1], cells_per_unit = 1 }", mesh)
}

/// A free body that turns with 8 rad/s about an axis, with lumped masses.
fn spinning(law: &str, mesh: &str, (integrator, dt): (&str, f64), damping: &str) -> Box<dyn Simulation> {
    let axis = if mesh.contains("rectangle") { "[0, 0, 1]" } else { "[0, 1, 0]" };
    let rest =
        format!("[mass]\nlumped = true\n[[initial_velocity]]\nangular = {{ axis = {axis}, rate = 8.0 }}\n{damping}");
    build(&body(law, mesh, integrator, dt, &rest))
}

/// Σ m x × v
fn angular_momentum(simulation: &dyn Simulation) -> Vector3<f64> {
    let (shape, x, v) = (simulation.shape(), simulation.positions(), simulation.velocities());
    let at = |values: &nalgebra::DVector<f64>, node: usize| -> Vector3<f64> { values.fixed_rows::<3>(3 * node).into() };
    let mut sum = Vector3::zeros();
    let shares = lumped_mass_shares(shape.mesh.element());
    for (element, volume) in shape.mesh.corners().zip(shape.mesh.volumes()) {
        for (&node, share) in element.iter().zip(&shares) {
            sum += 1000.0 * volume * share * at(&x, node).cross(&at(&v, node));
        }
    }
    sum
}

/// The part of the angular momentum that is lost in half a second.
fn lost_spin(law: &str, mesh: &str, integrator: &str, damping: &str) -> f64 {
    let mut simulation = spinning(law, mesh, (integrator, 0.005), damping);
    let before = angular_momentum(&*simulation);
    run(&mut *simulation, 100);
    (angular_momentum(&*simulation) - before).norm() / before.norm()
}

const BETA: &str = "[damping]\nbeta = 0.01\n";

/// The spin of a free body is kept as far as the equations of a step are solved.
const EXACT: &str = "[newton]\ntolerance = 1e-13\n";

#[test]
fn stiffness_damping_leaves_a_free_body_its_spin_in_the_midpoint_rule() {
    let quadratic = format!("{RECTANGLE}\norder = 2");
    for (meshes, laws) in [(&[BOX, RECTANGLE, &quadratic][..], &LAWS[1..3]), (&[BOX], &LAWS)] {
        for mesh in meshes {
            for law in laws {
                let lost = lost_spin(law, mesh, "implicit_midpoint", &format!("{BETA}{EXACT}"));
                assert!(lost < 1e-9, "{law}, {mesh}: {lost:e}");
            }
        }
    }
}

#[test]
fn stiffness_damping_takes_no_more_spin_than_the_method() {
    for integrator in ["implicit_euler", "linearly_implicit_euler", "newmark", "generalized_alpha", "bdf2", "bathe"] {
        let [without, with] = ["", BETA].map(|damping| lost_spin("neo_hookean", BOX, integrator, damping));
        assert!(with < 1.2 * without + 1e-9, "{integrator}: {with:e}, and without damping {without:e}");
    }
    for integrator in ["semi_implicit_euler", "verlet"] {
        let rest = BETA.replace("0.01", "1e-4");
        let mut simulation = spinning("neo_hookean", BOX, (integrator, 1e-3), &rest);
        let before = angular_momentum(&*simulation);
        run(&mut *simulation, 500);
        let lost = (angular_momentum(&*simulation) - before).norm() / before.norm();
        assert!(lost < 1e-12, "{integrator}: {lost:e}");
    }
}

#[test]
fn rayleighs_form_brakes_the_spin_as_it_always_has() {
    // Before there was another form: 29 % of the angular momentum of the free bar in a second.
    let damping = "[damping]\nbeta = 0.01\nform = \"rayleigh\"\n";
    let mut simulation = spinning("neo_hookean", &of_kuhn(BOX), ("implicit_midpoint", 0.005), damping);
    let before = angular_momentum(&*simulation).norm();
    run(&mut *simulation, 200);
    let energies = simulation.energies();
    assert!((energies.kinetic - 1275.5268556).abs() < 1e-3, "{} J", energies.kinetic);
    assert!(angular_momentum(&*simulation).norm() < 0.75 * before);
}

#[test]
fn a_damped_body_that_spins_and_vibrates_never_gains_energy() {
    for integrator in ["implicit_midpoint", "newmark", "generalized_alpha", "bdf2", "bathe", "implicit_euler"] {
        for law in ["corotated", "neo_hookean", "st_venant_kirchhoff"] {
            let mut simulation = spinning(law, BOX, (integrator, 0.005), BETA);
            let (mut energy, mut largest) = (simulation.energies().total(), 0.0f64);
            let start = energy;
            for _ in 0..100 {
                run(&mut *simulation, 1);
                let now = simulation.energies().total();
                largest = largest.max((now - energy) / start);
                energy = now;
            }
            assert!(largest < 1e-6, "{law}, {integrator}: a step adds {largest:e} of the energy");
        }
    }
}

/// A bar of ν = 0 that is pulled along its length in its first vibration by very little, with one end fixed.
fn vibrating(form: &str, beta: f64, dt: f64) -> Box<dyn Simulation> {
    let fixed = "[fixed]\nplane = { axis = \"x\", below = 1e-9 }\n";
    let text = body(
        "neo_hookean",
        "box = { size = [4, 0.5, 0.5], cells_per_unit = 2 }",
        "implicit_midpoint",
        dt,
        &format!(
            "{fixed}[[initial_velocity]]\nvelocity = [1e-5, 0, 0]\n[damping]\nbeta = {beta:e}\nform = \"{form}\"\n"
        ),
    );
    build(&text.replace("poisson = 0.3", "poisson = 0.0"))
}

#[test]
fn a_small_vibration_of_a_bar_decays_with_half_of_beta_omega_squared() {
    // The first mode of the bar, ω = π/2 √(E/ρ)/L; higher ones die out within the first period.
    let omega = PI / 2.0 * 10.0 / 4.0;
    let (beta, period) = (0.02, 2.0 * PI / omega);
    let dt = period / 200.0;
    for form in ["kelvin_voigt", "rayleigh"] {
        let mut simulation = vibrating(form, beta, dt);
        run(&mut *simulation, 200);
        let energy = simulation.energies().total();
        run(&mut *simulation, 400);
        let rate = (energy / simulation.energies().total()).ln() / (2.0 * 400.0 * dt);
        let expected = 0.5 * beta * omega * omega;
        assert!((rate - expected).abs() < 0.03 * expected, "{form}: {rate} 1/s instead of {expected} 1/s");
    }
}

/// Evenly spread numbers in [−1, 1], the same in every run: Knuth's linear congruential generator.
fn random(seed: u64) -> impl FnMut() -> f64 {
    let mut state = seed;
    move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }
}

fn system(text: &str) -> System {
    let scene = scene(text);
    let body = fem_scene::body(&scene, std::path::Path::new("no data")).unwrap_or_else(|error| panic!("{error}"));
    double::system(body, SolverChoice::Cholesky)
}

/// Vectors of the nodes, in the plane of a flat body.
fn vectors(system: &System, size: f64, is_flat: bool, random: &mut impl FnMut() -> f64) -> Vec<[f64; 3]> {
    let mut vector = || std::array::from_fn(|i| if is_flat && i == 2 { 0.0 } else { size * random() });
    (0..system.nodes()).map(|_| vector()).collect()
}

/// The damping force at displacements and velocities, N.
fn damping(system: &System, u: &[[f64; 3]], v: &[[f64; 3]]) -> Vec<[f64; 3]> {
    let mut force = vec![[0.0; 3]; system.nodes()];
    system.add_damping_force(u, v, &mut force);
    force
}

fn largest(vectors: &[[f64; 3]]) -> f64 {
    vectors.as_flattened().iter().fold(0.0, |largest: f64, x| largest.max(x.abs()))
}

const MESHES: [&str; 3] = [BOX, RECTANGLE, "rectangle = { size = [1.5, 0.5], cells_per_unit = 4 }\norder = 2"];

#[test]
fn no_deformed_body_is_damped_in_a_rigid_motion() {
    let springs = "[[springs]]\nnodes = [0, 5]\nstiffness = 1e5\n";
    let j2 = "[plasticity]\nmodel = \"j2\"\nyield_stress = 2e3\nhardening = 5e3\n";
    let mut random = random(3);
    for mesh in MESHES {
        let is_flat = mesh != BOX;
        for (law, table) in LAWS.map(|law| (law, springs)).into_iter().chain([("hencky", j2)]) {
            let mut system = system(&body(law, mesh, "verlet", 1e-4, &format!("{table}{BETA}")));
            let u = vectors(&system, 0.05, is_flat, &mut random);
            system.elements.flow(&u, 1e-4);
            assert_eq!(system.elements.plasticity().is_some_and(|flow| flow.dissipated() > 0.0), table == j2);
            let spin = Vector3::new(random(), random(), random()).component_mul(&match is_flat {
                true => Vector3::z(),
                false => Vector3::repeat(1.0),
            });
            let rigid: Vec<[f64; 3]> = system
                .rest
                .iter()
                .zip(&u)
                .map(|(x, u)| (spin.cross(&(x + Vector3::from(*u))) + Vector3::new(0.3, -0.2, 0.0)).into())
                .collect();
            let of_any = largest(&damping(&system, &u, &vectors(&system, 1.0, is_flat, &mut random)));
            let of_rigid = largest(&damping(&system, &u, &rigid));
            assert!(of_rigid < 1e-12 * of_any, "{law}, {mesh}: {of_rigid:e} N of {of_any:e} N");
        }
    }
}

#[test]
fn the_damping_force_is_the_slope_of_the_dissipation_that_the_rate_of_the_stretch_defines() {
    let mut random = random(5);
    for mesh in &MESHES[..2] {
        let is_flat = *mesh != BOX;
        let system = system(&body("neo_hookean", mesh, "verlet", 1e-4, BETA));
        let [u, v] = [0.05, 1.0].map(|size| vectors(&system, size, is_flat, &mut random));
        let force = damping(&system, &u, &v);
        for (node, i) in [(0, 0), (3, 1), (9, 0), (11, 1)] {
            let moved = |h: f64| {
                let mut v = v.clone();
                v[node][i] += h;
                dissipation(&system, &u, &v)
            };
            // Of second order in v: the difference is exact.
            let slope = 0.5 * (moved(1.0) - moved(-1.0));
            assert!((force[node][i] + slope).abs() < 1e-9 * largest(&force), "{mesh}: {} N, {slope}", force[node][i]);
        }
    }
}

/// β Σ V (μ U̇:U̇ + λ/2 tr(U̇)²), W, from F = 1 + Σ u ⊗ ∇φ of each simplex.
fn dissipation(system: &System, u: &[[f64; 3]], v: &[[f64; 3]]) -> f64 {
    let (E, nu, beta) = (1e5, 0.3, 0.01);
    let (mu, lambda) = (E / (2.0 * (1.0 + nu)), E * nu / ((1.0 + nu) * (1.0 - 2.0 * nu)));
    let mesh = &system.shape.mesh;
    let mut sum = 0.0;
    for (nodes, volume) in mesh.corners().zip(mesh.volumes()) {
        let nodes: Vec<usize> = nodes.iter().map(|&node| system.numbering.engine_node[node] as usize).collect();
        let matrix = |at: &dyn Fn(usize) -> Vector3<f64>, across: Vector3<f64>| {
            let edge = |k: usize| nodes.get(k).map_or(across, |&node| at(node) - at(nodes[0]));
            Matrix3::from_columns(&[edge(1), edge(2), edge(3)])
        };
        let inverse = matrix(&|node| system.rest[node], Vector3::z()).try_inverse().unwrap();
        let F = Matrix3::identity() + matrix(&|node| u[node].into(), Vector3::zeros()) * inverse;
        let rate = matrix(&|node| v[node].into(), Vector3::zeros()) * inverse;
        let squares = (F.transpose() * F).symmetric_eigen();
        let (Q, sigma) = (squares.eigenvectors, squares.eigenvalues.map(f64::sqrt));
        let of_square = Q.transpose() * (F.transpose() * rate + rate.transpose() * F) * Q;
        let strain = Matrix3::from_fn(|i, j| of_square[(i, j)] / (sigma[i] + sigma[j]));
        sum += beta * volume * (mu * strain.norm_squared() + 0.5 * lambda * strain.trace().powi(2));
    }
    sum
}

#[test]
fn a_mass_spring_body_is_damped_along_its_springs_alone() {
    let text = "pipeline = \"engine\"\n[mesh]\nbox = { size = [1.5, 0.5, 0.5], cells_per_unit = 4 }\n[material]\nmodel = \"mass_spring\"\n\
                young = 1e5\ndensity = 1000.0\n[mass]\nlumped = true\n[[initial_velocity]]\nangular = { axis = [0, 1, 0], rate = 8.0 }\n\
                [damping]\nbeta = 0.01\n[newton]\ntolerance = 1e-13\n[time]\nintegrator = \"implicit_midpoint\"\ndt = 0.005\n";
    let mut simulation = build(text);
    let (before, start) = (angular_momentum(&*simulation), simulation.energies().total());
    run(&mut *simulation, 100);
    let lost = (angular_momentum(&*simulation) - before).norm() / before.norm();
    assert!(lost < 1e-9, "{lost:e}");
    let left = simulation.energies().total() / start;
    assert!(left > 0.7 && left < 1.0 - 1e-3, "vibrations are damped: {left}");
}

/// A cantilever that yields under its weight, with stiffness damping.
fn yielding(form: &str, gravity: f64, tables: &str) -> Box<dyn Simulation> {
    build(&format!(
        "pipeline = \"engine\"\n[mesh]\nbox = {{ size = [1.5, 0.5, 0.5], cells_per_unit = 4 }}\n[material]\nmodel = \"hencky\"\n\
         young = 1e5\npoisson = 0.3\ndensity = 1000.0\n[plasticity]\nmodel = \"j2\"\nyield_stress = 2000.0\nhardening = 1000.0\n\
         [damping]\nalpha = 0.5\nbeta = 0.005\nform = \"{form}\"\n[gravity]\nacceleration = [0, {gravity:e}, 0]\n\
         [fixed]\nplane = {{ axis = \"x\", below = 1e-9 }}\n[time]\nintegrator = \"implicit_euler\"\ndt = 0.005\n{tables}"
    ))
}

#[test]
fn the_damping_of_a_body_that_yields_depends_on_no_rounding_error() {
    let floor = "[[planes]]\npoint = [0, -0.3, 0]\nnormal = [0, 1, 0]\n";
    for form in ["kelvin_voigt", "rayleigh"] {
        for planes in ["", floor] {
            let mut expected = yielding(form, -9.81, planes);
            run(&mut *expected, 40);
            let solvers = ["lu", "cg", "pcg"].map(|kind| (-9.81, format!("{planes}[solver]\nkind = \"{kind}\"\n")));
            let heavier = (-9.81 * (1.0 + 1e-13), planes.to_owned());
            for (gravity, tables) in solvers.into_iter().chain([heavier]) {
                let mut other = yielding(form, gravity, &tables);
                run(&mut *other, 40);
                let [at, of_other] = [&expected, &other].map(|simulation| simulation.positions());
                let difference = (at - of_other).amax();
                assert!(difference < 1e-7, "{form}, {gravity}, {tables}: {difference:e} m");
            }
        }
    }
}

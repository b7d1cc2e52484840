//! Equilibrium against closed forms.

use fem_model::Law;
use nalgebra::{DVector, Matrix3, Vector3};

use crate::{block, build, distance, run, side, soft, symmetry, try_build};

const TRACTION: &str =
    "[[traction]]\non = { axis = \"x\", side = \"max\", within = 1e-9 }\nforce_per_area = [2e3, 0, 0]\n";

/// Largest distance of a node from F X, m.
fn from_affine(q: &DVector<f64>, vertices: &[Vector3<f64>], F: &Matrix3<f64>) -> f64 {
    let at = |(i, X): (usize, &Vector3<f64>)| (q.fixed_rows::<3>(3 * i) - F * X).amax();
    vertices.iter().enumerate().map(at).fold(0.0, f64::max)
}

#[test]
fn a_linear_bar_under_traction_stretches_by_hooke_s_law_in_one_solve() {
    let mut simulation = build(&block("linear", &format!("{}{TRACTION}", symmetry())));
    run(&mut *simulation, 1);
    let strain = 2e3 / 1e5;
    let F = Matrix3::from_diagonal(&Vector3::new(1.0 + strain, 1.0 - 0.3 * strain, 1.0 - 0.3 * strain));
    let error = from_affine(&simulation.positions(), simulation.shape().mesh.vertices(), &F);
    assert!(error < 1e-12 * strain, "{error:e}");
    let counters = simulation.counters();
    assert_eq!((counters.newton_iterations, counters.energy_evaluations, counters.factorizations), (0, 0, 1));
    let reactions = simulation.reactions();
    assert_eq!(reactions[0].name, "prescribed[0]");
    assert!((reactions[0].force[0] + 2e3).abs() < 1e-10 * 2e3, "{reactions:?}");
    // Half of the work of the load is stored.
    let expected = -0.5 * 2e3 * strain * 2.0;
    assert!((simulation.energies().potential - expected).abs() < 1e-10 * expected.abs());
}

#[test]
fn linear_equilibria_add_up() {
    let clamp = "[fixed]\nplane = { axis = \"x\", below = 1e-9 }\n";
    let weight = "[gravity]\nacceleration = [0, -1, 0.5]\n";
    let lift = side("y", "max", 0.0).replace("axis = \"y\", side = \"max\"", "axis = \"x\", side = \"max\"");
    let lift = lift.replace("[0.0, 0.0, 0.0]", "[0, 0.02, 0]");
    let still = lift.replace("0.02", "0.0");
    let end = |rest: String| {
        let mut simulation = build(&block("linear", &format!("{clamp}{rest}")));
        let start = simulation.positions();
        run(&mut *simulation, 1);
        simulation.positions() - start
    };
    let both = end(format!("{weight}{TRACTION}{lift}"));
    let parts = end(format!("{weight}{still}")) + end(format!("{TRACTION}{still}")) + end(lift.clone());
    assert!(both.amax() > 0.01 && distance(&both, &parts) < 1e-12, "{:e}", distance(&both, &parts));
}

/// Lateral stretch of a neo-Hookean bar pulled to a stretch λ, and P11, by bisection of the closed form.
fn uniaxial(C: f64, D: f64, stretch: f64) -> (f64, f64) {
    let side_stress = |a: f64| {
        let J = stretch * a * a;
        2.0 * C / 3.0 * J.powf(-2.0 / 3.0) * (a * a - stretch * stretch) + 2.0 * D * (J - 1.0) * J
    };
    let (mut low, mut high) = (0.1, 2.0);
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if side_stress(middle) > 0.0 { high = middle } else { low = middle }
    }
    let J = stretch * low * low;
    (low, 2.0 * C / stretch * J.powf(-2.0 / 3.0) * (stretch * stretch - low * low))
}

#[test]
fn a_neo_hookean_bar_is_stretched_as_the_closed_form_says_in_one_load_step_or_in_many() {
    for (steps, stretch) in [(1, 1.5), (5, 1.5), (3, 0.6)] {
        let rest = format!("{}{}", symmetry(), side("x", "max", 2.0 * (stretch - 1.0)));
        let newton = format!("[newton]\ntolerance = 1e-14\n[static]\nload_steps = {steps}\n");
        let mut simulation = build(&soft("static", 1.0, &format!("{newton}{rest}")));
        run(&mut *simulation, steps);
        let (a, P11) = uniaxial(1e4, 4e4, stretch);
        let F = Matrix3::from_diagonal(&Vector3::new(stretch, a, a));
        let error = from_affine(&simulation.positions(), simulation.shape().mesh.vertices(), &F);
        let reactions = simulation.reactions();
        assert!(error < 1e-12, "{steps} steps to {stretch}: {error:e}");
        assert!((reactions[3].force[0] - P11).abs() < 1e-10 * P11.abs(), "{reactions:?}, {P11}");
        assert!((reactions[0].force[0] + P11).abs() < 1e-10 * P11.abs(), "{reactions:?}, {P11}");
    }
}

#[test]
fn an_affine_motion_of_the_boundary_is_affine_inside() {
    let F = Matrix3::new(1.2, 0.3, -0.1, 0.05, 0.9, 0.2, 0.0, -0.15, 1.1);
    for model in Law::FACTS.iter().map(|facts| &facts.name) {
        let text = block(model, "").replace("[2, 1, 1], cells_per_unit = 1", "[1, 1, 1], cells_per_unit = 3");
        let shape = build(&format!("{text}[fixed]\nnodes = [0, 1, 4, 16]\n")).shape();
        let on_boundary = |X: &Vector3<f64>| X.iter().any(|&x| x == 0.0 || x == 1.0);
        let nodes = shape.mesh.vertices().iter().enumerate().filter(|(_, X)| on_boundary(X));
        let tables = nodes.map(|(node, X)| {
            let u = F * X - X;
            format!("[[prescribed]]\nnodes = [{node}]\ndisplacement = [{:e}, {:e}, {:e}]\n", u.x, u.y, u.z)
        });
        let mut simulation = build(&format!("{text}{}", tables.collect::<String>()));
        run(&mut *simulation, 1);
        let error = from_affine(&simulation.positions(), shape.mesh.vertices(), &F);
        assert!(error < 1e-12, "{model}: {error:e}");
    }
}

#[test]
fn pressure_on_all_sides_shrinks_the_surface_that_it_presses_on() {
    // σ = 2D (s³ − 1) = −p holds on the deformed area only.
    let p = 2e4;
    let pressed = ["x", "y", "z"].map(|axis| {
        format!("[[traction]]\non = {{ axis = \"{axis}\", side = \"max\", within = 1e-9 }}\npressure = {p}\n")
    });
    for steps in [1, 4] {
        let tables = format!("[static]\nload_steps = {steps}\n[newton]\ntolerance = 1e-13\n{}", pressed.concat());
        let mut simulation = build(&soft("static", 1.0, &format!("{tables}{}", symmetry())));
        run(&mut *simulation, steps);
        let s = (1.0 - p / 8e4f64).cbrt();
        let F = Matrix3::from_diagonal(&Vector3::repeat(s));
        let error = from_affine(&simulation.positions(), simulation.shape().mesh.vertices(), &F);
        assert!(error < 1e-9 && simulation.counters().unconverged_steps == 0, "{error:e}");
    }
}

#[test]
fn a_bar_is_twisted_by_two_turns_and_stays_in_one_piece() {
    let text = soft(
        "static",
        1.0,
        "[static]\nload_steps = 16\n[fixed]\nplane = { axis = \"x\", below = 1e-9 }\n[[prescribed]]\n\
         on = { axis = \"x\", side = \"max\", within = 1e-9 }\n\
         rotation = { axis = \"x\", center = [0, 0.5, 0.5], turns = 2 }\n",
    );
    let mut simulation = build(&text.replace("[2, 1, 1], cells_per_unit = 1", "[8, 1, 1], cells_per_unit = 2"));
    let mut energy = 0.0;
    for step in 1..=16 {
        run(&mut *simulation, 1);
        let (J, element) = simulation.min_J();
        assert!(J > 0.0, "step {step}: element {element} has J = {J}");
        // Two whole turns end where they began: a bar that slipped back would have no energy.
        let now = simulation.energies().potential;
        assert!(now > energy, "step {step}: {now} J after {energy} J");
        energy = now;
    }
    assert_eq!(simulation.counters().unconverged_steps, 0);
}

#[test]
fn a_body_that_can_move_as_a_whole_is_refused() {
    let refused = |rest: &str| {
        let error = try_build(&soft("static", 1.0, rest)).err().map(|error| error.to_string()).unwrap();
        assert!(
            error.contains("time.integrator is static") && error.contains("rigid body; constrain it by"),
            "{error}"
        );
    };
    refused("");
    refused(&side("x", "min", 0.0));
    refused(&format!("{}{}", side("x", "min", 0.0), side("y", "min", 0.0)));
    refused("[fixed]\nnodes = [0, 1]\n");
    build(&soft("static", 1.0, "[fixed]\nnodes = [0, 1, 3]\n"));
    build(&soft("static", 1.0, &symmetry()));
}

//! `static` with curves over the load steps, with planes that move, and with bodies that obstacles alone hold.

use fem_model::simulation::Simulation;
use nalgebra::Vector3;

use crate::{block, build, node_masses, of_law, run, side, soft, symmetry};

/// The stretch of a bar under J2 flow with linear hardening and a Hencky law, by its yield stress, its hardening modulus and E; α is the
/// plastic strain so far. τ = P λ of Kirchhoff's stress, ln λ = τ/E + αₚ.
struct Bar {
    axial: f64,
    accumulated: f64,
}

const YIELD: f64 = 1e3;
const HARDENING: f64 = 1e4;
const YOUNG: f64 = 1e5;

impl Bar {
    /// ln λ under a dead traction P, Pa.
    fn load(&mut self, P: f64) -> f64 {
        let (axial, accumulated) = (self.axial, self.accumulated);
        let mut strain = axial;
        for _ in 0..200 {
            let tau = P * strain.exp();
            let excess = f64::max(0.0, tau.abs() - YIELD - HARDENING * accumulated);
            let flow = excess / HARDENING;
            self.axial = axial + flow * tau.signum();
            self.accumulated = accumulated + flow;
            strain = tau / YOUNG + self.axial;
        }
        strain
    }
}

#[test]
fn a_plastic_bar_that_is_loaded_unloaded_and_loaded_in_reverse_follows_the_closed_form() {
    let end = "on = { axis = \"x\", side = \"max\", within = 1e-9 }\n";
    let tables = format!(
        "{}[plasticity]\nmodel = \"j2\"\nyield_stress = {YIELD:e}\nhardening = {HARDENING:e}\n\
         [[traction]]\n{end}force_per_area = [2e3, 0, 0]\ncurve = {{ table = [[0, 0], [4, 1], [8, 0], [12, 1.1], [20, -0.9]] }}\n",
        symmetry()
    );
    let mut simulation = build(&block("hencky", &tables));
    let mut bar = Bar { axial: 0.0, accumulated: 0.0 };
    for step in 1..=20 {
        run(&mut *simulation, 1);
        let time = f64::from(step);
        let factor = match step {
            0..=4 => time / 4.0,
            5..=8 => (8.0 - time) / 4.0,
            9..=12 => 1.1 * (time - 8.0) / 4.0,
            _ => 1.1 - 2.0 * (time - 12.0) / 8.0,
        };
        let strain = bar.load(2e3 * factor);
        let found = (simulation.positions()[3 * 2] / 2.0).ln();
        assert!((found - strain).abs() < 1e-9, "step {step}: {found} {strain}");
        assert!((simulation.reactions()[0].force[0] + 2e3 * factor).abs() < 1e-5, "step {step}");
        if step == 8 {
            assert!(found > 0.1, "a body without loads keeps a strain: {found}");
        }
    }
    assert_eq!(simulation.counters().unconverged_steps, 0);
}

#[test]
fn a_prescribed_motion_follows_its_curve_and_a_load_without_one_grows_with_the_load_steps() {
    let push = side("x", "max", 0.2) + "curve = { table = [[0, 0], [2, 1], [4, -0.5]] }\n";
    let tables = format!(
        "{}{push}[static]\nload_steps = 4\n[[force]]\nnodes = [2]\nvalue = [0, 100, 0]\n[[force]]\nnodes = [5]\nvalue = [0, 0, 40]\n\
         curve = {{ ramp = 2 }}\n",
        symmetry()
    );
    let mut simulation = build(&block("corotated", &tables));
    for (step, motion, forces) in
        [(1, 0.5, [25.0, 20.0]), (2, 1.0, [50.0, 40.0]), (3, 0.25, [75.0, 40.0]), (4, -0.5, [100.0, 40.0])]
    {
        run(&mut *simulation, 1);
        assert!((simulation.positions()[3 * 2] - 2.0 - 0.2 * motion).abs() < 1e-12, "step {step}");
        let reactions = simulation.reactions();
        assert!((reactions[1].force[1] + forces[0]).abs() < 1e-6, "step {step}: {reactions:?}");
        assert!((reactions[2].force[2] + forces[1]).abs() < 1e-6, "step {step}: {reactions:?}");
    }
}

const FLOOR: &str = "[[planes]]\npoint = [0, 0, 0]\nnormal = [0, 1, 0]\n";
const WEIGHT: &str = "[gravity]\nacceleration = [0, -9.81, 0]\n";

/// Centre of mass, m, for lumped masses, whose sum with displacements that of the consistent ones is.
fn centre(simulation: &dyn Simulation) -> Vector3<f64> {
    let (masses, q) = (node_masses(simulation, 1.0), simulation.positions());
    masses.iter().enumerate().map(|(i, m)| *m * q.fixed_rows::<3>(3 * i)).sum::<Vector3<f64>>()
        / masses.iter().sum::<f64>()
}

#[test]
fn a_block_rests_on_a_floor_that_bears_its_weight_and_stays_where_it_is() {
    for model in ["linear", "corotated", "hencky", "yeoh", "gent"] {
        for floor in ["0", "-0.3"] {
            let text = block(model, &format!("{}{WEIGHT}", FLOOR.replace("[0, 0, 0]", &format!("[0, {floor}, 0]"))));
            let mut simulation = build(&text.replace("cells_per_unit = 1", "cells_per_unit = 2"));
            assert!(simulation.notes().iter().any(|note| note.contains("stabilized")), "{:?}", simulation.notes());
            let start = centre(&*simulation);
            run(&mut *simulation, 1);
            let (weight, force) = (2000.0 * 9.81, simulation.contacts()[0].force);
            assert!((force[1] - weight).abs() < 1e-6 * weight, "{model}: {force:?}");
            let moved = centre(&*simulation) - start;
            assert!(moved.x.abs().max(moved.z.abs()) < 1e-9, "{model}: {moved}");
            assert_eq!(simulation.counters().unconverged_steps, 0);
        }
    }
}

#[test]
fn a_body_that_no_obstacle_stops_has_no_equilibrium_and_the_message_says_so() {
    for plane in ["point = [0, 3, 0]\nnormal = [0, -1, 0]\n", "point = [0, -1, 0]\nnormal = [0.1, 1, 0]\n"] {
        let mut simulation = build(&block("corotated", &format!("[[planes]]\n{plane}{WEIGHT}")));
        let failure = simulation.step().unwrap_err().to_string();
        assert!(failure.contains("the body has no equilibrium") && failure.contains("add an obstacle"), "{failure}");
        assert_eq!(simulation.positions()[0], 0.0, "the last good state is kept");
    }
}

/// A box of 1 m that two plates press, the upper one by so much in so many steps.
fn press(model: &str, depth: f64, steps: usize) -> Box<dyn Simulation> {
    let plate = format!(
        "[[planes]]\npoint = [0, 1.001, 0]\nnormal = [0, -1, 0]\ndisplacement = [0, {:e}, 0]\ncurve = {{ ramp = {steps} }}\n",
        -depth
    );
    let text = of_law(model, &soft("static", 1.0, &format!("[newton]\ntolerance = 1e-12\n{FLOOR}{plate}")));
    build(&text.replace("[2, 1, 1], cells_per_unit = 1", "[1, 1, 1], cells_per_unit = 2"))
}

/// Height between the planes of nodes, m.
fn height(simulation: &dyn Simulation) -> f64 {
    let heights = || simulation.positions().iter().skip(1).step_by(3).copied().collect::<Vec<_>>();
    heights().into_iter().fold(f64::NEG_INFINITY, f64::max) - heights().into_iter().fold(f64::INFINITY, f64::min)
}

#[test]
fn a_plate_that_comes_down_presses_a_free_block_as_the_bar_of_hooke() {
    let mut simulation = press("linear", 0.02, 4);
    for _ in 0..4 {
        run(&mut *simulation, 1);
        let forces = simulation.contacts();
        let expected = 1e5 * (1.0 - height(&*simulation));
        assert!((forces[0].force[1] - expected).abs() < 1e-6 * expected, "{forces:?} {expected}");
        assert!((forces[1].force[1] + expected).abs() < 1e-6 * expected, "{forces:?} {expected}");
    }
    let q = simulation.positions();
    let widths = q.iter().step_by(3);
    let width = widths.clone().fold(f64::NEG_INFINITY, |a, b| a.max(*b)) - widths.fold(f64::INFINITY, |a, b| a.min(*b));
    assert!((width - 1.0 - 0.3 * (1.0 - height(&*simulation))).abs() < 1e-9, "{width}");
}

#[test]
fn a_press_in_one_load_step_ends_where_one_in_many_ends() {
    let [mut one, mut many] = [press("neo_hookean", 0.4, 1), press("neo_hookean", 0.4, 8)];
    run(&mut *one, 1);
    run(&mut *many, 8);
    let force = |simulation: &dyn Simulation| simulation.contacts()[1].force[1];
    assert!((force(&*one) / force(&*many) - 1.0).abs() < 1e-6 && force(&*one) < -1e4);
}

#[test]
fn the_work_of_a_plate_is_stored_in_the_body_and_in_the_barriers() {
    let mut simulation = press("corotated", 0.05, 50);
    let (mut work, mut before) = (0.0, 0.0);
    for _ in 0..50 {
        run(&mut *simulation, 1);
        let force = -simulation.contacts()[1].force[1];
        work += 0.5 * (before + force) * 0.001;
        before = force;
    }
    let stored = simulation.energies().potential;
    assert!((work / stored - 1.0).abs() < 2e-3, "{work} {stored}");
}

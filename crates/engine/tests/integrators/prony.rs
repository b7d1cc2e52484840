//! Viscoelasticity by a Prony series: relaxation, creep, hysteresis, derivatives, energy, resumption.

use std::path::Path;

use fem_engine::forces::{HessianKind, Moment};
use fem_engine::simulator::double::System;
use fem_model::Law;
use fem_model::simulation::Simulation;

use crate::flat::flat;
use crate::nodal_fields::{dot, field, system};
use crate::{SECOND_ORDER, block, build, of_law, run, scene, side, soft, symmetry, try_build};

/// Ratios and times of two terms.
const TERMS: [[f64; 2]; 2] = [[0.5, 0.2], [0.3, 2.0]];

fn viscosity(terms: &[[f64; 2]]) -> String {
    let terms: Vec<_> = terms.iter().map(|[g, time]| format!("{{ modulus_ratio = {g}, time = {time} }}")).collect();
    format!("[viscosity]\nterms = [{}]\n", terms.join(", "))
}

/// A bar of a law in equilibrium at any time, in steps of `dt`; `rest` are further tables.
fn bar(model: &str, dt: f64, rest: &str) -> String {
    let text = block(model, &format!("{}{rest}", symmetry()));
    text.replace("dt = 1e0", &format!("dt = {dt:e}"))
}

/// Force along x on the side that is moved, N.
fn pull(simulation: &dyn Simulation) -> f64 {
    simulation.reactions().iter().find(|reaction| reaction.name == "prescribed[3]").unwrap().force[0]
}

#[test]
fn a_constant_stretch_relaxes_as_the_series_whatever_the_law_the_element_and_the_step() {
    for model in Law::FACTS.iter().map(|facts| facts.name) {
        for dt in [0.01, 0.7, 40.0] {
            let stretch = side("x", "max", 0.3) + &format!("curve = {{ ramp = {dt} }}\n");
            let text = bar(model, dt, &stretch);
            for text in [text.clone(), text.replace(" }\n[material]", " }\norder = 2\n[material]")] {
                let mut elastic = build(&text);
                run(&mut *elastic, 1);
                let mut simulation = build(&(text + &viscosity(&TERMS)));
                for step in 0..5 {
                    run(&mut *simulation, 1);
                    // A ramp of the first step.
                    let of_term = |[g, time]: &[f64; 2]| {
                        let a = dt / time;
                        g * -(-a).exp_m1() / a * (-a * f64::from(step)).exp()
                    };
                    let expected = pull(&*elastic) * (1.0 + TERMS.iter().map(of_term).sum::<f64>());
                    let found = pull(&*simulation);
                    assert!((found - expected).abs() < 1e-10 * expected, "{model}, {dt} s, {step}: {found} {expected}");
                    let [stress, at_rest] = [&simulation, &elastic].map(|simulation| simulation.stresses()[0]);
                    let ratio = expected / pull(&*elastic);
                    assert!((stress - ratio * at_rest).amax() < 1e-9 * stress.amax(), "{model}: {stress} {at_rest}");
                }
            }
        }
    }
}

#[test]
fn an_initial_stretch_is_a_sudden_one_and_states_set_later_are() {
    let text = bar("neo_hookean", 0.1, &(side("x", "max", 0.3) + "curve = { table = [[0, 1]] }\n"));
    let mut elastic = build(&text);
    run(&mut *elastic, 1);
    let scene = scene(&(text + &viscosity(&TERMS)));
    let body = fem_scene::body(&scene, Path::new("no data")).unwrap();
    let mut simulation = fem_engine::simulator::Simulator::<f64>::new(body, &scene.method()).unwrap();
    let (q, shape) = (elastic.positions(), elastic.shape());
    let x = shape.mesh.vertices();
    let u: Vec<[f64; 3]> = (0..x.len()).map(|node| std::array::from_fn(|i| q[3 * node + i] - x[node][i])).collect();
    simulation.set_state(&u, &vec![[0.0; 3]; x.len()]);
    for step in 1..6 {
        run(&mut simulation, 1);
        let series: f64 = TERMS.iter().map(|[g, time]| g * (-0.1 * f64::from(step) / time).exp()).sum();
        let (found, expected) = (pull(&simulation), pull(&*elastic) * (1.0 + series));
        assert!((found - expected).abs() < 1e-10 * expected, "{step}: {found} {expected}");
    }
}

#[test]
fn creep_under_a_growing_load_has_an_error_of_second_order() {
    let [g, time] = [0.8, 0.3];
    let load = "[[traction]]\non = { axis = \"x\", side = \"max\", within = 1e-9 }\nforce_per_area = [100, 0, 0]\ncurve = { ramp = 1.0 }\n";
    let error = |steps: usize| {
        let text = bar("linear", 1.0 / steps as f64, load) + &viscosity(&[[g, time]]);
        let mut simulation = build(&text);
        run(&mut *simulation, steps);
        let q = simulation.positions();
        let end = (0..q.len() / 3).map(|node| q[3 * node]).fold(0.0, f64::max) - 2.0;
        // The standard linear solid: Findley, Lai, Onaran, Creep and Relaxation of Nonlinear Viscoelastic Materials (1976), section 5.5.
        let late = time * (1.0 + g);
        let strain = 100.0 / 1e5 * (1.0 - g / (1.0 + g) * late * -(-1.0 / late).exp_m1());
        (end / 2.0 - strain).abs() / strain
    };
    let [coarse, fine] = [10, 20].map(error);
    let order = (coarse / fine).log2();
    assert!((order - 2.0).abs() < 0.1 && fine < 2e-3, "{order} {coarse:e} {fine:e}");
}

#[test]
fn a_cycle_of_strain_loses_the_energy_of_the_loss_modulus_with_an_error_of_second_order() {
    let ([g, time], omega, strain) = ([0.8, 0.3], 4.0, 1e-3);
    let loss = |steps: usize| {
        let dt = std::f64::consts::TAU / omega / steps as f64;
        let motion = format!("curve = {{ sine = {{ frequency = {} }} }}\n", omega / std::f64::consts::TAU);
        let text = bar("linear", dt, &(side("x", "max", 2.0 * strain) + &motion)) + &viscosity(&[[g, time]]);
        let mut simulation = build(&text);
        run(&mut *simulation, 4 * steps);
        let (mut work, mut before) = (0.0, pull(&*simulation));
        for step in 0..steps {
            run(&mut *simulation, 1);
            let now = pull(&*simulation);
            let at = |step: usize| 2.0 * strain * (omega * dt * step as f64).sin();
            work += 0.5 * (before + now) * (at(step + 1) - at(step));
            before = now;
        }
        work
    };
    let of = omega * time;
    let expected = std::f64::consts::PI * strain * strain * 1e5 * g * of / (1.0 + of * of) * 2.0;
    let [coarse, fine] = [40, 80].map(|steps| (loss(steps) / expected - 1.0).abs());
    let order = (coarse / fine).log2();
    assert!((order - 2.0).abs() < 0.2 && fine < 5e-3, "{order} {coarse:e} {fine:e}");
}

#[test]
fn forces_and_stiffness_of_a_step_are_the_derivatives_of_its_potential() {
    for model in Law::FACTS.iter().map(|facts| facts.name) {
        let text = of_law(model, &soft("static", 1.0, &viscosity(&TERMS)));
        for text in [text.clone(), text.replace(" }\n[material]", " }\norder = 2\n[material]"), flat(&text)] {
            let mut system = system(&text);
            let nodes = system.nodes();
            // Two steps make stresses that no elastic state has.
            for (size, phase, time) in [(0.0, 0.0, 0.0), (0.04, 1.0, 0.1), (0.04, 2.0, 0.3)] {
                let place = field(&system, size, phase);
                system.forces.begin_step(&place, Moment::at(time), 0.1);
            }
            let (u, d, moment, h) = (field(&system, 0.03, 0.3), field(&system, 1.0, 2.0), Moment::at(0.4), 1e-6);
            let ahead = |h: f64| -> Vec<[f64; 3]> {
                u.iter().zip(&d).map(|(u, d)| std::array::from_fn(|i| u[i] + h * d[i])).collect()
            };
            let gradient = |u: &[[f64; 3]]| {
                let mut gradient = vec![[0.0; 3]; nodes];
                system.add_gradient_of_forces(u, moment, &mut gradient);
                gradient
            };
            let [above, below] = [h, -h].map(|h| system.energy_of_forces(&ahead(h), moment).value);
            let (slope, expected) = (dot(&gradient(&u), &d), (above - below) / (2.0 * h));
            assert!((slope - expected).abs() < 1e-6 * slope.abs(), "{model}: {slope} {expected}");
            let along = |d: &[[f64; 3]], kind| energy_along(&system, (&u, moment), d, kind);
            let [above, below] = [h, -h].map(|h| dot(&gradient(&ahead(h)), &d));
            let (curvature, expected) = (along(&d, HessianKind::Exact), (above - below) / (2.0 * h));
            assert!((curvature - expected).abs() < 1e-6 * curvature.abs(), "{model}: {curvature} {expected}");
        }
    }
}

/// dᵀ H d of the forces beside the elements.
fn energy_along(system: &System, (u, moment): (&[[f64; 3]], Moment), d: &[[f64; 3]], kind: HessianKind) -> f64 {
    let mut energy = 0.0;
    for (force, _) in system.forces.active() {
        force.hessian(u, moment, kind, &mut |row, column, block| {
            for i in 0..3 {
                energy += d[row][i] * (0..3).map(|j| block[i][j] * d[column][j]).sum::<f64>();
            }
        });
    }
    energy
}

#[test]
fn a_projected_stiffness_has_no_negative_energy_where_a_stretch_is_let_go_in_a_long_step() {
    let mut system = system(&soft("static", 1.0, &viscosity(&TERMS)));
    let stretched: Vec<[f64; 3]> = system.rest.iter().map(|x| [1.5 * x.x, 0.0, 0.0]).collect();
    system.forces.begin_step(&stretched, Moment::at(0.0), 50.0);
    let (u, moment) = (vec![[0.0; 3]; system.nodes()], Moment::at(50.0));
    let mut is_indefinite = false;
    for d in (0..20).map(|phase| field(&system, 1.0, f64::from(phase))) {
        let [exact, projected] =
            [HessianKind::Exact, HessianKind::Projected].map(|kind| energy_along(&system, (&u, moment), &d, kind));
        assert!(projected >= 0.0, "{projected}");
        is_indefinite |= exact < 0.0;
    }
    assert!(is_indefinite, "no state of the test needs a projection");
}

#[test]
fn vibrations_of_a_viscous_body_are_damped_and_its_account_closes() {
    let start = "[[initial_velocity]]\nvelocity = [0, 0, 0]\nangular = { axis = [0, 0, 1], rate = 3.0 }\n[fixed]\nplane = { axis = \"x\", below = 1e-9 }\n";
    for integrator in SECOND_ORDER.into_iter().chain(["verlet", "semi_implicit_euler", "implicit_euler"]) {
        let text = |terms: &str| build(&soft(integrator, 2e-3, &format!("{start}{terms}")));
        let [mut elastic, mut viscous] = [text(""), text(&viscosity(&[[1.0, 0.05]]))];
        run(&mut *elastic, 500);
        run(&mut *viscous, 500);
        let [kept, left] = [&elastic, &viscous].map(|simulation| simulation.energies().total());
        assert!(left < 0.7 * kept, "{integrator}: {kept} {left}");
        assert!(viscous.failure_at_end().is_none(), "{integrator}");
        let ledger = viscous.energy_ledger().unwrap();
        assert!(ledger.dampers > 0.2 * ledger.start, "{integrator}: {ledger:?}");
        if ["verlet", "newmark", "implicit_midpoint"].contains(&integrator) {
            assert!(ledger.numerical().abs() < 0.03 * ledger.start, "{integrator}: {ledger:?}");
        }
    }
}

#[test]
fn a_resumed_run_goes_on_with_its_relaxing_stresses() {
    let text = soft(
        "implicit_euler",
        0.01,
        &(side("x", "min", 0.0) + &side("x", "max", 0.3) + "over = 0.05\n" + &viscosity(&TERMS)),
    );
    let mut whole = build(&text);
    run(&mut *whole, 4);
    let checkpoint = whole.checkpoint();
    run(&mut *whole, 6);
    let mut resumed = build(&text);
    resumed.restore(&checkpoint).unwrap();
    run(&mut *resumed, 6);
    assert_eq!(whole.checkpoint().displacements, resumed.checkpoint().displacements);
    assert_eq!(whole.stresses(), resumed.stresses());
}

#[test]
fn series_without_meaning_are_refused_with_the_remedy() {
    let message = |text: &str| {
        let parsed = fem_scene::parse(text, Path::new("folder/name.toml")).map(|_| ());
        parsed.and_then(|()| try_build(text).map(|_| ())).expect_err(text).to_string()
    };
    let of = |terms: &str| message(&soft("implicit_euler", 0.01, &format!("[viscosity]\nterms = {terms}\n")));
    assert!(of("[]").contains("viscosity.terms is empty; give terms such as"), "{}", of("[]"));
    let negative = of("[{ modulus_ratio = 0.5, time = 1 }, { modulus_ratio = -1, time = 1 }]");
    assert!(negative.contains("viscosity.terms[1].modulus_ratio"), "{negative}");
    let instant = of("[{ modulus_ratio = 0.5, time = 0 }]");
    assert!(instant.contains("viscosity.terms[0].time") && instant.contains(" s"), "{instant}");
    for integrator in ["pbd", "xpbd", "vbd", "projective_dynamics"] {
        let text = message(&soft(integrator, 0.01, &viscosity(&TERMS)));
        assert!(text.contains("viscosity") && text.contains("implicit_euler"), "{integrator}: {text}");
    }
    let flowing = of_law("hencky", &soft("static", 1.0, &viscosity(&TERMS)))
        + "[plasticity]\nmodel = \"j2\"\nyield_stress = 1e4\n";
    assert!(message(&flowing).contains("remove it, or [plasticity]"), "{}", message(&flowing));
    let sheet = flat(&of_law("linear", &soft("static", 1.0, &viscosity(&TERMS))))
        .replace("thickness", "plane = \"stress\"\nthickness");
    assert!(message(&sheet).contains("plane stress"), "{}", message(&sheet));
}

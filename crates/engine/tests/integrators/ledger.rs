//! The energy ledger: its balance, the dissipation of the methods, and gains that end a run.

use fem_model::simulation::{Cause, EnergyLedger, Simulation};

use crate::vibrations::{bathes_factor, frequency, oscillator};
use crate::{build, of_law, run, side, soft};

/// The ledger after so many steps.
fn ledger(simulation: &mut dyn Simulation, steps: usize) -> EnergyLedger {
    run(simulation, steps);
    simulation.energy_ledger().expect("a ledger")
}

#[test]
fn each_method_dissipates_in_a_period_what_its_amplification_says() {
    // Steps in a period, and z = ω dt.
    let steps: usize = 63;
    let z = std::f64::consts::TAU / steps as f64;
    let loss = |per_step: f64| 1.0 - per_step.powi(steps as i32);
    let bdf2 = 3.036e-3; // 1 − |ζ|¹²⁶ of the largest root of 3/2 − 2/ζ + 1/(2 ζ²) = iz
    let cases = [
        ("explicit_euler", loss(1.0 + z * z)),
        ("semi_implicit_euler", 0.0),
        ("verlet", 0.0),
        ("implicit_midpoint", 0.0),
        ("newmark", 0.0),
        ("rk2", loss(1.0 + z.powi(4) / 4.0)),
        ("rk4", loss(1.0 - z.powi(6) / 72.0)),
        ("linearly_implicit_euler", loss(1.0 / (1.0 + z * z))),
        ("implicit_euler", loss(1.0 / (1.0 + z * z))),
        ("bdf2", bdf2),
        ("bathe", loss(bathes_factor(z).powi(2))),
    ];
    for (method, expected) in cases {
        let text = oscillator(method, z / frequency(), "[energy]\naccept_gain = true\n");
        let mut simulation = build(&text);
        // The load moves the node about the equilibrium at f/k with the energy f²/2k.
        let first = ledger(&mut *simulation, steps).numerical();
        let second = ledger(&mut *simulation, steps).numerical();
        let force = crate::node_masses(&*simulation, 1000.0)[5];
        let whole = force * force / 2e6;
        let found = (second - first) / (whole - first);
        assert!((found - expected).abs() < 2e-3, "{method}: {found} and {expected}");
    }
}

#[test]
fn the_account_of_a_driven_damped_and_plastic_body_is_balanced_as_the_step_falls() {
    let driven = "[fixed]\nplane = { axis = \"x\", below = 1e-9 }\n[plasticity]\nmodel = \"j2\"\nyield_stress = 3e3\nhardening = 1e4\n\
                  [damping]\nalpha = 2\nbeta = 1e-3\n[[traction]]\non = { axis = \"x\", side = \"max\", within = 1e-9 }\n\
                  force_per_area = [0, 2e3, 0]\ncurve = { sine = { frequency = 5.0 } }\n\
                  [[springs]]\nnodes = [0, 11]\nstiffness = 1e3\ndamping = 20\n";
    for method in
        ["semi_implicit_euler", "verlet", "rk4", "implicit_midpoint", "newmark", "generalized_alpha", "bdf2", "bathe"]
    {
        let left = |dt: f64| {
            let text = of_law("hencky", &soft(method, dt, driven));
            let account = ledger(&mut *build(&text), (0.4 / dt).round() as usize);
            assert!(account.plastic > 0.0 && account.rayleigh > 0.0 && account.dampers > 0.0, "{method}: {account:?}");
            (account.numerical() / account.turned_over, account.gain / account.turned_over)
        };
        let [(coarse, gain), (fine, _)] = [left(2e-3), left(5e-4)];
        assert!(
            gain < 0.02 && coarse.abs() < 0.05 && fine.abs() < 0.6 * coarse.abs() + 1e-3,
            "{method}: {coarse} {fine} {gain}"
        );
    }
}

#[test]
fn the_account_of_a_linear_body_closes_with_the_forces_that_each_step_has_found() {
    let fixed = "[fixed]\nplane = { axis = \"x\", below = 1e-9 }\n[damping]\nalpha = 2\nbeta = 1e-3\n";
    let let_go = format!("{fixed}[[initial_velocity]]\nvelocity = [0, 1, 0.5]\n");
    // Velocities of a prescribed motion are exact, and not those of the method.
    let driven = format!("{fixed}{}curve = {{ sine = {{ frequency = 5.0 }} }}\n", side("x", "max", 0.05));
    for (rest, largest) in [(let_go, 1e-6), (driven, 5e-4)] {
        // These methods dissipate nothing themselves.
        for method in ["implicit_midpoint", "newmark"] {
            let mut simulation = build(&of_law("linear", &soft(method, 2e-3, &rest)));
            let [early, late] = [10, 90].map(|steps| ledger(&mut *simulation, steps));
            let left = (late.numerical() - early.numerical()).abs() / late.turned_over;
            assert!(late.rayleigh > 0.1 * late.turned_over && left < largest, "{method}: {left:e} in {late:?}");
        }
    }
}

#[test]
fn a_gain_of_more_than_a_twentieth_ends_the_run_unless_the_scene_accepts_it() {
    let z = 0.1;
    let text = |rest: &str| oscillator("explicit_euler", z / frequency(), rest);
    let mut simulation = build(&text(""));
    let failure = (0..400).find_map(|_| simulation.step().err()).expect("explicit Euler gains 1 % in each step");
    let Cause::EnergyGained { gained, turned_over } = failure.cause else { panic!("{failure}") };
    assert!(gained > 0.05 * turned_over && gained < turned_over, "{failure}");
    assert!(failure.to_string().contains("energy.accept_gain"), "{failure}");
    run(&mut *build(&text("[energy]\naccept_gain = true\n")), 400);
}

#[test]
fn a_run_shorter_than_the_steps_between_two_judgements_is_judged_at_its_end() {
    let of = |method: &str| {
        let mut simulation = build(&oscillator(method, 0.1 / frequency(), ""));
        run(&mut *simulation, 50);
        simulation.failure_at_end()
    };
    assert!(of("explicit_euler").is_some(), "explicit Euler gains 64 % in 50 steps");
    assert!(of("verlet").is_none() && of("semi_implicit_euler").is_none() && of("rk4").is_none());
    // A body in free fall has the right velocities.
    let mut falling = build(&soft("explicit_euler", 1e-3, "[gravity]\nacceleration = [0, 0, -9.81]\n"));
    run(&mut *falling, 10);
    assert_eq!(falling.failure_at_end(), None);
}

#[test]
fn environments_of_a_short_batch_are_judged_at_its_end() {
    let failures = |method: &str| {
        let scene = crate::scene(&oscillator(method, 0.1 / frequency(), ""));
        let body = fem_scene::body(&scene, "no data".as_ref()).unwrap();
        let values = fem_model::Batch(vec![Default::default(); 2]);
        let mut batch = fem_engine::batch::Batch::new(body, &scene.method(), values).unwrap();
        batch.advance(50).unwrap();
        assert!(batch.failures().unwrap().is_empty(), "{method}");
        batch.check_ends().unwrap();
        batch.failures().unwrap().len()
    };
    assert_eq!(["explicit_euler", "verlet"].map(failures), [2, 0]);
}

#[test]
fn a_body_released_from_a_strain_never_gains_energy_in_steps_far_above_its_periods() {
    for (method, more) in [
        ("generalized_alpha", ""),
        ("generalized_alpha", "[generalized_alpha]\nspectral_radius = 0.0\n"),
        ("generalized_alpha", "[generalized_alpha]\nspectral_radius = 0.5\n"),
        ("newmark", "[newmark]\nbeta = 0.4\n"),
        ("newmark", ""),
        ("bdf2", ""),
        ("bathe", ""),
    ] {
        let released = "[[prescribed]]\non = { axis = \"x\", side = \"max\", within = 1e-9 }\ndisplacement = [0.1, 0, 0]\nuntil = 0.5\n\
                        [fixed]\nplane = { axis = \"x\", below = 1e-9 }\n";
        for young in ["1e7", "1e10"] {
            let text = of_law("corotated", &soft(method, 0.05, &format!("{released}{more}")))
                .replace("1e5\npoisson", &format!("{young}\npoisson"));
            let mut simulation = build(&text);
            let account = ledger(&mut *simulation, 60);
            assert!(account.gain < 0.01 * account.turned_over, "{method}, {more:?}, E = {young}: {account:?}");
        }
    }
}

#[test]
fn a_plane_that_hits_a_body_at_rest_does_not_throw_it_under_bdf2() {
    for dt in [0.02, 2e-3, 5e-4] {
        let text = format!(
            "pipeline = \"engine\"\n[mesh]\nbox = {{ size = [1, 1, 1], cells_per_unit = 2 }}\n[material]\nmodel = \"corotated\"\n\
             young = 1e6\npoisson = 0.3\ndensity = 1000.0\n[[planes]]\npoint = [0, -0.05, 0]\nnormal = [0, 1, 0]\nvelocity = [0, 1, 0]\n\
             until = 0.2\n[time]\nintegrator = \"bdf2\"\ndt = {dt}\n"
        );
        let mut simulation = build(&text);
        let account = ledger(&mut *simulation, (0.1 / dt) as usize);
        assert!(account.obstacles > 100.0, "{dt}: {account:?}");
        assert!(account.gain < 0.01 * account.turned_over, "{dt}: {account:?}");
    }
}

#[test]
fn a_plane_that_moves_into_a_body_supplies_the_energy_that_it_gets() {
    for method in ["bdf2", "generalized_alpha", "newmark", "implicit_midpoint", "implicit_euler"] {
        let text = format!(
            "pipeline = \"engine\"\n[mesh]\nbox = {{ size = [1, 1, 1], cells_per_unit = 2 }}\n[material]\nmodel = \"neo_hookean\"\n\
             young = 1e5\npoisson = 0.3\ndensity = 1000.0\n[[planes]]\npoint = [0, -1.1e-3, 0]\nnormal = [0, 1, 0]\nfriction = 0.3\n\
             [[planes]]\npoint = [0, 1.0011, 0]\nnormal = [0, -1, 0]\nfriction = 0.3\nvelocity = [0, -0.5, 0]\nuntil = 0.4\n\
             [time]\nintegrator = \"{method}\"\ndt = 0.02\n"
        );
        let mut simulation = build(&text);
        run(&mut *simulation, 1);
        let account = simulation.energy_ledger().unwrap();
        assert!(account.numerical() > 0.0 && account.kinetic < 100.0, "{method}: {account:?}");
        let account = ledger(&mut *simulation, 30);
        assert!(account.obstacles > 500.0 && account.friction > 0.0, "{method}: {account:?}");
        assert!(account.gain < 0.02 * account.turned_over, "{method}: {account:?}");
    }
}

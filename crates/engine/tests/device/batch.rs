//! Steps of many environments on a graphics device beside those on the processor.

use fem_engine::batch::Batch;
use fem_model::simulation::Cause;
use fem_scene::parse;

pub(crate) const BEAM: &str = r#"pipeline = "engine"
[mesh]
box = { size = [2, 1, 1], cells_per_unit = 2 }
[material]
model = "neo_hookean"
young = 2e5
poisson = 0.3
density = 1000
[mass]
lumped = true
[gravity]
acceleration = [0, 0, -9.81]
[[initial_velocity]]
on = "all"
velocity = [0.5, -1, 0.25]
[fixed]
plane = { axis = "x", below = 1e-9 }
[damping]
alpha = 0.5
[time]
dt = 2e-3
integrator = "METHOD"
"#;

const METHODS: [&str; 5] = ["explicit_euler", "semi_implicit_euler", "verlet", "rk2", "rk4"];

/// Stiffness, density and weight that differ.
pub(crate) const VARIED: &str = r#"[batch]
count = 5
[batch.vary]
young = { from = 1e5, to = 4e5, spacing = "geometric" }
density = { from = 800, to = 1200 }
gravity = { from = 0.5, to = 2 }
"#;

pub(crate) const ONE: &str = "[batch]\ncount = 1\n";

/// A batch; `None`, after one line, where there is no device for it.
pub(crate) fn batch(text: &str) -> Option<Batch> {
    match build(text) {
        Ok(batch) => Some(batch),
        Err(error) if error.contains("no graphics adapter") || error.contains("double precision") => {
            println!("skipped: {error}");
            None
        }
        Err(error) => panic!("{error}"),
    }
}

pub(crate) fn build(text: &str) -> Result<Batch, String> {
    let scene = parse(text, "batch.toml".as_ref()).map_err(|error| error.to_string())?;
    let body = fem_scene::body(&scene, "no data".as_ref()).map_err(|error| error.to_string())?;
    Batch::new(body, &scene.method(), scene.environment_values()).map_err(|refusal| scene.refused(refusal).to_string())
}

pub(crate) fn gpu(precision: &str) -> String {
    format!("[solver]\nkind = \"gpu\"\nprecision = \"{precision}\"\n")
}

/// Positions and velocities of an environment, one behind the other.
fn numbers(batch: &mut Batch, environment: usize) -> Vec<f64> {
    let state = batch.state(environment).unwrap_or_else(|error| panic!("environment {environment}: {error}"));
    [state.positions, state.velocities].concat().into_flattened()
}

/// Largest difference of two states over the largest displacement and the largest change of a velocity.
fn difference(a: &[f64], b: &[f64], start: &[f64]) -> f64 {
    let largest = |values: &mut dyn Iterator<Item = f64>| values.fold(0.0, |most: f64, x| most.max(x.abs()));
    let half = a.len() / 2;
    let of = |range: std::ops::Range<usize>| {
        let error = largest(&mut range.clone().map(|i| a[i] - b[i]));
        error / largest(&mut range.map(|i| b[i] - start[i]))
    };
    of(0..half).max(of(half..a.len()))
}

/// Compares each environment on the device with its run on the processor after so many steps.
fn compare(text: &str, precision: &str, steps: usize, bound: f64) {
    let text = text.replace("[time]", &format!("[time]\nprecision = \"{precision}\""));
    let Some(mut device) = batch(&format!("{text}{}{VARIED}", gpu(precision))) else { return };
    let mut processor = build(&format!("{text}{VARIED}")).unwrap();
    let starts: Vec<_> = (0..5).map(|environment| numbers(&mut processor, environment)).collect();
    device.advance(steps / 2).unwrap();
    device.advance(steps - steps / 2).unwrap();
    processor.advance(steps).unwrap();
    assert_eq!((device.steps(), device.time()), (processor.steps(), processor.time()));
    for (environment, start) in starts.iter().enumerate() {
        let (found, expected) = (numbers(&mut device, environment), numbers(&mut processor, environment));
        let error = difference(&found, &expected, start);
        println!("environment {environment}, {precision}: {error:.1e}");
        assert!(error < bound, "environment {environment}: {error}");
    }
}

#[test]
fn every_explicit_method_ends_where_it_ends_on_the_processor() {
    for method in METHODS {
        println!("{method}");
        let text = BEAM.replace("METHOD", method);
        compare(&text, "f32", 50, 1e-5);
        compare(&text, "f64", 50, 1e-11);
    }
}

#[test]
fn other_laws_and_substeps_end_where_they_end_on_the_processor() {
    let text = BEAM.replace("METHOD", "verlet").replace("dt = 2e-3", "dt = 8e-3\nsubsteps = 4");
    for law in ["linear", "corotated", "st_venant_kirchhoff", "stable_neo_hookean"] {
        println!("{law}");
        compare(&text.replace("neo_hookean", law), "f64", 12, 1e-11);
    }
}

#[test]
fn descent_has_the_iterates_of_the_processor() {
    let beam = BEAM.replace("METHOD", "vbd").replace("dt = 2e-3", "dt = 1e-2");
    for law in ["linear", "corotated", "st_venant_kirchhoff", "stable_neo_hookean", "neo_hookean"] {
        let text = beam.replace("neo_hookean", law);
        for (sweeps, steps) in [(1, 1), (5, 30)] {
            println!("{law}, {sweeps} sweeps");
            let text = format!("{text}[iterations]\ncount = {sweeps}\naccept_unconverged = true\n");
            compare(&text, "f32", steps, 1e-5);
            compare(&text, "f64", steps, 1e-10);
        }
    }
}

/// Steps that are long beside the elements, and blocks that are not definite: energies decide how far nodes go. Some elements are inverted
/// until the sweeps have turned them.
#[test]
fn descent_of_a_body_that_is_thrown_hard_has_the_iterates_of_the_processor() {
    let beam = BEAM.replace("METHOD", "vbd").replace("dt = 2e-3", "dt = 1");
    for (law, velocity) in [
        ("st_venant_kirchhoff", "[-0.5, 0, 0.01]"),
        ("stable_neo_hookean", "[-1.2, 0.8, 0.4]"),
        ("corotated", "[-0.6, 0.43, 0.27]"),
        ("neo_hookean", "[-0.36, 0.24, 0.12]"),
    ] {
        // Where the rotation of the corotated law jumps, further sweeps multiply rounding errors.
        for sweeps in if law == "corotated" { [1, 2] } else { [2, 10] } {
            println!("{law}, {sweeps} sweeps");
            let text = beam.replace("neo_hookean", law).replace("[0.5, -1, 0.25]", velocity);
            // A layer that is compressed to a third has blocks that are not definite.
            let text = match law {
                "st_venant_kirchhoff" => text.replace("-9.81", "-0.1").replace("[2, 1, 1]", "[0.5, 1, 1]"),
                _ => text,
            };
            let text = format!("{text}[iterations]\ncount = {sweeps}\naccept_unconverged = true\n");
            compare(&text, "f64", 1, 1e-8);
        }
    }
}

#[test]
fn a_batch_steps_as_its_environments_do_one_by_one_bit_for_bit() {
    for method in METHODS.into_iter().chain(["vbd"]) {
        let text = BEAM.replace("METHOD", method) + &gpu("f32");
        let Some(mut all) = batch(&format!("{text}{VARIED}")) else { return };
        all.advance(20).unwrap();
        for environment in 0..5 {
            let values = all.values(environment);
            let alone = [("young", values.young), ("density", values.density), ("gravity", values.gravity)];
            let vary = alone.map(|(key, value)| format!("{key} = {{ from = {0:?}, to = {0:?} }}\n", value.unwrap()));
            let mut one = batch(&format!("{text}[batch]\ncount = 1\n[batch.vary]\n{}", vary.concat())).unwrap();
            one.advance(20).unwrap();
            assert_eq!(numbers(&mut all, environment), numbers(&mut one, 0), "{method}, environment {environment}");
        }
    }
}

#[test]
fn a_state_comes_back_only_when_it_is_asked_for() {
    let text = BEAM.replace("METHOD", "semi_implicit_euler") + &gpu("f32");
    let Some(mut batch) = batch(&format!("{text}{VARIED}")) else { return };
    (0..3).for_each(|_| batch.advance(10).unwrap());
    assert_eq!(batch.reads(), 0);
    batch.state(2).unwrap();
    assert_eq!(batch.reads(), 2, "the failures and the state");
    batch.state(4).unwrap();
    assert_eq!(batch.reads(), 3);
    batch.advance(1).unwrap();
    assert!(batch.failures().unwrap().is_empty());
    assert_eq!(batch.reads(), 4);
}

#[test]
fn an_environment_that_fails_is_named_and_the_others_go_on() {
    let vary = "[batch]\ncount = 3\n[batch.vary]\nyoung = { from = 2e5, to = 2e11, spacing = \"geometric\" }\n";
    for (method, law) in [("semi_implicit_euler", "neo_hookean"), ("verlet", "neo_hookean"), ("rk4", "linear")] {
        let text = BEAM.replace("METHOD", method).replace("neo_hookean", law);
        let Some(mut device) = batch(&format!("{text}{}{vary}", gpu("f32"))) else { return };
        device.advance(400).unwrap();
        let failures = device.failures().unwrap().to_vec();
        assert_eq!(failures.iter().map(|failure| failure.environment).collect::<Vec<_>>(), [1, 2], "{method}");
        let text_of = |failure: usize| failures[failure].failure.to_string();
        println!("{method}, {law}: {} and {}", text_of(0), text_of(1));
        assert!(failures[1].failure.step <= failures[0].failure.step && failures[1].failure.step > 1, "{failures:?}");
        match failures[0].failure.cause {
            Cause::Inverted { J, .. } => assert!(J <= 0.0 && law == "neo_hookean", "{J}"),
            Cause::NotFinite { .. } => {}
            other => panic!("{other:?}"),
        }
        assert_eq!(device.state(2).unwrap_err(), text_of(1));
        let mut alone = batch(&format!("{text}{}[batch]\ncount = 1\n", gpu("f32"))).unwrap();
        alone.advance(400).unwrap();
        assert_eq!(numbers(&mut device, 0), numbers(&mut alone, 0));
    }
}

#[test]
fn an_element_that_inverts_is_found_at_the_step_at_which_the_processor_finds_it() {
    // A neo-Hookean body that is thrown at its fixed end, in one step after the other.
    let text = BEAM.replace("[0.5, -1, 0.25]", "[-60, 0, 0]").replace("dt = 2e-3", "dt = 1e-3");
    for method in METHODS {
        let text = text.replace("METHOD", method).replace("[time]", "[time]\nprecision = \"f64\"");
        let Some(mut device) = batch(&format!("{text}{}[batch]\ncount = 1\n", gpu("f64"))) else { return };
        let mut processor = build(&format!("{text}[batch]\ncount = 1\n")).unwrap();
        device.advance(100).unwrap();
        processor.advance(100).unwrap();
        let failure = |batch: &mut Batch| batch.failures().unwrap()[0].failure.clone();
        let (found, expected) = (failure(&mut device), failure(&mut processor));
        println!("{method}: {found}");
        assert_eq!(found.step, expected.step, "{method}: {found} {expected}");
        // An element that is inverted at a stage within the step has no stress there.
        if method == "rk4" && matches!(found.cause, Cause::NotFinite { .. }) {
            continue;
        }
        let Cause::Inverted { J, .. } = found.cause else { panic!("{found}") };
        let Cause::Inverted { J: of_processor, .. } = expected.cause else { panic!("{expected}") };
        assert!(J <= 0.0 && J >= of_processor - 1e-9, "the first inverted element, not the worst: {J} {of_processor}");
    }
}

#[test]
fn what_the_device_does_not_know_is_refused_with_a_remedy() {
    if fem_engine::solvers::device_name().is_err() {
        return println!("skipped: there is no device");
    }
    let text = BEAM.replace("METHOD", "verlet") + &gpu("f32") + "[batch]\ncount = 2\n";
    let changes = [
        ("integrator = \"verlet\"", "integrator = \"implicit_euler\"", "time.integrator is \"implicit_euler\""),
        ("model = \"neo_hookean\"", "model = \"hencky\"", "material.model is \"hencky\""),
        ("per_unit = 2 }", "per_unit = 2 }\norder = 2", "mesh.order makes quadratic elements"),
        ("lumped = true", "lumped = false", "mass.lumped is not true"),
        ("alpha = 0.5", "beta = 0.5", "damping.beta is the damping"),
        ("[batch]", "[[springs]]\nnodes = [0, 40]\nstiffness = 5\n[batch]", "springs are forces between two nodes"),
        ("below = 1e-9 }", "below = 1e-9 }\nuntil = 1", "fixed.until is a time"),
        ("[batch]", "[[planes]]\npoint = [0, 0, -1]\nnormal = [0, 0, 1]\n[batch]", "planes are obstacles"),
    ];
    for (from, to, problem) in changes {
        assert_eq!(text.matches(from).count(), 1, "{from}");
        let error = build(&text.replacen(from, to, 1)).err().unwrap_or_else(|| panic!("{to} is not refused"));
        assert!(error.contains(problem) && error.contains("or leave [solver] out"), "{error}");
    }
}

#[test]
fn a_batch_without_the_device_steps_on_the_processor() {
    let mut batch = build(&format!("{}{VARIED}", BEAM.replace("METHOD", "verlet"))).unwrap();
    batch.advance(3).unwrap();
    batch.state(1).unwrap();
    assert_eq!(batch.reads(), 0);
    assert!(batch.place().ends_with("of the processor"), "{}", batch.place());
}

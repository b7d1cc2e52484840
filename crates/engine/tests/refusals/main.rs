//! Every number and every table of a scene that names everything: what must be refused, at which line, with which remedy, and
//! what must not.

mod unused;

use std::path::Path;

use fem_engine::simulator;
use fem_model::Integrator;
use fem_model::simulation::Simulation;
use fem_scene::{SceneError, parse};

/// The scene with one passage replaced, which must be there once.
fn edit(text: &str, from: &str, to: &str) -> String {
    assert_eq!(text.matches(from).count(), 1, "`{from}` is not there once:\n{text}");
    text.replacen(from, to, 1)
}

/// A scene of the engine with every table, and every key that can stand beside the others.
const ALL: &str = r#"about = "everything"
pipeline = "engine"
[mesh]
scale = 0.5
refine = 1
box = { size = [2, 1, 1], cells_per_unit = 1 }
[material]
model = "neo_hookean"
young = 1e5
poisson = 0.3
density = 1000.0
[mass]
lumped = true
[gravity]
acceleration = [0.5, -9.81, 0.25]
[body_force]
density = [10.0, 20.0, 30.0]
[fixed]
plane = { axis = "x", below = 1e-9 }
[[prescribed]]
on = { axis = "x", side = "max", within = 1e-9 }
rotation = { axis = "x", center = [0.5, 0.25, 0.25], turns = 0.01 }
displacement = [0.01, 0.02, 0.03]
over = 2.0
[[prescribed]]
nodes = [4]
displacement = [0.0, 0.01, 0.0]
components = ["y"]
[[traction]]
on = { axis = "y", side = "max", within = 1e-9 }
force_per_area = [10.0, 20.0, 30.0]
[[traction]]
faces = [[0, 12, 14]]
pressure = 50.0
[[springs]]
nodes = [1, 10]
stiffness = 100.0
rest_length = 0.5
[damping]
alpha = 0.1
beta = 1e-4
[time]
dt = 1e-3
integrator = "implicit_euler"
steps = 3
precision = "f64"
[newton]
max_iterations = 9
tolerance = 1e-9
projection = "when_needed"
[solver]
kind = "pcg"
tolerance = 1e-10
preconditioner = "multigrid"
[drag]
vertex = 7
stiffness = 1e3
direction = [1.0, 0.5, 0.25]
amplitude = 0.02
frequency = 1.5
"#;

/// The error of a scene that is refused when it is read, when its mesh is made, or when its simulation is built.
fn try_all(text: &str) -> Result<Box<dyn Simulation>, SceneError> {
    let scene = parse(text, Path::new("folder/name.toml"))?;
    let body = fem_scene::body(&scene, Path::new("no data"))?;
    simulator::build(body, &scene.method()).map_err(|refusal| scene.refused(refusal))
}

/// Line (counted from 1), and the bytes in the whole text, of every number that stands outside quotes.
fn numbers(text: &str) -> Vec<(usize, std::ops::Range<usize>)> {
    let (mut found, mut start) = (Vec::new(), 0);
    for (number, line) in text.lines().enumerate() {
        let is_part = |byte: u8| byte.is_ascii_digit() || b".+-e".contains(&byte);
        let begins = |at: usize, bytes: &[u8]| {
            (bytes[at].is_ascii_digit() || bytes[at] == b'-') && (at == 0 || b" [".contains(&bytes[at - 1]))
        };
        let (bytes, mut at) = (line.as_bytes(), 0);
        while at < bytes.len() {
            if begins(at, bytes) {
                let end = bytes[at..].iter().position(|&byte| !is_part(byte)).map_or(bytes.len(), |length| at + length);
                found.push((number + 1, start + at..start + end));
                at = end;
            } else {
                at += 1;
            }
        }
        start += line.len() + 1;
    }
    found
}

fn with(text: &str, place: &std::ops::Range<usize>, value: &str) -> String {
    format!("{}{value}{}", &text[..place.start], &text[place.end..])
}

/// The scene with everything that this method uses.
fn by_method(integrator: &str) -> String {
    let unused: &[&str] = match integrator {
        "implicit_euler" | "implicit_midpoint" | "newmark" | "generalized_alpha" | "bdf2" | "bathe" => &[],
        "linearly_implicit_euler" => &["[newton]"],
        "static" => &["[damping]"],
        _ => &["[newton]", "[solver]"],
    };
    let mut is_used = true;
    let keeps = |line: &&str| {
        if line.starts_with('[') {
            is_used = !unused.contains(line);
        }
        is_used
    };
    let used: Vec<_> = ALL.lines().filter(keeps).collect();
    edit(&(used.join("\n") + "\n"), "\"implicit_euler\"", &format!("\"{integrator}\""))
}

#[test]
fn a_scene_with_everything_is_built_and_moves_by_every_method() {
    assert_eq!(numbers(ALL).len(), 55);
    for integrator in Integrator::ALL.into_iter().filter(|integrator| !integrator.is_iterated()) {
        let mut simulation = try_all(&by_method(integrator.name())).unwrap();
        simulation.step().unwrap_or_else(|failure| panic!("{}: {failure}", integrator.name()));
    }
}

#[test]
fn no_number_of_a_scene_may_be_nan_or_infinite() {
    for (line, place) in numbers(ALL) {
        for value in ["nan", "inf", "-inf"] {
            let text = with(ALL, &place, value);
            // The box and its mesh are looked at when the body is made; there is no file then to find the line in.
            let Err(SceneError::Line { line: found, problem, .. }) = parse(&text, Path::new("folder/name.toml")) else {
                let message = try_all(&text).err().unwrap_or_else(|| panic!("taken:\n{text}")).to_string();
                assert!(message.contains("mesh.box: ") && message.contains("; "), "{message}\n{text}");
                continue;
            };
            assert_eq!(found, line, "{problem}\n{text}");
            assert!(problem.contains("; "), "no remedy in: {problem}");
        }
    }
}

#[test]
fn no_number_of_a_scene_however_large_or_small_brings_a_nan_into_a_run() {
    let methods = [
        ("f64", "implicit_euler"),
        ("f64", "linearly_implicit_euler"),
        ("f64", "verlet"),
        ("f64", "static"),
        ("f32", "implicit_euler"),
    ];
    for (precision, integrator) in methods {
        let scene = edit(&by_method(integrator), "\"f64\"", &format!("\"{precision}\""));
        for (_, place) in numbers(&scene) {
            for value in ["1e300", "-1e59", "1e30", "1e-59", "0", "1000000000000"] {
                let text = with(&scene, &place, value);
                let Ok(mut simulation) = try_all(&text) else { continue };
                // A run that cannot go on says why, and keeps a state that is finite.
                let _ = (0..2).try_for_each(|_| simulation.step());
                let (q, v) = (simulation.positions(), simulation.velocities());
                assert!(q.iter().chain(v.iter()).all(|x| x.is_finite()), "{text}");
            }
        }
    }
}

#[test]
fn an_unknown_key_is_refused_in_every_table_and_in_every_table_within_one() {
    let headers = ALL.lines().enumerate().filter(|(_, line)| line.starts_with('['));
    for (number, header) in headers {
        let text: Vec<_> = ALL.lines().collect();
        let text = [&text[..=number], &["foo = 1"], &text[number + 1..]].concat().join("\n");
        let error = parse(&text, Path::new("folder/name.toml")).unwrap_err().to_string();
        let expected = format!("folder/name.toml, line {}: unknown field `foo`", number + 2);
        assert!(error.starts_with(&expected) && error.contains("; correct this name"), "{header}: {error}");
    }
    for (number, line) in ALL.lines().enumerate().filter(|(_, line)| line.contains("= { ")) {
        let text = edit(ALL, line, &line.replace("= { ", "= { foo = 1, "));
        let error = parse(&text, Path::new("folder/name.toml")).unwrap_err().to_string();
        assert!(error.starts_with(&format!("folder/name.toml, line {}: unknown field `foo`", number + 1)), "{error}");
    }
}

/// A passage, what it is replaced with, and how the message begins.
const CASES: &[(&str, &str, &str)] = &[
    ("scale = 0.5", "scale = 0", "mesh.scale is 0; give a positive number"),
    ("refine = 1", "refine = 5", "mesh.refine is 5; cut every element at most 4 times"),
    ("young = 1e5", "young = -1e5", "material.young is -100000; give a positive number of Pa"),
    ("young = 1e5", "young = 1e61", "material.young is 1e61, too large to compute with; give at most 1e60"),
    ("poisson = 0.3", "poisson = 0.5", "material.poisson is 0.5; Poisson's ratio lies above -1 and below 0.5"),
    ("poisson = 0.3", "poisson = -1", "material.poisson is -1; Poisson's ratio lies above -1 and below 0.5"),
    ("density = 1000.0", "density = 0", "material.density is 0; give a positive number of kg/m³"),
    ("density = 1000.0", "density = 1e-61", "material.density is 1e-61, too small to compute with; give 1e-60 or more"),
    ("below = 1e-9", "below = -1", "fixed.plane has below = -1; give a distance of 0 m or more"),
    ("turns = 0.01", "turns = 1e7", "prescribed[0].rotation.turns is 1e7; give at most 1e6"),
    ("over = 2.0", "over = 0", "prescribed[0].over is 0; give a positive number of seconds"),
    ("dt = 1e-3", "dt = 0", "time.dt is 0; give a positive number of seconds"),
    ("steps = 3", "steps = 0", "time.steps is 0; give at least one step"),
    ("alpha = 0.1", "alpha = -0.1", "damping.alpha is -0.1; give 0 1/s or more"),
    ("max_iterations = 9", "max_iterations = 0", "newton.max_iterations is 0; give at least one iteration"),
    ("tolerance = 1e-9", "tolerance = 0", "newton.tolerance is 0; give a positive number"),
    ("tolerance = 1e-10", "tolerance = -1", "solver.tolerance is -1; give a positive number"),
    ("tolerance = 1e-10", "tolerance = 1.0", "solver.tolerance is 1; give a number below 1"),
    ("tolerance = 1e-9", "tolerance = 2", "newton.tolerance is 2; give a number below 1"),
    ("stiffness = 100.0", "stiffness = -1", "springs[0].stiffness is -1; give a positive number of N/m"),
    ("rest_length = 0.5", "rest_length = -0.5", "springs[0].rest_length is -0.5; give 0 m or more"),
    ("stiffness = 1e3", "stiffness = 0", "drag.stiffness is 0; give a positive number of N/m"),
    ("direction = [1.0, 0.5, 0.25]", "direction = [0, 0, 0]", "drag.direction is zero; give the direction of the pull"),
    ("frequency = 1.5", "frequency = -1", "drag.frequency is -1; give 0 Hz or more"),
    ("pressure = 50.0", "pressure = 1e70", "traction[1].pressure is 1e70, too large to compute with; give at most"),
    (
        "[0.01, 0.02, 0.03]",
        "[0.01, 1e70, 0.03]",
        "prescribed[0].displacement is too long to compute with; give a shorter",
    ),
    (
        "pressure = 50.0",
        "pressure = 1e-61",
        "traction[1].pressure is 1e-61, too small to compute with; give 0, or 1e-60",
    ),
    ("[0.01, 0.02, 0.03]", "[0, 1e-61, 0]", "prescribed[0].displacement is too short to compute with; give zeros, or"),
    ("nodes = [4]", "nodes = [1000]", "prescribed[1].nodes names node 1000; the mesh has nodes 0 to 44"),
    ("nodes = [4]", "nodes = [8]", "prescribed[1] moves y of node 8, and so does prescribed[0]; name each"),
    ("vertex = 7", "vertex = 45", "drag.vertex names node 45; the mesh has nodes 0 to 44"),
    (
        "faces = [[0, 12, 14]]",
        "faces = [[0, 1, 44]]",
        "traction[1].faces names [0, 1, 44], which is no triangle of the boundary; ",
    ),
];

#[test]
fn numbers_out_of_range_are_refused_with_field_and_remedy() {
    for &(from, to, beginning) in CASES {
        let text = edit(ALL, from, to);
        let error = try_all(&text).err().unwrap_or_else(|| panic!("taken: {to}")).to_string();
        // A table stands at its heading, a key at its line.
        let number = ALL.lines().position(|line| line.contains(from)).unwrap() + 1;
        let heading =
            ALL.lines().take(number).collect::<Vec<_>>().iter().rposition(|line| line.starts_with('[')).unwrap() + 1;
        let problem = error.strip_prefix(&format!("folder/name.toml, line {number}: "));
        let problem = problem.or_else(|| error.strip_prefix(&format!("folder/name.toml, line {heading}: ")));
        let problem = problem.unwrap_or_else(|| panic!("not line {number}: {error}"));
        assert!(problem.starts_with(beginning), "{problem}\nis not\n{beginning}");
    }
}

#[test]
fn a_motion_to_equilibrium_beside_which_elements_are_lost_in_rounding_errors_is_refused() {
    let moved = |far: &str, precision: &str| {
        let text = edit(&by_method("static"), "\"f64\"", precision).replace("1e-9 }", "0 }");
        let text = text.replace("tolerance = 1e-9", "tolerance = 1e-5");
        let error = try_all(&edit(&text, "[0.01, 0.02, 0.03]", &format!("[{far}, 0.0, 0.0]"))).err();
        error.map(|error| error.to_string()).filter(|error| error.contains("prescribed[0]"))
    };
    for (far, precision) in [("1e15", "\"f64\""), ("-1e30", "\"f64\""), ("1e6", "\"f32\"")] {
        let error = moved(far, precision).unwrap_or_else(|| panic!("taken: {far} m in {precision}"));
        assert!(
            error.contains("precision does not resolve elements of") && error.contains("; give a smaller motion"),
            "{error}"
        );
        assert_eq!(error.ends_with("or remove time.precision"), precision.contains("32"), "{error}");
    }
    assert_eq!(moved("1e12", "\"f64\""), None);
    assert_eq!(moved("1e3", "\"f32\""), None);
}

#[test]
fn what_is_out_of_the_range_of_single_precision_is_refused_with_that_remedy() {
    // Planes without thickness, so that a body of any size has two ends.
    let single =
        edit(ALL, "\"f64\"", "\"f32\"").replace("1e-9 }", "0 }").replace("tolerance = 1e-9", "tolerance = 1e-5");
    try_all(&single).unwrap();
    for (from, to, field) in [
        ("young = 1e5", "young = 1e39", "material leads to moduli out of the range of single precision"),
        ("density = 1000.0", "density = 1e-44", "material.density leads to a mass of a node out"),
        ("dt = 1e-3", "dt = 1e-25", "time.dt leads to a mass over the time step squared"),
        ("scale = 0.5", "scale = 1e-14", "mesh leads to a volume of an element"),
        ("-9.81", "-1e38", "gravity leads to a force on a node"),
        ("stiffness = 100.0", "stiffness = 1e40", "springs leads to a stiffness out"),
        ("pressure = 50.0", "pressure = 1e40", "traction leads to a pressure out"),
    ] {
        let text = edit(&single, from, to);
        let error = try_all(&text).err().unwrap_or_else(|| panic!("taken: {to}")).to_string();
        assert!(error.contains(field) && error.ends_with("or remove time.precision"), "{to}: {error}");
        assert!(!try_all(&edit(&text, "\"f32\"", "\"f64\"")).is_err_and(|error| error.to_string().contains(field)));
    }
}

//! The lesson of the course: bunny and armadillo have one material. The bunny is gigantic, hence soft, and linearly implicit Euler is enough
//! for it. The armadillo is small, hence stiff: the spring that pulls it is missing in the stiffness, linearly implicit Euler explodes, and
//! the line search of implicit Euler survives.

use fem_model::Integrator;
use fem_model::simulation::{Interactive, Pull, Simulation};
use nalgebra::Vector3;

use crate::program::{Desk, assert_names, assert_one_message, data, numbers};
use crate::scene_text::{build, edit, shipped};

/// The shipped armadillo, pulled a metre to and fro twice a second, in long steps.
fn harsh_pull() -> String {
    let text = std::fs::read_to_string(data().join("scenes/arma.toml")).unwrap();
    let edits = [
        ("dt = 0.01", "dt = 0.02"),
        ("stiffness = 1e5", "stiffness = 1e6"),
        ("amplitude = 0.2", "amplitude = 1.0"),
        ("frequency = 1.0", "frequency = 2.0"),
    ];
    edits.iter().fold(text, |text, (from, to)| edit(&text, from, to))
}

#[test]
fn bunny_and_armadillo_have_one_material_and_the_bunny_is_twenty_times_as_large() {
    let [bunny, arma] = ["bunny", "arma"].map(shipped);
    assert_eq!(bunny.material, arma.material);
    assert_eq!((bunny.mesh.scale, arma.mesh.scale), (20.0, 1.0));
    assert_eq!((&bunny.drag.unwrap().stiffness, &arma.drag.unwrap().stiffness), (&1e5, &1e5));
    let methods = [bunny.time.integrator, arma.time.integrator];
    assert_eq!(methods, [Integrator::LinearlyImplicitEuler, Integrator::ImplicitEuler]);
}

#[test]
fn the_bunny_survives_both_integrators() {
    for integrator in ["linearly_implicit_euler", "implicit_euler"] {
        let desk = Desk::new();
        desk.run_well(&format!("bunny --headless --steps 150 --integrator {integrator} --stats s.json"));
        assert_eq!(desk.json("s.json")["status"], "done");
        assert!(desk.json("s.json")["min_J"].as_f64().unwrap() > 0.8, "{integrator}");
    }
}

#[test]
fn the_armadillo_survives_four_seconds_of_implicit_euler() {
    let desk = Desk::new();
    let outcome = desk.run_well("arma --headless --steps 400 --stats s.json");
    let stats = desk.json("s.json");
    assert_eq!((&stats["status"], stats["steps"].as_u64()), (&"done".into(), Some(400)));
    assert!(stats["min_J"].as_f64().unwrap() > 0.8, "{stats}");
    // It survives, but five Newton iterations do not converge, and the run says so.
    assert!(stats["unconverged_steps"].as_u64().unwrap() > 200, "{stats}");
    assert!(outcome.stdout.contains("steps ended before Newton's method had converged"), "{}", outcome.stdout);
    let outcome = desk.run_well("arma --headless --steps 50 --set drag.in_stiffness=true --stats s.json");
    assert_eq!(desk.json("s.json")["unconverged_steps"], 0);
    assert!(!outcome.stdout.contains("converged"), "{}", outcome.stdout);
}

#[test]
fn the_armadillo_explodes_within_a_second_of_linearly_implicit_euler_and_the_message_names_step_and_cause() {
    let desk = Desk::new();
    let outcome = desk.run("arma --headless --integrator linearly_implicit_euler --steps 100");
    assert_eq!(outcome.code, Some(1), "{outcome:?}");
    assert_one_message(&outcome.stderr);
    assert_names(&outcome.stderr, &["the simulation failed in step ", " (t = ", "element ", "J = ", "implicit_euler"]);
}

/// K_vv + M_v/dt² of the pulled node is about 3e4 N/m in the armadillo: a spring of 1e3 N/m is stable even if it is explicit, and one of
/// 1e5 N/m is stable if the stiffness contains it.
#[test]
fn a_soft_spring_and_a_spring_in_the_stiffness_do_not_explode() {
    for (k, is_in_stiffness) in [(1e3, false), (1e5, true)] {
        let mut scene = shipped("arma");
        scene.time.integrator = Integrator::LinearlyImplicitEuler;
        let drag = scene.drag.as_mut().unwrap();
        (drag.stiffness, drag.in_stiffness) = (k, Some(is_in_stiffness));
        let mut simulation = build(&scene);
        (0..200).for_each(|_| simulation.step().unwrap_or_else(|failure| panic!("{k} N/m: {failure}")));
    }
    let mut scene = shipped("bunny");
    scene.mesh.scale = 5.0;
    let mut simulation = build(&scene);
    assert!((0..100).any(|_| simulation.step().is_err()), "a bunny of 5 m explodes");
}

/// Steps that survive while a mouse drags the shipped armadillo by 0.3 m in half a second, and then keeps it there. A click on a vertex of the
/// surface takes hold of the vertices within the radius of picking, as the window does.
fn dragged(integrator: Integrator, clicked: usize, direction: Vector3<f64>, steps: usize) -> usize {
    let mut scene = shipped("arma");
    scene.time.integrator = integrator;
    let mut simulation = build(&scene);
    let shape = simulation.shape();
    let V = shape.mesh.vertices();
    let radius = shape.pick_radius(V);
    let mut anchors: Vec<_> = shape.boundary.iter().flatten().map(|&node| (node, V[node])).collect();
    anchors.retain(|(_, place)| (place - V[clicked]).norm() <= radius);
    anchors.sort_by_key(|(node, _)| *node);
    anchors.dedup();
    let survives = |step: &usize| {
        let offset = direction * (0.3 * (*step as f64 / 50.0).min(1.0));
        simulation.pull(Some(Pull { anchors: anchors.clone(), offset }));
        simulation.step().is_ok()
    };
    (1..=steps).take_while(survives).count()
}

#[test]
fn an_ordinary_drag_explodes_under_linearly_implicit_euler_and_never_under_implicit_euler() {
    let shape = build(&shipped("arma")).shape();
    let mesh = shape.mesh.vertices();
    let mut free: Vec<usize> = shape.boundary.iter().flatten().copied().filter(|&node| mesh[node].y > 0.3).collect();
    free.sort_unstable();
    free.dedup();
    for i in 0..5 {
        let (node, angle) = (free[i * free.len() / 5], 1.2 * i as f64);
        let direction = Vector3::new(angle.cos(), 0.2, angle.sin()).normalize();
        let survived = dragged(Integrator::LinearlyImplicitEuler, node, direction, 100);
        assert!(survived < 100, "drag {i} of node {node} survives a second");
        assert_eq!(dragged(Integrator::ImplicitEuler, node, direction, 80), 80, "drag {i} of node {node}");
    }
}

#[test]
fn the_armadillo_survives_a_harsh_pull_under_implicit_euler() {
    let desk = Desk::with("harsh.toml", harsh_pull());
    desk.run_well("harsh.toml --headless --steps 50 --stats s.json");
    let stats = desk.json("s.json");
    assert_eq!((&stats["status"], stats["steps"].as_u64()), (&"done".into(), Some(50)));
    let assemblies = stats["stiffness_assemblies"].as_u64().unwrap();
    assert!(assemblies > 50, "{assemblies}: within a step the body moves far enough for another stiffness");
}

#[test]
fn the_harsh_pull_fails_under_linearly_implicit_euler_with_step_element_and_remedy() {
    let desk = Desk::with("harsh.toml", harsh_pull());
    let files = "--stats s.json --state q.json --energies e.csv --export x.vtu";
    let outcome = desk.run(&format!("harsh.toml --headless --steps 50 --integrator linearly_implicit_euler {files}"));
    assert_eq!(outcome.code, Some(1), "{outcome:?}");
    assert_one_message(&outcome.stderr);
    assert_eq!(outcome.stderr.lines().count(), 1, "{}", outcome.stderr);
    assert_names(&outcome.stderr, &["the simulation failed in step ", " (t = ", "element ", "J = ", "implicit_euler"]);

    let stats = desk.json("s.json");
    let status = stats["status"].as_str().unwrap();
    assert!(status.starts_with("failed: ") && outcome.stderr.contains(&status["failed: ".len()..]), "{status}");
    let finished = stats["steps"].as_u64().unwrap();
    assert!(finished < 50 && outcome.stderr.contains(&format!("step {} ", finished + 1)), "{finished}");

    // The files contain the last good state.
    assert!(stats["min_J"].as_f64().unwrap() > 0.0);
    let state = desk.json("q.json");
    assert!((state["time"].as_f64().unwrap() - 0.02 * finished as f64).abs() < 1e-12);
    for key in ["q", "qdot"] {
        assert!(numbers(&state[key]).iter().all(|number| number.is_finite()));
    }
    assert_eq!(desk.read("e.csv").lines().count() as u64, 2 + finished);
    assert!(desk.path("x.vtu").exists());
}

#[test]
fn a_pull_that_no_method_can_follow_ends_the_run_with_a_message() {
    let far = edit(&harsh_pull(), "amplitude = 1.0", "amplitude = 1e9");
    let desk = Desk::with("far.toml", far);
    let outcome = desk.run("far.toml --headless --steps 5 --stats s.json");
    assert_eq!(outcome.code, Some(1), "{outcome:?}");
    assert_one_message(&outcome.stderr);
    assert_names(&outcome.stderr, &["step", "N are not in balance", "gentler pull"]);
    assert!(desk.json("s.json")["status"].as_str().unwrap().starts_with("failed"));
}

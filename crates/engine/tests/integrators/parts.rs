//! The counter of a part that a scene leaves out stays zero, and rises in a scene with the part.

use fem_model::simulation::{Part, Simulation};

use crate::{build, run, soft};

const CLAMP: &str = "[fixed]\nplane = { axis = \"x\", below = 1e-9 }\n";
const WEIGHT: &str = "[gravity]\nacceleration = [0, -20, 0]\n";
const TRACTION: &str = "[[traction]]\non = { axis = \"x\", side = \"max\", within = 1e-9 }\n";

/// The parts after three steps, and after queries of the display mesh and the reactions.
fn parts(text: &str) -> Vec<Part> {
    let mut simulation = build(text);
    run(&mut *simulation, 3);
    simulation.display_positions();
    simulation.reactions();
    simulation.parts()
}

fn find<'a>(parts: &'a [Part], name: &str) -> &'a Part {
    parts.iter().find(|part| part.name == name).unwrap_or_else(|| panic!("no part {name}"))
}

fn is_at_work(part: &Part) -> bool {
    part.built && part.uses > 0
}

fn costs_nothing(part: &Part) -> bool {
    !part.built && part.bytes == 0 && part.uses == 0 && part.seconds == 0.0 && !part.why.is_empty()
}

/// With these tables the part works, without them it is not there; in each of the methods.
fn assert_switched_by(name: &str, tables: &str, methods: &[&str]) {
    for method in methods {
        let with = parts(&soft(method, 1e-3, &format!("{CLAMP}{WEIGHT}{tables}")));
        assert!(is_at_work(find(&with, name)), "{method} with {tables}: {:?}", find(&with, name));
        let without = parts(&soft(method, 1e-3, &format!("{CLAMP}{WEIGHT}")));
        assert!(costs_nothing(find(&without, name)), "{method}: {:?}", find(&without, name));
    }
}

const METHODS: [&str; 4] = ["verlet", "rk4", "linearly_implicit_euler", "implicit_euler"];

#[test]
fn tables_of_forces_switch_their_part_on() {
    let drag = "[drag]\nvertex = 5\nstiffness = 1e3\ndirection = [1, 0, 0]\namplitude = 0.1\nfrequency = 1\n";
    assert_switched_by("drag", drag, &METHODS);
    assert_switched_by("damping", "[damping]\nalpha = 1\nbeta = 1e-4\n", &["verlet", "rk4", "implicit_euler"]);
    assert_switched_by("springs", "[[springs]]\nnodes = [1, 8]\nstiffness = 1e3\nrest_length = 1\n", &METHODS);
    assert_switched_by("pressure", &format!("{TRACTION}pressure = 1e3\n"), &METHODS);
    let prescribed = "[[prescribed]]\nnodes = [2]\ndisplacement = [0.01, 0, 0]\nover = 1\n";
    assert_switched_by("prescribed", prescribed, &METHODS);
}

#[test]
fn damping_of_no_size_is_no_damping() {
    for method in METHODS {
        let none = parts(&soft(method, 1e-3, "[damping]\nalpha = 0\nbeta = 0\n"));
        assert!(costs_nothing(find(&none, "damping")), "{method}");
    }
}

#[test]
fn dead_loads_fixed_nodes_and_reactions_are_there_where_the_scene_has_them() {
    for method in METHODS {
        let with = parts(&soft(method, 1e-3, &format!("{CLAMP}{WEIGHT}")));
        assert!(is_at_work(find(&with, "dead_load")) && is_at_work(find(&with, "reactions")), "{method}");
        assert!(find(&with, "fixed").built, "{method}");
        let without = parts(&soft(method, 1e-3, ""));
        for name in ["dead_load", "fixed", "reactions"] {
            assert!(costs_nothing(find(&without, name)), "{method}: {:?}", find(&without, name));
        }
    }
}

#[test]
fn reactions_take_time_only_on_request() {
    let mut simulation = build(&soft("implicit_euler", 1e-3, CLAMP));
    run(&mut *simulation, 3);
    assert_eq!(find(&simulation.parts(), "reactions").uses, 0);
}

#[test]
fn matrices_belong_to_implicit_methods_and_energies_to_those_that_search() {
    let names = ["stiffness", "solver", "projection", "line_search"];
    for (method, built) in [
        ("verlet", [false; 4]),
        ("explicit_euler", [false; 4]),
        ("linearly_implicit_euler", [true, true, true, false]),
        ("implicit_euler", [true; 4]),
    ] {
        let parts = parts(&soft(method, 1e-3, &format!("{CLAMP}{WEIGHT}")));
        for (name, built) in names.into_iter().zip(built) {
            let part = find(&parts, name);
            // A body that is not squashed needs no projection; a part without work is still ready for it.
            let works = part.built && (is_at_work(part) || name == "projection");
            assert!(if built { works } else { costs_nothing(part) }, "{method}: {part:?}");
        }
    }
}

#[test]
fn a_linear_equilibrium_searches_no_line_and_projects_nothing() {
    let text = soft("static", 1.0, &format!("{CLAMP}{WEIGHT}"));
    let linear =
        text.replace("model = \"neo_hookean\"\nC = 1e4\nD = 4e4", "model = \"linear\"\nyoung = 1e5\npoisson = 0.3");
    let linear = parts(&linear);
    for name in ["line_search", "projection"] {
        assert!(costs_nothing(find(&linear, name)), "{:?}", find(&linear, name));
    }
    assert!(is_at_work(find(&parts(&text), "line_search")));
}

#[test]
fn projection_is_counted_where_it_is_asked_for_and_left_out_where_it_is_forbidden() {
    let with = |rule: &str| {
        parts(&soft("implicit_euler", 1e-2, &format!("{CLAMP}{WEIGHT}[newton]\nprojection = \"{rule}\"\n")))
    };
    let always = with("always");
    assert!(is_at_work(find(&always, "projection")), "{:?}", find(&always, "projection"));
    assert_eq!(find(&always, "stiffness").uses, 0, "every assembly is a projected one");
    assert!(costs_nothing(find(&with("never"), "projection")));
}

#[test]
fn a_preconditioner_belongs_to_preconditioned_conjugate_gradients() {
    for kind in ["pcg\"\npreconditioner = \"block_jacobi", "pcg\"\npreconditioner = \"multigrid"] {
        let with = parts(&soft("implicit_euler", 1e-2, &format!("{CLAMP}{WEIGHT}[solver]\nkind = \"{kind}\"\n")));
        assert!(is_at_work(find(&with, "preconditioner")) && find(&with, "preconditioner").bytes > 0, "{kind}");
    }
    for kind in ["cg", "cholesky", "lu"] {
        let without = parts(&soft("implicit_euler", 1e-2, &format!("{CLAMP}{WEIGHT}[solver]\nkind = \"{kind}\"\n")));
        assert!(costs_nothing(find(&without, "preconditioner")), "{kind}");
        assert!(is_at_work(find(&without, "solver")), "{kind}");
    }
}

/// The soft box with a display surface of one triangle.
fn with_display() -> Box<dyn Simulation> {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("s.obj"), "v 0.2 0.2 0.2\nv 0.8 0.2 0.2\nv 0.2 0.8 0.2\nf 1 2 3\n").unwrap();
    let text = soft("verlet", 1e-3, "").replace("[mesh]\n", "[mesh]\ndisplay = \"s.obj\"\n");
    std::fs::write(folder.path().join("a.toml"), text).unwrap();
    let scene = fem_scene::load(folder.path().join("a.toml").to_str().unwrap(), folder.path()).unwrap();
    let body = fem_scene::body(&scene, folder.path()).unwrap();
    fem_engine::simulator::build(body, &scene.method()).unwrap()
}

#[test]
fn a_display_surface_is_skinned_only_on_request() {
    let mut simulation = with_display();
    run(&mut *simulation, 3);
    assert_eq!((simulation.counters().skinning_rows, find(&simulation.parts(), "skinning").uses), (0, 0));
    simulation.display_positions();
    assert_eq!(simulation.counters().skinning_rows, 3);
    assert!(is_at_work(find(&simulation.parts(), "skinning")) && find(&simulation.parts(), "skinning").bytes > 0);
    assert!(costs_nothing(find(&parts(&soft("verlet", 1e-3, "")), "skinning")));
}

#[test]
fn the_times_of_the_parts_add_up_to_less_than_the_steps_took() {
    let rest = format!("{CLAMP}{WEIGHT}{TRACTION}pressure = 1e3\n[damping]\nbeta = 1e-3\n");
    let mut simulation = build(&soft("implicit_euler", 1e-2, &rest));
    let start = std::time::Instant::now();
    run(&mut *simulation, 50);
    let (total, parts) = (start.elapsed().as_secs_f64(), simulation.parts());
    let sum: f64 = parts.iter().map(|part| part.seconds).sum();
    assert!(sum > 0.0 && sum <= total, "{sum} s of {total} s");
}

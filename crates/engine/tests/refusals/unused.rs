//! Tables that have no effect with the integrator of the scene.

use std::path::Path;

use fem_model::Integrator;
use fem_scene::{SceneError, parse};

use crate::{ALL, edit};

#[test]
fn tables_without_effect_are_refused_with_the_method_and_the_remedy() {
    let with_static = format!("{ALL}[static]\nload_steps = 2\n");
    let cases = [
        (with_static.clone(), "implicit_euler", "static"),
        (with_static, "verlet", "static"),
        (ALL.to_owned(), "linearly_implicit_euler", "newton"),
        (ALL.to_owned(), "rk4", "newton"),
        (
            edit(ALL, "[newton]\nmax_iterations = 9\ntolerance = 1e-9\nprojection = \"when_needed\"\n", ""),
            "verlet",
            "solver",
        ),
        (ALL.to_owned(), "static", "damping"),
        (format!("{ALL}[newmark]\nbeta = 0.25\n"), "implicit_euler", "newmark"),
        (format!("{ALL}[generalized_alpha]\nspectral_radius = 0.5\n"), "bdf2", "generalized_alpha"),
    ];
    for (text, integrator, table) in cases {
        let text = edit(&text, "\"implicit_euler\"", &format!("\"{integrator}\""));
        let Err(SceneError::Line { line, problem, .. }) = parse(&text, Path::new("folder/name.toml")) else {
            panic!("taken: {integrator} with [{table}]")
        };
        assert!(text.lines().nth(line - 1).is_some_and(|line| line.contains(table)), "line {line} of\n{text}");
        let beginning =
            format!("{table} has no effect with time.integrator = \"{integrator}\"; remove the table, or use");
        assert!(problem.starts_with(&beginning), "{problem}");
        let mut scene = parse(ALL, Path::new("folder/name.toml")).unwrap();
        scene.time.integrator = Integrator::from_name(integrator).unwrap();
        scene.remove_unused_tables();
        scene.check().unwrap();
    }
}

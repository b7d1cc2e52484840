//! `[batch]`: the values of its environments, and its errors at their lines.

use crate::errors::assert_refused;
use crate::{LEAST, edit, read};

/// A scene of the engine with a batch, whose table begins in line 14.
const BATCH: &str = r#"[gravity]
acceleration = [0, 0, -10]
[batch]
count = 5
[batch.vary]
density = { from = 500, to = 900 }
gravity = { from = 0.5, to = 8, spacing = "geometric" }
"#;

fn batch() -> String {
    edit(LEAST, "course", "engine") + BATCH
}

fn elastic() -> String {
    let text = edit(&batch(), "C = 1e5\nD = 4e5\n", "young = 1e5\npoisson = 0.3\n");
    text + "young = { from = 4e5, to = 1e5 }\npoisson = { from = 0, to = 0.4 }\n"
}

#[test]
fn values_run_from_the_first_environment_to_the_last() {
    let scene = read(&elastic());
    assert_eq!(scene.environments(), 5);
    let values = |number: usize| scene.batch.as_ref().unwrap().values(number);
    let of = |number: usize| values(number).varied().collect::<Vec<_>>();
    assert_eq!(of(0), [("young", 4e5), ("poisson", 0.0), ("density", 500.0), ("gravity", 0.5)]);
    assert_eq!(of(4), [("young", 1e5), ("poisson", 0.4), ("density", 900.0), ("gravity", 8.0)]);
    assert_eq!(of(2)[..3], [("young", 2.5e5), ("poisson", 0.2), ("density", 700.0)]);
    assert!((of(2)[3].1 - 2.0).abs() < 1e-12);
}

#[test]
fn an_environment_is_the_scene_with_its_values() {
    let scene = read(&elastic());
    let last = scene.environment(4);
    assert_eq!(last.batch, None);
    assert_eq!((last.material.young, last.material.poisson, last.material.density), (Some(1e5), Some(0.4), 900.0));
    assert_eq!(last.gravity.unwrap().acceleration, [0.0, 0.0, -80.0]);
    let one = read(&edit(&elastic(), "count = 5", "count = 1"));
    assert_eq!((one.environments(), one.environment(0).material.young), (1, Some(4e5)));
    let single = read(LEAST);
    assert_eq!((single.environments(), single.environment(0).material), (1, single.material));
}

#[test]
fn what_a_batch_cannot_be_is_refused_at_its_line() {
    let refused =
        |from: &str, to: &str, line, beginning: &str| assert_refused(&edit(&batch(), from, to), line, beginning);
    refused("engine", "course", 14, "batch belongs to the engine; ");
    refused("count = 5", "count = 0", 15, "batch.count is 0; give 1 to 65536 environments");
    refused("count = 5", "count = 65537", 15, "batch.count is 65537; ");
    refused("to = 900", "to = inf", 17, "batch.vary.density.to is inf; ");
    refused("from = 500", "from = nan", 17, "batch.vary.density.from is NaN; ");
    refused(
        "from = 500",
        "from = -500",
        17,
        "batch.vary.density leads to a value that the material cannot have in environment 0",
    );
    refused(
        "from = 0.5",
        "from = 0",
        18,
        "batch.vary.gravity.from is 0, and a geometric spacing has positive values; ",
    );
    refused("to = 8,", "to = -8,", 18, "batch.vary.gravity.to is -8, and a geometric spacing");
    refused(
        "density = {",
        "young = {",
        17,
        "batch.vary.young varies a key that the material lacks; give it material.young",
    );
    refused("[gravity]\nacceleration = [0, 0, -10]\n", "", 16, "batch.vary.gravity varies a table that is not there; ");
    refused("implicit_euler", "static", 14, "batch has environments that move, ");
    refused("spacing = \"geometric\"", "spacing = \"random\"", 18, "unknown variant `random`");
    refused("gravity = {", "mass = {", 18, "unknown field `mass`");
    refused("count = 5\n", "", 14, "missing field `count`");
    let materials = "[[materials]]\non = \"all\"\nmodel = \"neo_hookean\"\nC = 1e5\nD = 4e5\ndensity = 1\n";
    assert_refused(&(batch() + materials), 17, "batch.vary.density varies the density of one material of several; ");
    assert_refused(
        &edit(&elastic(), "to = 0.4", "to = 0.5"),
        20,
        "batch.vary.poisson leads to a value that the material cannot have in environment 4: it is 0.5; ",
    );
}

#[test]
fn a_device_steps_explicit_methods_and_vbd_of_a_batch_alone() {
    let solver = "[solver]\nkind = \"gpu\"\n";
    for method in ["explicit_euler", "semi_implicit_euler", "rk2", "rk4", "verlet", "vbd"] {
        let text = edit(&batch(), "implicit_euler", method) + solver;
        read(&text);
        let text = edit(&text, BATCH, "");
        assert_refused(&text, 12, &format!("solver has no effect with time.integrator = \"{method}\"; "));
        assert_refused(&text.replace("gpu", "pcg"), 12, "solver has no effect");
    }
    assert_refused(&(edit(&batch(), "implicit_euler", "xpbd") + solver), 19, "solver has no effect");
}

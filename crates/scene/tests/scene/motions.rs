//! `[[prescribed]]`: nodes, positions over time, and conflicts with other conditions.

use std::f64::consts::FRAC_1_SQRT_2;

use fem_model::{DirichletCondition, Motion};
use nalgebra::Vector3;

use crate::errors::assert_refused;
use crate::{LEAST, body, edit, read};

const ON: &str = "on = { axis = \"x\", side = \"max\", within = 1e-9 }";

/// The first `[[prescribed]]` of the smallest scene, with these lines in it.
fn condition(lines: &str) -> DirichletCondition {
    body(&format!("{LEAST}[[prescribed]]\n{ON}\n{lines}\n")).unwrap().dirichlet.remove(0)
}

fn motion(lines: &str) -> Motion {
    condition(lines).motion.unwrap()
}

/// The nodes of every condition of a scene.
fn nodes(text: &str) -> Vec<Vec<usize>> {
    body(text).unwrap().dirichlet.into_iter().map(|condition| condition.nodes).collect()
}

#[test]
fn a_displacement_grows_linearly_and_then_stays() {
    let motion = motion("displacement = [1, 2, 3]\nover = 4");
    let fractions = [0.0, 1.0, 4.0, 100.0].map(|time| motion.fraction(time));
    assert_eq!(fractions, [0.0, 0.25, 1.0, 1.0]);
    let X = Vector3::new(10.0, 20.0, 30.0);
    assert_eq!(motion.position(&X, 0.0), X);
    assert_eq!(motion.position(&X, 0.5), Vector3::new(10.5, 21.0, 31.5));
    assert_eq!(motion.position(&X, 1.0), Vector3::new(11.0, 22.0, 33.0));
}

#[test]
fn a_motion_without_a_duration_applies_in_full_from_the_start() {
    assert_eq!(motion("displacement = [1, 0, 0]").fraction(0.0), 1.0);
}

#[test]
fn a_rotation_turns_counter_clockwise_about_its_centre() {
    let X = Vector3::new(7.0, 2.0, 1.0);
    let places = [("x", [7.0, 1.0, 2.0]), ("y", [1.0, 2.0, -5.0]), ("z", [0.0, 7.0, 1.0])];
    for (axis, expected) in places {
        let motion = motion(&format!("rotation = {{ axis = \"{axis}\", center = [1, 1, 1], turns = 0.5 }}"));
        let quarter = motion.position(&X, 0.5);
        assert!((quarter - Vector3::from(expected)).norm() < 1e-14, "{axis}: {quarter}");
        let still = motion.position(&Vector3::repeat(1.0), 0.3);
        assert!((still - Vector3::repeat(1.0)).norm() < 1e-15, "the centre stays");
    }
}

#[test]
fn a_rotation_and_a_displacement_make_a_screw() {
    let motion =
        motion("rotation = { axis = \"x\", center = [0, 0, 0], turns = 1 }\ndisplacement = [8, 0, 0]\nover = 1");
    let place = motion.position(&Vector3::y(), motion.fraction(0.125));
    assert!((place - Vector3::new(1.0, FRAC_1_SQRT_2, FRAC_1_SQRT_2)).norm() < 1e-15, "{place}");
}

#[test]
fn only_named_components_are_prescribed() {
    assert_eq!(condition("displacement = [0, 0, 0]\ncomponents = [\"x\", \"z\"]").components, [true, false, true]);
    assert_eq!(condition("displacement = [0, 0, 0]").components, [true; 3]);
}

#[test]
fn prescribed_nodes_are_those_of_a_side_or_of_a_list() {
    let text = format!(
        "{LEAST}[[prescribed]]\n{ON}\ndisplacement = [1, 0, 0]\n[[prescribed]]\nnodes = [4, 0, 4]\ndisplacement = [0, 0, 0]\n"
    );
    assert_eq!(nodes(&text), [vec![2, 5, 8, 11], vec![0, 4]]);
}

#[test]
fn symmetry_planes_may_share_an_edge() {
    let plane = |axis: &str| {
        let on = format!("on = {{ axis = \"{axis}\", side = \"min\", within = 0 }}");
        format!("[[prescribed]]\n{on}\ndisplacement = [0, 0, 0]\ncomponents = [\"{axis}\"]\n")
    };
    let text = format!("{LEAST}{}{}", plane("x"), plane("y"));
    assert_eq!(nodes(&text), [vec![0, 3, 6, 9], vec![0, 1, 2, 6, 7, 8]]);
}

#[test]
fn a_node_is_fixed_or_prescribed_and_each_coordinate_once() {
    let refused = |tables: &str, end: &str| {
        let message = body(&format!("{LEAST}{tables}")).unwrap_err().to_string();
        assert!(message.ends_with(end), "{message}");
    };
    let roller = format!("[[prescribed]]\n{ON}\ndisplacement = [0, 0, 0]\ncomponents = [\"x\"]\n");
    refused(
        &format!("[fixed]\nnodes = [8]\n{roller}"),
        "prescribed[0] moves node 8, which [fixed] constrains; name each node in one of the two",
    );
    refused(
        &format!("{roller}[[prescribed]]\nnodes = [1, 5]\ndisplacement = [0, 0, 0]\n"),
        "prescribed[1] moves x of node 5, and so does prescribed[0]; name each coordinate once",
    );
    refused(
        "[[prescribed]]\nnodes = [12]\ndisplacement = [0, 0, 0]\n",
        "prescribed[0].nodes names node 12; the mesh has nodes 0 to 11",
    );
}

#[test]
fn a_release_has_a_time_in_a_scene_that_moves() {
    let tables = format!(
        "{LEAST}[fixed]\nnodes = [0]\nuntil = 2.5\n[[prescribed]]\n{ON}\ndisplacement = [1, 0, 0]\nuntil = 4\n"
    );
    let until: Vec<_> = body(&tables).unwrap().dirichlet.into_iter().map(|condition| condition.until).collect();
    assert_eq!(until, [Some(2.5), Some(4.0)]);
    assert_refused(&edit(&tables, "2.5", "0"), 14, "fixed.until is 0; give a positive number of seconds");
    assert_refused(&edit(&tables, "until = 4", "until = nan"), 18, "prescribed[0].until is NaN; give a positive");
    assert_refused(
        &edit(&tables, "implicit_euler", "static"),
        14,
        "fixed.until is a time, and static has none; remove",
    );
}

#[test]
fn a_prescribed_table_is_checked_at_its_line() {
    let good = format!(
        "{LEAST}[[prescribed]]\n{ON}\nrotation = {{ axis = \"x\", center = [0, 0, 0], turns = 2 }}\nover = 1\n"
    );
    read(&good);
    let refused = |from: &str, to: &str, line: usize, beginning: &str| {
        assert_refused(&edit(&good, from, to), line, beginning);
    };
    refused("over = 1", "over = 0", 15, "prescribed[0].over is 0; give a positive number of seconds");
    refused("turns = 2", "turns = inf", 14, "prescribed[0].rotation.turns is inf");
    refused("[0, 0, 0]", "[0, nan, 0]", 14, "prescribed[0].rotation.center is NaN");
    refused("[0, 0, 0]", "[0, 0]", 14, "invalid length 2, expected three numbers");
    refused("within = 1e-9", "within = nan", 13, "prescribed[0].on has within = NaN");
    refused(ON, "", 12, "prescribed[0] needs one of on, box, sphere, set and nodes; give one and only one");
    refused(
        ON,
        &format!("{ON}\nnodes = [1]"),
        12,
        "prescribed[0] needs one of on, box, sphere, set and nodes; give one and only one",
    );
    refused("over = 1", "components = [\"x\"]", 15, "prescribed[0].components stands beside rotation");
    refused("over = 1", "speed = 1", 15, "unknown field `speed`");

    let shift = |lines: &str| format!("{LEAST}[[prescribed]]\n{ON}\n{lines}\n");
    assert_refused(&shift("over = 1"), 12, "prescribed[0] has no motion; give displacement, rotation or velocity");
    let free = "displacement = [0, 1, 0]\ncomponents = [\"x\"]";
    assert_refused(&shift(free), 15, "prescribed[0].components leaves y free, and displacement moves it; name y");
    assert_refused(&shift("displacement = [0, 0, 0]\ncomponents = []"), 15, "prescribed[0].components is empty");
    let fast = |lines: &str| shift(&format!("velocity = [0, 1, 0]\n{lines}"));
    read(&fast(""));
    read(&fast("curve = { ramp = 2 }"));
    assert_refused(&shift("velocity = [0, nan, 0]"), 14, "prescribed[0].velocity is NaN");
    assert_refused(&fast("displacement = [0, 1, 0]"), 14, "prescribed[0].velocity stands beside displacement");
    assert_refused(
        &fast("over = 1"),
        15,
        "prescribed[0].over is the duration of a displacement, and stands beside velocity",
    );
    assert_refused(
        &fast("components = [\"x\"]"),
        15,
        "prescribed[0].components leaves y free, and velocity moves it; name y",
    );
    let still = edit(&fast(""), "\"implicit_euler\"", "\"static\"").replace("\"course\"", "\"engine\"");
    assert_refused(&still, 14, "prescribed[0].velocity is a motion in time, and time.integrator = \"static\" has none");
}

#[test]
fn a_velocity_is_integrated_exactly_whatever_its_curve() {
    use fem_model::LoadCurve;
    let curves = [
        None,
        Some(LoadCurve::Ramp(0.7)),
        Some(LoadCurve::Table(vec![[0.1, 2.0], [0.5, -1.0], [1.3, 4.0]])),
        Some(LoadCurve::Table(vec![[-1.0, 3.0], [-0.5, 1.0]])),
        Some(LoadCurve::Sine { frequency: 1.5, phase: 0.4 }),
        Some(LoadCurve::Switch { on: 0.25, off: 1.5 }),
        Some(LoadCurve::Switch { on: f64::NEG_INFINITY, off: f64::INFINITY }),
    ];
    for curve in curves {
        let integral = LoadCurve::Integral(curve.clone().map(Box::new));
        let (n, end) = (200_000, 2.0);
        let mut sum = 0.0;
        for k in 0..n {
            let (from, to) = (end * f64::from(k) / f64::from(n), end * f64::from(k + 1) / f64::from(n));
            let middle = 0.5 * (from + to);
            let factor = |time: f64| curve.as_ref().map_or(1.0, |curve| curve.factor(time));
            sum += (to - from) * factor(middle);
            if k % 5000 == 0 {
                assert!((integral.factor(to) - sum).abs() < 2e-5, "{curve:?} at {to} s");
                assert_eq!(integral.derivatives(middle)[0], factor(middle), "{curve:?} at {middle} s");
            }
        }
        assert_eq!(integral.factor(0.0), 0.0, "{curve:?}");
        assert!(!integral.has_jumps());
    }
}

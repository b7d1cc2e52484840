//! Scenes with contact that are refused, each with the field and the remedy.

use crate::{CUBE, SQUARE, floor, text, try_build};

fn assert_refused(text: &str, parts: &[&str]) {
    let Err(error) = try_build(text) else { panic!("not refused:\n{text}") };
    let message = error.to_string();
    for part in parts {
        assert!(message.contains(part), "no {part:?} in: {message}");
    }
}

fn with(method: &str, tables: &str) -> String {
    text(CUBE, "neo_hookean", 1e5, method, 0.01, tables)
}

#[test]
fn a_start_in_penetration_is_refused_with_node_plane_and_depth() {
    for method in ["implicit_euler", "verlet"] {
        assert_refused(&with(method, &floor(0.25, "")), &["line ", "planes[0]", "node 0", "2.500e-1 m", "point"]);
    }
    let two = floor(-1.0, "") + "[[planes]]\npoint = [0.5, 0, 0]\nnormal = [-2, 0, 0]\n";
    assert_refused(&with("verlet", &two), &["planes[1]", "node 2", "5.000e-1 m"]);
    assert!(try_build(&with("verlet", &floor(0.0, ""))).is_ok());
}

#[test]
fn methods_without_contact_and_keys_without_meaning_are_refused_with_both_keys() {
    let plane = floor(-1.0, "");
    let both = ["planes", "time.integrator = \"linearly_implicit_euler\"", "implicit_euler"];
    assert_refused(&with("linearly_implicit_euler", &plane), &both);
    assert_refused(
        &with("verlet", &(plane.clone() + "[mass]\nlumped = false\n")),
        &["mass.lumped", "[[planes]]", "verlet"],
    );
    let contact = "[contact]\nactivation_distance = 1e-3\n";
    assert_refused(&with("verlet", &(plane.clone() + contact)), &["contact has no effect", "verlet"]);
    assert_refused(&with("implicit_euler", contact), &["contact stands without [[planes]]"]);
    let speed = "[contact]\ntransition_speed = 1e-3\n";
    assert_refused(&with("implicit_euler", &(plane + speed)), &["contact.transition_speed", "friction"]);
    assert_refused(&with("static", &floor(-1.0, "friction = 0.3")), &["planes[0].friction", "static"]);
    assert_refused(&with("static", &floor(-1.0, "velocity = [0, 1, 0]")), &["planes[0].velocity", "static"]);
    assert_refused(&with("verlet", &floor(-1.0, "until = 1")), &["planes[0].until", "velocity"]);
}

#[test]
fn a_curve_and_a_displacement_of_a_plane_belong_together_and_do_not_jump() {
    let plane = |keys: &str| with("implicit_euler", &floor(-1.0, keys));
    let both = "displacement = [0, 0.5, 0]\ncurve = { ramp = 1.0 }";
    assert!(try_build(&plane(both)).is_ok());
    assert_refused(&plane("displacement = [0, 0.5, 0]"), &["planes[0].displacement", "curve"]);
    assert_refused(&plane("curve = { ramp = 1.0 }"), &["planes[0].curve", "displacement"]);
    assert_refused(&plane(&format!("{both}\nvelocity = [0, 1, 0]")), &["planes[0].displacement", "velocity"]);
    assert_refused(&plane(&both.replace("ramp", "on")), &["planes[0].curve jumps", "ramp"]);
    assert_refused(&plane(&both.replace("ramp = 1.0", "ramp = -1.0")), &["planes[0].curve.ramp is -1"]);
    assert!(try_build(&with("static", &floor(-1.0, both))).is_ok());
    // A curve that does not begin at zero moves the plane at once, here into the body.
    let inside = "displacement = [0, 2, 0]\ncurve = { table = [[0, 1], [1, 0]] }";
    assert_refused(&plane(inside), &["planes[0]", "behind it at the start"]);
}

#[test]
fn numbers_that_make_no_plane_are_refused() {
    let plane = |from: &str, to: &str| with("implicit_euler", &floor(-1.0, "friction = 0.5").replace(from, to));
    assert_refused(&plane("[0, 1, 0]", "[0, 0, 0]"), &["planes[0].normal is zero"]);
    assert_refused(&plane("[0, 1, 0]", "[0, 1e-300, 0]"), &["planes[0].normal", "too small"]);
    assert_refused(&plane("[0, 1, 0]", "[0, nan, 0]"), &["planes[0].normal"]);
    assert_refused(&plane("[0, 1, 0]", "[0, 1]"), &["three numbers"]);
    assert_refused(&plane("0.5", "-0.5"), &["planes[0].friction is -0.5"]);
    assert_refused(&plane("friction", "frictoin"), &["frictoin"]);
    let contact = "[contact]\nactivation_distance = 0\n";
    assert_refused(&with("implicit_euler", &(floor(-1.0, "") + contact)), &["contact.activation_distance is 0"]);
}

#[test]
fn planes_of_a_flat_body_stand_upright_on_its_plane() {
    let tilted = "[[planes]]\npoint = [0, -1, 0]\nnormal = [0, 1, 0.1]\n";
    assert_refused(&text(SQUARE, "neo_hookean", 1e5, "verlet", 1e-3, tilted), &["planes[0].normal", "z = 0"]);
    let moving = floor(-1.0, "velocity = [0, 0, 1]");
    assert_refused(&text(SQUARE, "neo_hookean", 1e5, "verlet", 1e-3, &moving), &["planes[0].velocity", "z = 0"]);
    let moving = floor(-1.0, "displacement = [0, 0, 1]\ncurve = { ramp = 1.0 }");
    assert_refused(&text(SQUARE, "neo_hookean", 1e5, "verlet", 1e-3, &moving), &["planes[0].displacement", "z = 0"]);
}

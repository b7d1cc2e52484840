//! `curve`: the factor of each kind, and its errors at their lines.

use fem_model::LoadCurve;

use crate::errors::assert_refused;
use crate::{LEAST, body, edit};

const GRAVITY: &str = "[gravity]\nacceleration = [0, -10, 0]\n";

/// The smallest scene with a curve on gravity, in line 14.
fn scene(curve: &str) -> String {
    format!("{LEAST}{GRAVITY}curve = {curve}\n")
}

fn curve(text: &str) -> LoadCurve {
    body(&scene(text)).unwrap().gravity_curve.unwrap()
}

fn factors<const N: usize>(text: &str, times: [f64; N]) -> [f64; N] {
    let curve = curve(text);
    times.map(|time| curve.factor(time))
}

#[test]
fn a_ramp_grows_from_0_to_1_and_stays() {
    assert_eq!(factors("{ ramp = 2.0 }", [-1.0, 0.0, 0.5, 2.0, 9.0]), [0.0, 0.0, 0.25, 1.0, 1.0]);
}

#[test]
fn a_table_is_linear_between_its_points_and_constant_outside() {
    let table = "{ table = [[1, 2], [3, -2], [4, 0.5]] }";
    assert_eq!(factors(table, [0.0, 1.0, 2.0, 3.0, 3.5, 4.0, 5.0]), [2.0, 2.0, 0.0, -2.0, -0.75, 0.5, 0.5]);
    assert_eq!(factors("{ table = [[1, 7]] }", [0.0, 1.0, 2.0]), [7.0; 3]);
}

#[test]
fn a_sine_has_its_frequency_and_its_phase() {
    let found = factors("{ sine = { frequency = 0.5, phase = 0.25 } }", [0.0, 1.0, 2.0]);
    for (found, expected) in found.into_iter().zip([0.25f64.sin(), -(0.25f64.sin()), 0.25f64.sin()]) {
        assert!((found - expected).abs() < 1e-15, "{found} {expected}");
    }
    assert_eq!(factors("{ sine = { frequency = 2 } }", [0.0]), [0.0]);
}

#[test]
fn a_switch_is_half_open_and_either_end_may_be_left_out() {
    assert_eq!(factors("{ on = 1, off = 2 }", [0.5, 1.0, 1.5, 2.0]), [0.0, 1.0, 1.0, 0.0]);
    assert_eq!(factors("{ on = 1 }", [0.5, 1.0, 1e9]), [0.0, 1.0, 1.0]);
    assert_eq!(factors("{ off = 1 }", [0.0, 0.5, 1.0]), [1.0, 1.0, 0.0]);
}

#[test]
fn derivatives_agree_with_finite_differences() {
    let curves =
        ["{ ramp = 2.0 }", "{ table = [[0, 1], [1, 3], [2, 0]] }", "{ sine = { frequency = 0.3, phase = 1 } }"];
    for text in curves {
        let (curve, h) = (curve(text), 1e-4);
        for time in [0.3, 0.7, 1.1, 1.9, 5.0] {
            let [first, second] = curve.derivatives(time);
            let [before, at, after] = [time - h, time, time + h].map(|time| curve.factor(time));
            assert!(((after - before) / (2.0 * h) - first).abs() < 1e-7, "{text} at {time}");
            assert!(((after - 2.0 * at + before) / (h * h) - second).abs() < 1e-6, "{text} at {time}");
        }
    }
}

#[test]
fn every_load_and_every_prescribed_motion_takes_a_curve() {
    let side = "on = { axis = \"x\", side = \"max\", within = 1e-9 }\n";
    let ramp = "curve = { ramp = 4 }\n";
    let text = format!(
        "{LEAST}{GRAVITY}{ramp}[body_force]\ndensity = [1, 0, 0]\n{ramp}[[traction]]\n{side}pressure = 5\n{ramp}\
         [[traction]]\n{side}force_per_area = [0, 0, 5]\n{ramp}[[prescribed]]\n{side}displacement = [1, 0, 0]\n{ramp}"
    );
    let body = body(&text).unwrap();
    let expected = Some(LoadCurve::Ramp(4.0));
    let motion = body.dirichlet[0].motion.clone().unwrap();
    let found = [&body.gravity_curve, &body.body_force_curve, &body.pressures[0].curve, &body.tractions[0].curve];
    assert!(found.into_iter().all(|curve| *curve == expected), "{body:?}");
    assert_eq!((motion.curve.clone(), motion.fraction(1.0)), (expected, 0.25));
}

#[test]
fn a_curve_is_checked_at_its_line() {
    let refused =
        |curve: &str, beginning: &str| assert_refused(&scene(curve), 14, &format!("gravity.curve{beginning}"));
    refused("{}", " needs one kind of curve; give either");
    refused("{ ramp = 1, on = 2 }", " needs one kind of curve; give either");
    refused("{ ramp = 0 }", ".ramp is 0; give a positive number of seconds");
    refused("{ ramp = nan }", ".ramp is NaN; give");
    refused("{ table = [] }", ".table is empty; give pairs");
    refused("{ table = [[0, 1], [1]] }", ".table[1] has 1 numbers; give a pair");
    refused("{ table = [[0, 1], [0, 2]] }", ".table[1] is at 0 s, not after 0 s; give times that increase");
    refused("{ table = [[0, inf]] }", ".table[0] is inf; give finite numbers");
    refused("{ sine = { frequency = 0 } }", ".sine.frequency is 0; give a positive number of Hz");
    refused("{ sine = { frequency = 1, phase = nan } }", ".sine.phase is NaN");
    refused("{ on = 2, off = 2 }", ".off is 2, not after on = 2; give a later time");
    refused("{ on = inf }", ".on is inf; give finite numbers");
    assert_refused(&scene("{ step = 1 }"), 14, "unknown field `step`");
}

#[test]
fn a_curve_along_a_path_by_arc_length_or_beside_over_is_refused() {
    let still = edit(&scene("{ ramp = 1 }"), "implicit_euler", "static");
    assert!(body(&still).is_ok(), "load steps count a pseudo-time");
    let path = format!("{still}[static]\nload_steps = 2\narc_length = true\n");
    assert_refused(&path, 14, "gravity.curve is a factor of its own, and along an equilibrium path");
    let motion = "[[prescribed]]\nnodes = [1]\ndisplacement = [1, 0, 0]\nover = 1\ncurve = { ramp = 1 }\n";
    assert_refused(&format!("{LEAST}{motion}"), 16, "prescribed[0].curve stands beside over");
}

#[test]
fn a_load_that_ends_with_a_step_ends_there_whatever_the_round_off() {
    for dt in [0.1, 1e-3, 1.0 / 3.0] {
        let mut time = 0.0;
        for step in 1..=10_000 {
            time += dt;
            let end: f64 = format!("{:.9}", dt * f64::from(step)).parse().unwrap();
            let curve = LoadCurve::Switch { on: f64::NEG_INFINITY, off: end };
            assert_eq!(curve.factor(time), 0.0, "step {step} of {dt} s");
            assert_eq!(curve.factor(time - dt), 1.0, "the step before step {step} of {dt} s");
        }
    }
}

//! `[plasticity]`: its values, and its errors at their lines.

use fem_model::Plasticity;

use crate::errors::assert_refused;
use crate::{body, edit};

/// A scene with every key of the additive model.
const ADDITIVE: &str = r#"pipeline = "engine"
[mesh]
box = { size = [2, 1, 1], cells_per_unit = 1 }
[material]
model = "corotated"
young = 1e5
poisson = 0.3
density = 1000.0
[plasticity]
model = "additive"
yield_strain = 0.05
creep = 2.0
maximum = 0.6
[time]
dt = 0.01
integrator = "implicit_euler"
"#;

const KEYS: &str = "model = \"additive\"\nyield_strain = 0.05\ncreep = 2.0\nmaximum = 0.6\n";

fn j2(keys: &str) -> String {
    edit(&edit(ADDITIVE, KEYS, &format!("model = \"j2\"\n{keys}")), "\"corotated\"", "\"hencky\"")
}

#[test]
fn a_body_has_the_plasticity_of_its_scene() {
    let flow = |text: &str| body(text).unwrap().plasticity;
    let additive = |maximum: f64| Some(Plasticity::Additive { yield_strain: 0.05, creep: 2.0, maximum });
    assert_eq!(flow(ADDITIVE), additive(0.6));
    assert_eq!(flow(&edit(ADDITIVE, "maximum = 0.6\n", "")), additive(f64::INFINITY));
    let of = |hardening: f64| Some(Plasticity::J2 { yield_stress: 1e4, hardening });
    assert_eq!(flow(&j2("yield_stress = 1e4\nhardening = 1e3\n")), of(1e3));
    assert_eq!(flow(&j2("yield_stress = 1e4\n")), of(0.0));
    assert_eq!(flow(&edit(ADDITIVE, &format!("[plasticity]\n{KEYS}"), "")), None);
}

#[test]
fn numbers_out_of_range_are_refused_at_their_line() {
    for value in ["0", "-1", "nan", "inf"] {
        for (key, line) in [("yield_strain = 0.05", 11), ("creep = 2.0", 12), ("maximum = 0.6", 13)] {
            let name = key.split(' ').next().unwrap();
            let text = edit(ADDITIVE, key, &format!("{name} = {value}"));
            assert_refused(&text, line, &format!("plasticity.{name} is "));
        }
        assert_refused(&j2(&format!("yield_stress = {value}\n")), 11, "plasticity.yield_stress is ");
    }
    assert_refused(&j2("yield_stress = 1e4\nhardening = -1\n"), 12, "plasticity.hardening is -1; give 0 Pa or more");
}

#[test]
fn keys_that_are_missing_or_belong_to_the_other_model_are_refused() {
    assert_refused(&j2(""), 9, "plasticity.yield_stress is missing, and plasticity.model = \"j2\" needs it; give");
    assert_refused(&edit(ADDITIVE, "creep = 2.0\n", ""), 9, "plasticity.creep is missing");
    let mixed = edit(ADDITIVE, "creep = 2.0", "creep = 2.0\nyield_stress = 1e4");
    assert_refused(
        &mixed,
        13,
        "plasticity.yield_stress belongs to plasticity.model = \"j2\", and this one is \"additive\"",
    );
    let mixed = j2("yield_stress = 1e4\nmaximum = 0.6\n");
    assert_refused(&mixed, 12, "plasticity.maximum belongs to plasticity.model = \"additive\", and this one is \"j2\"");
    assert_refused(&edit(ADDITIVE, "\"additive\"", "\"magic\""), 10, "unknown variant `magic`");
}

#[test]
fn a_model_needs_its_law_in_every_material_and_the_additive_one_a_time() {
    let other = edit(ADDITIVE, "\"corotated\"", "\"st_venant_kirchhoff\"");
    assert_refused(
        &other,
        5,
        "material.model is \"st_venant_kirchhoff\", and plasticity.model = \"additive\" is a flow of",
    );
    let region = "[[materials]]\non = \"all\"\nmodel = \"linear\"\nyoung = 1e3\npoisson = 0.3\ndensity = 1.0\n";
    assert_refused(&format!("{ADDITIVE}{region}"), 19, "materials[0].model is \"linear\", and plasticity.model");
    let still = edit(ADDITIVE, "\"implicit_euler\"", "\"static\"");
    assert_refused(&still, 10, "plasticity.model is \"additive\", which flows with the time");
    assert!(body(&edit(&j2("yield_stress = 1e4\n"), "\"implicit_euler\"", "\"static\"")).is_ok());
}

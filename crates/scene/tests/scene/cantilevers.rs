//! Which scenes are cantilevers, and what their tips should do.

use approx::assert_relative_eq;
use fem_scene::cantilever::expected_tip_displacement;
use fem_scene::load;

use crate::{data, edit, read};

const BEAM: &str = r#"pipeline = "engine"
[mesh]
box = { size = [8, 1, 2], cells_per_unit = 1 }
[material]
model = "neo_hookean"
C = 2e5
D = 1e6
density = 1000.0
[gravity]
acceleration = [0, 0, -1]
[fixed]
plane = { axis = "x", below = 0 }
[time]
dt = 1
integrator = "static"
"#;

#[test]
fn the_shipped_cantilever_bends_by_a_tenth_of_a_metre() {
    let tip = expected_tip_displacement(&load("cantilever", &data()).unwrap()).unwrap();
    assert_relative_eq!(tip.z, -(0.1024 + 0.001224), max_relative = 1e-9);
    assert_eq!((tip.x, tip.y), (0.0, 0.0));
}

#[test]
fn a_beam_under_its_weight_takes_its_moduli_from_c_and_d() {
    // E = 18 C D/(3 D + C) = 1.125e6, ν = 0.40625; w = 2000 N/m, I = 1·2³/12
    let tip = expected_tip_displacement(&read(BEAM)).unwrap();
    let (E, nu): (f64, f64) = (1.125e6, 0.40625);
    let bending = 2000.0 * 8f64.powi(4) / (8.0 * E * 8.0 / 12.0);
    let kappa = 10.0 * (1.0 + nu) / (12.0 + 11.0 * nu);
    let shear = 2000.0 * 64.0 / (2.0 * kappa * E / (2.0 * (1.0 + nu)) * 2.0);
    assert_relative_eq!(tip.z, -(bending + shear), max_relative = 1e-12);
}

#[test]
fn the_weight_and_a_body_force_of_the_same_size_against_it_leave_the_beam_straight() {
    let tip = expected_tip_displacement(&read(&format!("{BEAM}[body_force]\ndensity = [0, 0, 1000]\n"))).unwrap();
    assert_eq!(tip.norm(), 0.0);
}

#[test]
fn other_scenes_are_no_cantilevers() {
    let is_none = |text: &str| assert_eq!(expected_tip_displacement(&read(text)), None, "{text}");
    is_none(&edit(BEAM, "\"static\"", "\"implicit_euler\""));
    is_none(&edit(BEAM, "axis = \"x\"", "axis = \"y\""));
    is_none(&edit(BEAM, "below = 0", "below = 1"));
    is_none(&edit(BEAM, "[0, 0, -1]", "[1, 0, -1]"));
    let on = |side: &str| format!("[[traction]]\non = {{ axis = \"x\", side = \"{side}\", within = 0 }}\n");
    is_none(&format!("{BEAM}{}pressure = 1\n", on("max")));
    is_none(&format!("{BEAM}{}force_per_area = [0, 1, 0]\n", on("min")));
    is_none(&format!("{BEAM}[[springs]]\nnodes = [0, 1]\nstiffness = 1\n"));
    for name in ["beam", "bar", "twist", "arma"] {
        assert_eq!(expected_tip_displacement(&load(name, &data()).unwrap()), None, "{name}");
    }
}

//! Plastic flow in the files of a run.

use crate::program::{Desk, assert_names};

/// A flat strip, thrown apart at one end.
const STRIP: &str = r#"pipeline = "engine"
[mesh]
rectangle = { size = [2, 1], cells_per_unit = 3 }
[material]
model = "LAW"
young = 1e5
poisson = 0.3
density = 1000.0
MODEL
[[initial_velocity]]
on = { axis = "x", side = "max", within = 1e-9 }
velocity = [4, 0.5, 0]
[time]
dt = 1e-4
integrator = "verlet"
steps = 2000
"#;

const MODELS: [(&str, &str); 2] = [
    ("corotated", "[plasticity]\nmodel = \"additive\"\nyield_strain = 0.02\ncreep = 5.0\nmaximum = 0.3"),
    ("hencky", "[plasticity]\nmodel = \"j2\"\nyield_stress = 2e3\nhardening = 5e3"),
];

fn strip((law, model): (&str, &str)) -> Desk {
    Desk::with("strip.toml", STRIP.replace("LAW", law).replace("MODEL", model))
}

#[test]
fn kinetic_stored_and_dissipated_energy_add_up_in_the_files_of_a_run() {
    for model in MODELS {
        let desk = strip(model);
        desk.run_well("strip.toml --headless --energies e.csv --stats s.json --export x.vtu");
        let text = desk.read("e.csv");
        let totals: Vec<f64> =
            text.lines().skip(1).map(|line| line.split(',').nth(3).unwrap().parse().unwrap()).collect();
        let stats = desk.json("s.json");
        let dissipated = stats["dissipated_energy"].as_f64().unwrap();
        let (first, last) = (totals[0], totals[2000]);
        assert!(dissipated > 0.1 * first, "{}: {dissipated} of {first} J", model.0);
        assert!((last + dissipated - first).abs() < 2e-3 * first, "{}: {last} + {dissipated} of {first} J", model.0);
        assert!(stats["largest_plastic_strain"].as_f64().is_some_and(|strain| strain > 0.02), "{stats}");
        assert!(stats["parts"]["plasticity"]["uses"] == 2000, "{stats}");
        assert!(desk.read("x.vtu").contains("Name=\"plastic_strain\""));
    }
}

#[test]
fn the_parts_of_a_scene_name_its_plastic_flow() {
    let explained = strip(MODELS[1]).run_well("strip.toml --headless --explain").stdout;
    assert_names(&explained, &["plasticity", "j2, yields at 2.0000e3 Pa, hardens by 5.0000e3 Pa"]);
    let elastic = strip(("hencky", "")).run_well("strip.toml --headless --explain").stdout;
    assert_names(&elastic, &["the scene has no [plasticity]"]);
}

//! A clamped beam of linear tetrahedra beside Timoshenko's: it comes nearer with every refinement, and locks as ν → ½.

use fem_engine::cantilever::{expected_tip_displacement, tip_displacement};

use approx::assert_relative_eq;
use fem_scene::{Scene, load};
use nalgebra::Vector3;

use crate::shipped_scenes::data;
use crate::{build, run, scene};

/// Timoshenko's displacement of the tip, m, if the scene is a cantilever.
fn expected(scene: &Scene) -> Option<Vector3<f64>> {
    let body = fem_scene::body(scene, &data()).unwrap_or_else(|error| panic!("{error}"));
    expected_tip_displacement(&body, &scene.method())
}

/// A square beam bent by a pressure on its lower side, with so many cubes across.
fn bent(across: usize, pattern: &str) -> String {
    format!(
        r#"pipeline = "engine"
[mesh]
box = {{ size = [10, 1, 1], cells_per_unit = {across}, pattern = "{pattern}" }}
[material]
model = "neo_hookean"
young = 1e6
poisson = 0.4
density = 1000.0
[fixed]
plane = {{ axis = "x", below = 1e-9 }}
[[traction]]
on = {{ axis = "y", side = "min", within = 1e-9 }}
pressure = 20.0
[time]
integrator = "static"
steps = 1
[newton]
tolerance = 1e-13
"#
    )
}

#[test]
fn a_beam_of_alternating_cubes_bends_as_its_mirror_image_does_and_one_of_kuhn_s_drifts_sideways() {
    let sideways = |pattern: &str| {
        let mut simulation = build(&bent(2, pattern));
        run(&mut *simulation, 1);
        let mesh = simulation.shape().mesh.clone();
        let (X, q) = (mesh.vertices(), simulation.positions());
        let u = |node: usize| q.fixed_rows::<3>(3 * node) - X[node];
        let mirrored = |node: usize| {
            let image = Vector3::new(X[node].x, X[node].y, 1.0 - X[node].z);
            X.iter().position(|x| (x - image).amax() < 1e-9).unwrap()
        };
        let largest = (0..X.len()).map(|node| u(node).norm()).fold(0.0, f64::max);
        let difference = |node: usize| {
            let v = u(mirrored(node));
            (u(node) - Vector3::new(v.x, v.y, -v.z)).amax() / largest
        };
        let tip = tip_displacement(&*simulation);
        assert!(tip.y > 0.1, "{tip}");
        ((0..X.len()).map(difference).fold(0.0, f64::max), (tip.z / tip.y).abs())
    };
    let (asymmetry, drift) = sideways("alternating");
    assert!(asymmetry < 1e-12 && drift < 1e-12, "{asymmetry:e} {drift:e}");
    let (_, drift) = sideways("kuhn");
    assert!((0.1..0.4).contains(&drift), "{drift}");
}

/// Part of Timoshenko's deflection that a beam of 1 × 1 m has under a load at its end.
fn part_of_the_theory(length: usize, cells_per_metre: usize, poisson: f64, pattern: &str) -> f64 {
    let text = format!(
        r#"pipeline = "engine"
[mesh]
box = {{ size = [{length}, 1, 1], cells_per_unit = {cells_per_metre}, pattern = "{pattern}" }}
[material]
model = "linear"
young = 1e6
poisson = {poisson}
density = 1000.0
[fixed]
plane = {{ axis = "x", below = 1e-9 }}
[[traction]]
on = {{ axis = "x", side = "max", within = 1e-9 }}
force_per_area = [0, 0, -50]
[time]
dt = 1
integrator = "static"
"#
    );
    let expected = expected(&scene(&text)).unwrap();
    let mut simulation = build(&text);
    run(&mut *simulation, 1);
    tip_displacement(&*simulation).dot(&expected) / expected.norm_squared()
}

#[test]
fn a_cantilever_comes_nearer_to_timoshenko_s_deflection_with_every_refinement() {
    let parts = [2, 4, 6].map(|cells| part_of_the_theory(8, cells, 0.3, "alternating"));
    assert!(parts[0] < parts[1] && parts[1] < parts[2] && parts[2] < 1.0, "{parts:?}");
    // What is missing shrinks with h², as far as meshes this coarse tell.
    let order = ((1.0 - parts[1]) / (1.0 - parts[2])).ln() / 1.5f64.ln();
    assert!((1.5..2.2).contains(&order) && parts[2] > 0.8, "order {order}: {parts:?}");
}

#[test]
fn near_incompressibility_kuhn_s_cells_lock_and_refinement_hardly_helps_but_alternating_ones_lock_less() {
    for (length, least, most) in [(4, 0.055, 0.07), (8, 0.015, 0.03)] {
        let parts = [2, 4, 6].map(|cells| part_of_the_theory(length, cells, 0.4999, "kuhn"));
        assert!(parts.iter().all(|part| (least..most).contains(part)), "{length} m: {parts:?}");
        let parts = [2, 4, 6].map(|cells| part_of_the_theory(length, cells, 0.4999, "alternating"));
        assert!(parts[0] > 0.4 && parts[2] > 0.8 && parts[2] < 1.0, "{length} m: {parts:?}");
    }
}

#[test]
fn at_as_many_elements_alternating_cells_come_nearer_to_timoshenko_than_kuhn_s() {
    for cells in [2, 4] {
        let [kuhn, alternating] = ["kuhn", "alternating"].map(|pattern| part_of_the_theory(8, cells, 0.3, pattern));
        println!("{cells}: {kuhn} {alternating}");
        assert!(kuhn + 0.05 < alternating && alternating < 1.0, "{cells}: {kuhn} and {alternating}");
    }
}

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
    let tip = expected(&load("cantilever", &data()).unwrap()).unwrap();
    assert_relative_eq!(tip.z, -(0.1024 + 0.001224), max_relative = 1e-9);
    assert_eq!((tip.x, tip.y), (0.0, 0.0));
}

#[test]
fn a_beam_under_its_weight_takes_its_moduli_from_c_and_d() {
    // E = 18 C D/(3 D + C) = 1.125e6, ν = 0.40625; w = 2000 N/m, I = 1·2³/12
    let tip = expected(&scene(BEAM)).unwrap();
    let (E, nu): (f64, f64) = (1.125e6, 0.40625);
    let bending = 2000.0 * 8f64.powi(4) / (8.0 * E * 8.0 / 12.0);
    let kappa = 10.0 * (1.0 + nu) / (12.0 + 11.0 * nu);
    let shear = 2000.0 * 64.0 / (2.0 * kappa * E / (2.0 * (1.0 + nu)) * 2.0);
    assert_relative_eq!(tip.z, -(bending + shear), max_relative = 1e-12);
}

#[test]
fn the_weight_and_a_body_force_of_the_same_size_against_it_leave_the_beam_straight() {
    let tip = expected(&scene(&format!("{BEAM}[body_force]\ndensity = [0, 0, 1000]\n"))).unwrap();
    assert_eq!(tip.norm(), 0.0);
}

#[test]
fn other_scenes_are_not_cantilevers() {
    let assert_is_none = |text: &str| assert_eq!(expected(&scene(text)), None, "{text}");
    assert_is_none(&BEAM.replace("\"static\"", "\"implicit_euler\""));
    assert_is_none(&BEAM.replace("axis = \"x\"", "axis = \"y\""));
    assert_is_none(&BEAM.replace("below = 0", "below = 1"));
    assert_is_none(&BEAM.replace("[0, 0, -1]", "[1, 0, -1]"));
    let on = |side: &str| format!("[[traction]]\non = {{ axis = \"x\", side = \"{side}\", within = 0 }}\n");
    assert_is_none(&format!("{BEAM}{}pressure = 1\n", on("max")));
    assert_is_none(&format!("{BEAM}{}force_per_area = [0, 1, 0]\n", on("min")));
    assert_is_none(&format!("{BEAM}[[springs]]\nnodes = [0, 1]\nstiffness = 1\n"));
    for name in ["beam", "bar", "twist", "arma"] {
        assert_eq!(expected(&load(name, &data()).unwrap()), None, "{name}");
    }
}

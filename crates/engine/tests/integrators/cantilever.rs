//! A clamped beam of linear tetrahedra beside Timoshenko's: it comes nearer with every refinement, and locks as ν → ½.

use fem_scene::cantilever::{expected_tip_displacement, tip_displacement};

use crate::{build, run, scene};

/// Part of Timoshenko's deflection that a beam of 1 × 1 m has under a load at its end.
fn part_of_the_theory(length: usize, cells_per_metre: usize, poisson: f64) -> f64 {
    let text = format!(
        r#"pipeline = "engine"
[mesh]
box = {{ size = [{length}, 1, 1], cells_per_unit = {cells_per_metre} }}
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
    let expected = expected_tip_displacement(&scene(&text)).unwrap();
    let mut simulation = build(&text);
    run(&mut *simulation, 1);
    tip_displacement(&*simulation).dot(&expected) / expected.norm_squared()
}

#[test]
fn a_cantilever_comes_nearer_to_timoshenko_s_deflection_with_every_refinement() {
    let parts = [2, 4, 6].map(|cells| part_of_the_theory(8, cells, 0.3));
    assert!(parts[0] < parts[1] && parts[1] < parts[2] && parts[2] < 1.0, "{parts:?}");
    // What is missing shrinks with h², as far as meshes this coarse tell.
    let order = ((1.0 - parts[1]) / (1.0 - parts[2])).ln() / 1.5f64.ln();
    assert!((1.5..2.2).contains(&order) && parts[2] > 0.8, "order {order}: {parts:?}");
}

#[test]
fn near_incompressibility_it_locks_and_refinement_hardly_helps() {
    for (length, least, most) in [(4, 0.055, 0.07), (8, 0.015, 0.03)] {
        let parts = [2, 4, 6].map(|cells| part_of_the_theory(length, cells, 0.4999));
        assert!(parts.iter().all(|part| (least..most).contains(part)), "{length} m: {parts:?}");
    }
}

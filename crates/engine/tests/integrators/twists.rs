//! Thick coarse rods of a law that no element may be turned inside out of, twisted faster than they can follow.

use fem_model::simulation::{Cause, Simulation};

use crate::build;

/// A neo-Hookean rod, clamped at x = 0, whose other end is turned four times within `over` seconds.
fn rod(size: [usize; 3], cells_per_metre: usize, over: f64, dt: f64) -> Box<dyn Simulation> {
    let [length, width, _] = size;
    let middle = width as f64 / 2.0;
    build(&format!(
        r#"pipeline = "engine"
[mesh]
box = {{ size = {size:?}, cells_per_unit = {cells_per_metre} }}
[material]
model = "neo_hookean"
young = 1e5
poisson = 0.4
density = 1000.0
[damping]
beta = 0.002
[fixed]
plane = {{ axis = "x", below = 1e-9 }}
[[prescribed]]
on = {{ axis = "x", side = "max", within = 1e-9 }}
rotation = {{ axis = "x", center = [{length}, {middle}, {middle}], turns = 4 }}
over = {over}
[time]
dt = {dt}
integrator = "implicit_euler"
"#
    ))
}

#[test]
fn rods_are_twisted_by_72_degrees_a_step_and_stay_in_one_piece() {
    for (size, cells) in [([4, 1, 1], 1), ([4, 1, 1], 2), ([2, 1, 1], 3), ([2, 2, 2], 2)] {
        let mut simulation = rod(size, cells, 1.0, 0.05);
        for step in 1..=24 {
            simulation.step().unwrap_or_else(|failure| panic!("{size:?}, {cells} cells: {failure}"));
            let (J, element) = simulation.min_J();
            assert!(J > 0.0, "{size:?}, {cells} cells, step {step}: element {element} has J = {J}");
        }
        assert_eq!(simulation.counters().unconverged_steps, 0, "{size:?}, {cells} cells");
    }
}

#[test]
fn a_twist_that_the_mesh_cannot_take_ends_at_its_limit_with_the_element_that_says_so() {
    // Two layers of elements: where either is turned by half a turn, its elements are flat.
    let mut simulation = rod([2, 1, 1], 1, 4.0, 0.01);
    let failure = (0..400).find_map(|_| simulation.step().err()).unwrap();
    assert!(matches!(failure.cause, Cause::Inverted { .. }), "{failure}");
    // One turn a second.
    let turns = simulation.time();
    assert!((0.5..=1.0).contains(&turns), "after {turns} turns: {failure}");
    assert!(simulation.min_J().0 > 0.0, "the last good state stays");
}

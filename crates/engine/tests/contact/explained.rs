//! A scene without planes has no costs for contact, and the plan of a scene with planes lists its parts.

use fem_model::simulation::{Diagnostics, Interactive, Part, Simulation};

use crate::{CUBE, build, floor, gravity, run, text};

fn part(method: &str, tables: &str, name: &str) -> Part {
    let mut simulation = build(&text(CUBE, "neo_hookean", 1e5, method, 1e-3, &(gravity(0.0, -9.81) + tables)));
    run(&mut simulation, 3);
    simulation.parts().into_iter().find(|part| part.name == name).unwrap()
}

#[test]
fn contact_and_friction_are_parts_where_the_scene_has_planes_and_cost_nothing_where_it_has_none() {
    for method in ["verlet", "rk4", "implicit_euler"] {
        for name in ["contact", "friction"] {
            let without = part(method, "", name);
            assert!(!without.built && (without.bytes, without.uses, without.seconds) == (0, 0, 0.0), "{without:?}");
            assert!(without.why.contains("[[planes]]"), "{without:?}");
        }
        let contact = part(method, &floor(0.0, ""), "contact");
        assert!(contact.built && contact.bytes > 0 && contact.uses > 0, "{contact:?}");
        assert!(!part(method, &floor(0.0, ""), "friction").built, "{method}");
        assert!(part(method, &floor(0.0, "friction = 0.1"), "friction").built, "{method}");
    }
    let contact = part("implicit_euler", &floor(0.0, ""), "contact");
    assert!(contact.why.contains("Pa below 1.000e-3 m"), "{contact:?}");
}

#[test]
fn statistics_of_a_scene_without_planes_name_no_contact() {
    let simulation = build(&text(CUBE, "neo_hookean", 1e5, "implicit_euler", 1e-3, ""));
    assert!(simulation.contacts().is_empty() && simulation.contact_forces().is_none());
    assert_eq!(simulation.lag_residual(), None);
    let rough = build(&text(CUBE, "neo_hookean", 1e5, "implicit_euler", 1e-3, &floor(-1.0, "friction = 1")));
    assert_eq!(rough.lag_residual(), Some(0.0));
}

#[test]
fn a_running_simulation_switches_between_methods_that_keep_the_body_outside() {
    let mut simulation = build(&text(CUBE, "neo_hookean", 1e5, "verlet", 1e-4, &floor(-1.0, "")));
    let names: Vec<_> = (0..5).map(|_| simulation.next_integrator()).collect();
    assert_eq!(names, ["explicit_euler", "semi_implicit_euler", "rk2", "rk4", "verlet"]);
    let mut simulation = build(&text(CUBE, "neo_hookean", 1e5, "implicit_euler", 1e-4, &floor(-1.0, "")));
    let names: Vec<_> = (0..5).map(|_| simulation.next_integrator()).collect();
    assert_eq!(names, ["implicit_midpoint", "newmark", "generalized_alpha", "bdf2", "implicit_euler"]);
}

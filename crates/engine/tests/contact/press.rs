//! Moving planes: a press between two plates.

use fem_model::simulation::{Diagnostics, Simulation};

use crate::{CUBE, build, dissipative, is_implicit, run, text};

/// A cube between two plates, of which the upper one sinks by 0.2 m in 0.4 s.
fn press(method: &str, dt: f64) -> String {
    let tables = "[[planes]]\npoint = [0, -1.1e-3, 0]\nnormal = [0, 1, 0]\nfriction = 0.3\n\
                  [[planes]]\npoint = [0, 1.0011, 0]\nnormal = [0, -1, 0]\nfriction = 0.3\nvelocity = [0, -0.5, 0]\nuntil = 0.4\n\
                  [damping]\nalpha = 2\nbeta = 2e-3\n";
    text(CUBE, "neo_hookean", 1e5, method, dt, tables)
}

#[test]
fn a_press_squashes_a_body_to_its_gap_and_both_plates_push_alike() {
    let mut forces = Vec::new();
    for method in dissipative() {
        // Explicit Euler takes longer to come to rest: it feeds the vibrations that damping ends.
        let (dt, steps) = if is_implicit(method) { (0.02, 100) } else { (5e-4, 6000) };
        let mut simulation = build(&press(method, dt));
        for _ in 0..steps {
            run(&mut simulation, 1);
            let contacts = simulation.contacts();
            assert!(contacts.iter().all(|contact| contact.smallest_gap > 0.0), "{method}: {contacts:?}");
        }
        let contacts = simulation.contacts();
        let (below, above) = (contacts[0].force, contacts[1].force);
        assert!((below[1] + above[1]).abs() < 5e-3 * below[1], "{method}: {contacts:?}");
        let planes = simulation.planes();
        assert!((planes[1].point.y - 0.8011).abs() < 1e-12 && planes[0].point.y == -1.1e-3, "{method}: {planes:?}");
        // Against 1e5 Pa · 0.2 · 1 m², beyond Hooke and with friction at the plates.
        assert!(below[1] > 2e4 && below[1] < 4e4, "{method}: {contacts:?}");
        forces.push(below[1]);
    }
    let (least, most) = forces.iter().fold((f64::INFINITY, 0.0), |(a, b): (f64, f64), &x| (a.min(x), b.max(x)));
    assert!(most < 1.03 * least, "{forces:?}");
}

#[test]
fn a_plate_that_rises_again_releases_an_elastic_body_which_takes_its_shape_again() {
    let curve = "displacement = [0, -0.2, 0]\ncurve = { table = [[0, 0], [0.4, 1], [0.5, 1], [0.9, -0.05]] }\n";
    for method in ["verlet", "implicit_euler"] {
        let (dt, per_second) = if is_implicit(method) { (0.02, 50) } else { (5e-4, 2000) };
        let mut simulation = build(&press(method, dt).replace("velocity = [0, -0.5, 0]\nuntil = 0.4\n", curve));
        run(&mut simulation, per_second / 2);
        let squashed = simulation.contacts()[1].force[1];
        assert!(squashed < -1e4, "{method}: {squashed} N");
        run(&mut simulation, 3 * per_second);
        let (contacts, J) = (simulation.contacts(), simulation.min_J().0);
        assert!(contacts.iter().all(|contact| contact.force[1].abs() < 1e-3 * -squashed), "{method}: {contacts:?}");
        assert!((J - 1.0).abs() < 1e-3, "{method}: {J}");
    }
}

#[test]
fn a_plate_that_meets_a_fixed_node_ends_the_run_with_its_name() {
    for method in ["verlet", "implicit_euler"] {
        let top = "[fixed]\non = { axis = \"y\", side = \"max\", within = 1e-9 }\n";
        let mut simulation = build(&(press(method, 1e-3) + top));
        let failure = (0..100).find_map(|_| simulation.step().err()).expect("the plate stops");
        let text = failure.to_string();
        assert!(text.contains("planes[1]") && text.contains("constrained"), "{method}: {text}");
    }
}

#[test]
fn a_block_pressed_in_one_load_step_is_in_balance_or_its_step_is_not_converged() {
    let top = "[[prescribed]]\non = { axis = \"y\", side = \"max\", within = 1e-9 }\ndisplacement = [0, -0.01, 0]\n";
    for distance in [1e-3, 1e-5, 1e-6] {
        let plane = format!(
            "[[planes]]\npoint = [0, -2e-3, 0]\nnormal = [0, 1, 0]\n[contact]\nactivation_distance = {distance:e}\n"
        );
        let tables = format!("{top}{plane}[static]\nload_steps = 1\n");
        let mut simulation = build(&text(CUBE, "linear", 1e5, "static", 1.0, &tables));
        run(&mut simulation, 1);
        let (below, above) = (simulation.contacts()[0].force[1], simulation.reactions()[0].force[1]);
        let is_converged = simulation.counters().unconverged_steps == 0;
        // 1e-10 m, the tolerance of Newton's method, is a ten-thousandth of the thinnest layer.
        let is_balanced = (below + above).abs() < 1e-3 * below;
        assert!(below > 100.0 && (is_balanced || !is_converged), "{distance:e}: {below} N and {above} N");
    }
}

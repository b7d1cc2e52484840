//! Steps whose iterations end far from their solution are counted as not converged, and no others.

use crate::{build, run};

const METHODS: [&str; 3] = ["xpbd", "vbd", "projective_dynamics"];

/// A clamped block of 2 m under its weight.
fn block(integrator: &str, young: &str, rest: &str) -> String {
    format!(
        "pipeline = \"engine\"\n[mesh]\nbox = {{ size = [2, 1, 1], cells_per_unit = 2 }}\n[material]\nmodel = \"stable_neo_hookean\"\n\
         young = {young}\npoisson = 0.3\ndensity = 1000\n[mass]\nlumped = true\n[gravity]\nacceleration = [0, 0, -9.81]\n[fixed]\n\
         plane = {{ axis = \"x\", below = 1e-9 }}\n[time]\ndt = 0.01\nintegrator = \"{integrator}\"\n{rest}"
    )
}

/// Steps that have not converged, of ten.
fn unconverged(scene: &str) -> usize {
    let mut simulation = build(scene);
    run(&mut *simulation, 10);
    simulation.counters().unconverged_steps
}

#[test]
fn a_sweep_over_a_stiff_body_stores_more_energy_than_its_weight_can_give() {
    for method in METHODS {
        let stiff = unconverged(&block(method, "1e12", "[iterations]\ncount = 1\n"));
        // The matrix of projective dynamics contains the stiffness of the body, so that one round is a good step.
        assert_eq!(stiff > 5, method != "projective_dynamics", "{method}: {stiff} of 10 steps");
        let soft = unconverged(&block(method, "1e6", "[iterations]\ncount = 50\n"));
        assert_eq!(soft, 0, "{method}");
    }
}

#[test]
fn a_tolerance_that_is_missed_within_the_count_is_a_step_that_has_not_converged() {
    for method in ["pbd", "xpbd", "vbd", "projective_dynamics"] {
        let of = |count: usize, tolerance: &str| {
            let text = format!("[iterations]\ncount = {count}\ntolerance = {tolerance}\n");
            unconverged(&block(method, "1e5", &text))
        };
        assert_eq!(of(2, "1e-12"), 10, "{method}");
        // The volume and the edges of an element cannot satisfy all constraints of PBD.
        assert!(method == "pbd" || of(5000, "1e-4") == 0, "{method}");
    }
}

#[test]
fn the_work_of_a_prescribed_motion_is_an_energy_that_a_body_may_have() {
    let motion = "[[prescribed]]\nbox = { min = [1.99, -1, -1], max = [3, 2, 2] }\nvelocity = [2, 0, 0]\n";
    for method in METHODS {
        let text = format!("[iterations]\ncount = 200\n{motion}");
        assert_eq!(unconverged(&block(method, "1e6", &text)), 0, "{method}");
    }
}

#[test]
fn a_plane_that_presses_a_body_does_work_on_it() {
    let plane = "[[planes]]\npoint = [2.0, 0.0, 0.0]\nnormal = [-1.0, 0.0, 0.0]\nvelocity = [-1.0, 0.0, 0.0]\n";
    for method in ["xpbd", "vbd"] {
        let text = format!("[iterations]\ncount = 200\n{plane}");
        assert_eq!(unconverged(&block(method, "1e6", &text)), 0, "{method}");
    }
}

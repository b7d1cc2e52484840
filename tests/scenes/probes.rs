//! Probes: position, velocity and force of a node in every step.

use crate::program::{Desk, assert_names, numbers};
use crate::resumed::engine_cube;
use crate::scene_text::{CUBE, edit, without};

/// The rows of a probe's table.
fn rows(desk: &Desk, file: &str) -> Vec<Vec<f64>> {
    let text = desk.read(file);
    let mut lines = text.lines();
    assert_eq!(lines.next(), Some("time,x,y,z,vx,vy,vz,fx,fy,fz"));
    lines.map(|line| line.split(',').map(|number| number.parse().unwrap()).collect()).collect()
}

#[test]
fn a_probe_has_a_row_for_the_initial_state_and_each_step_and_ends_in_the_final_state() {
    for scene in [CUBE.to_owned(), engine_cube()] {
        let desk = Desk::with("cube.toml", scene);
        desk.run_well("cube.toml --headless --probe 13=p.csv --probe highest=top.csv --state q.json");
        let found = rows(&desk, "p.csv");
        assert_eq!(found.len(), 5);
        assert_eq!(found[0][..7], [0.0, 0.5, 0.5, 0.5, 0.0, 0.0, 0.0]);
        let state = desk.json("q.json");
        assert_eq!(found[4][1..4], numbers(&state["q"])[39..42]);
        assert_eq!(found[4][4..7], numbers(&state["qdot"])[39..42]);
        // The first node of largest y is the first corner of that side.
        assert_eq!(rows(&desk, "top.csv")[0][1..4], [0.0, 1.0, 0.0]);
    }
}

#[test]
fn the_force_on_a_free_node_accelerates_it() {
    // One lumped node of a free cube: m (v⁺ − v)/dt = f(t) by semi-implicit Euler.
    let scene = without(&without(&engine_cube(), "fixed"), "drag");
    let scene = edit(&scene, "\"implicit_euler\"", "\"semi_implicit_euler\"") + "[mass]\nlumped = true\n";
    let desk = Desk::with("cube.toml", scene);
    desk.run_well("cube.toml --headless --dt 1e-3 --probe 13=p.csv");
    // The middle node of 2³ cells has the mass of 24 elements' quarters: one cell.
    for pair in rows(&desk, "p.csv").windows(2) {
        for i in 0..3 {
            let acceleration = (pair[1][4 + i] - pair[0][4 + i]) / 1e-3;
            assert!((125.0 * acceleration - pair[0][7 + i]).abs() < 1e-6, "{pair:?}");
        }
    }
}

#[test]
fn the_force_on_constrained_nodes_is_minus_their_reaction_in_equilibrium() {
    let scene = edit(&without(&engine_cube(), "drag"), "\"implicit_euler\"", "\"static\"");
    let desk = Desk::with("cube.toml", scene);
    let fixed: Vec<usize> = (0..27).filter(|node| node / 3 % 3 == 0).collect();
    let probes: String = fixed.iter().map(|node| format!(" --probe {node}={node}.csv")).collect();
    desk.run_well(&format!("cube.toml --headless --steps 1 --stats s.json {probes}"));
    let reaction = numbers(&desk.json("s.json")["reactions"]["fixed"]);
    for i in 0..3 {
        let force: f64 = fixed.iter().map(|node| rows(&desk, &format!("{node}.csv"))[1][7 + i]).sum();
        assert!((force + reaction[i]).abs() < 1e-6 * 9810.0, "{force} and {}", reaction[i]);
    }
    assert!((reaction[1] - 9810.0).abs() < 1e-3, "{reaction:?}");
}

#[test]
fn a_probe_that_makes_no_sense_is_refused() {
    let desk = Desk::with("cube.toml", CUBE);
    for (probe, parts) in [
        ("13", ["--probe", "NODE=FILE.csv"]),
        ("=a.csv", ["--probe", "NODE=FILE.csv"]),
        ("27=a.csv", ["the mesh has 27 nodes", "give a node from 0 to 26"]),
        ("tip=a.csv", ["there is no node `tip`", "highest"]),
        ("1=nowhere/a.csv", ["--probe nowhere/a.csv", "its folder does not exist"]),
    ] {
        assert_names(&desk.refused(&format!("cube.toml --headless --probe {probe}")), &parts);
    }
    assert_names(&desk.refused("cube.toml --probe 1=a.csv --probe 2=a.csv"), &["same file a.csv"]);
}

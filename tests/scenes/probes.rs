//! Probes: position, velocity and force of a node in every step.

use crate::program::{Desk, assert_names, numbers};
use crate::resumed::engine_cube;
use crate::scene_text::{CUBE, edit, without};

/// The rows of a probe's table.
fn rows(desk: &Desk, file: &str) -> Vec<Vec<f64>> {
    let text = desk.read(file);
    let mut lines = text.lines();
    let columns = lines.next().unwrap();
    assert_eq!(columns.strip_suffix(",load_factor").unwrap_or(columns), "time,x,y,z,vx,vy,vz,fx,fy,fz");
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
    // The middle node of 2³ cells has a quarter of each of the 48 elements.
    for pair in rows(&desk, "p.csv").windows(2) {
        for i in 0..3 {
            let acceleration = (pair[1][4 + i] - pair[0][4 + i]) / 1e-3;
            assert!((250.0 * acceleration - pair[0][7 + i]).abs() < 1e-6, "{pair:?}");
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
    for (i, reaction) in reaction.iter().enumerate() {
        let force: f64 = fixed.iter().map(|node| rows(&desk, &format!("{node}.csv"))[1][7 + i]).sum();
        assert!((force + reaction).abs() < 1e-6 * 9810.0, "{force} and {reaction}");
    }
    assert!((reaction[1] - 9810.0).abs() < 1e-3, "{reaction:?}");
}

/// Two tetrahedra on a floor of three nodes, in Gmsh's format 2.2.
const MESH: &str = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n2 3 \"floor\"\n3 4 \"all\"\n$EndPhysicalNames\n\
    $Nodes\n5\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n5 1 1 1\n$EndNodes\n\
    $Elements\n3\n1 2 2 3 1 1 3 2\n2 4 2 4 1 1 2 3 4\n3 4 2 4 2 2 3 4 5\n$EndElements\n";

#[test]
fn a_probe_of_a_set_gives_the_mean_of_its_positions_and_the_sum_of_its_forces() {
    let scene = edit(&without(CUBE, "drag"), "box = { size = [1, 1, 1], cells_per_unit = 2 }", "file = \"a.msh\"");
    let desk = Desk::with("cube.toml", without(&scene, "fixed"));
    desk.write("a.msh", MESH);
    let each: String = (0..3).map(|node| format!("--probe {node}={node}.csv ")).collect();
    desk.run_well(&format!("cube.toml --headless --probe floor=p.csv {each}"));
    let nodes = ["0.csv", "1.csv", "2.csv"].map(|file| rows(&desk, file));
    for (step, row) in rows(&desk, "p.csv").iter().enumerate() {
        for column in 1..10 {
            let sum: f64 = nodes.iter().map(|rows| rows[step][column]).sum();
            let expected = if column < 7 { sum / 3.0 } else { sum };
            assert!((row[column] - expected).abs() <= 1e-12 * expected.abs().max(1.0), "{row:?}");
        }
    }
    assert_names(&desk.refused("cube.toml --probe side=p.csv"), &["highest, or all, or floor"]);
}

#[test]
fn a_probe_that_makes_no_sense_is_refused() {
    let desk = Desk::with("cube.toml", CUBE);
    for (probe, parts) in [
        ("13", ["--probe", "NODE|NAME=FILE.csv"]),
        ("=a.csv", ["--probe", "NODE|NAME=FILE.csv"]),
        ("27=a.csv", ["the mesh has 27 nodes", "give a node from 0 to 26"]),
        ("tip=a.csv", ["there is no such node or set", "highest"]),
        ("1=nowhere/a.csv", ["--probe nowhere/a.csv", "its folder does not exist"]),
    ] {
        assert_names(&desk.refused(&format!("cube.toml --headless --probe {probe}")), &parts);
    }
    assert_names(&desk.refused("cube.toml --probe 1=a.csv --probe 2=a.csv"), &["same file a.csv"]);
}

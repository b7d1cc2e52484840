//! `[[initial_velocity]]`: the velocity of each node, and its errors at their lines.

use nalgebra::Vector3;

use crate::errors::assert_refused;
use crate::{LEAST, body, edit};

fn scene(lines: &str) -> String {
    format!("{LEAST}[[initial_velocity]]\n{lines}\n")
}

fn velocities(lines: &str) -> Vec<Vector3<f64>> {
    body(&scene(lines)).unwrap_or_else(|error| panic!("{error}")).initial_velocity
}

#[test]
fn a_body_without_the_table_starts_at_rest() {
    assert!(body(LEAST).unwrap().initial_velocity.is_empty());
}

#[test]
fn a_velocity_holds_for_all_nodes_or_for_those_listed() {
    assert_eq!(velocities("velocity = [1, 2, 3]"), vec![Vector3::new(1.0, 2.0, 3.0); 12]);
    let some = velocities("velocity = [1, 2, 3]\nnodes = [3, 5]");
    for (node, v) in some.into_iter().enumerate() {
        let expected = if [3, 5].contains(&node) { Vector3::new(1.0, 2.0, 3.0) } else { Vector3::zeros() };
        assert_eq!(v, expected, "node {node}");
    }
}

#[test]
fn a_rotation_is_about_the_centre_of_mass_unless_a_centre_is_given() {
    // Node 0 is the origin; the body of 2 × 1 × 1 m has its centre at (1, ½, ½).
    let own = velocities("angular = { axis = [0, 0, 5], rate = 2 }");
    assert!((own[0] - Vector3::new(1.0, -2.0, 0.0)).norm() < 1e-14, "{}", own[0]);
    let given = velocities("angular = { axis = [0, 0, 1], center = [0, 0, 0], rate = 2 }");
    assert_eq!((given[0], given[2]), (Vector3::zeros(), Vector3::new(0.0, 4.0, 0.0)));
}

#[test]
fn velocities_of_all_keys_and_of_several_tables_are_added() {
    let spin = "angular = { axis = [0, 0, 1], center = [0, 0, 0], rate = 2 }";
    let sum =
        velocities(&format!("velocity = [1, 0, 0]\n{spin}\n[[initial_velocity]]\nnodes = [2]\nvelocity = [0, 0, 7]"));
    assert_eq!((sum[0], sum[2]), (Vector3::new(1.0, 0.0, 0.0), Vector3::new(1.0, 4.0, 7.0)));
}

#[test]
fn a_file_gives_a_velocity_for_each_node() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("v.csv");
    let of_file = |text: &str| {
        std::fs::write(&file, text).unwrap();
        body(&scene(&format!("per_node = {:?}", file.to_str().unwrap()))).map(|body| body.initial_velocity)
    };
    let lines: String = (0..12).map(|node| format!("{node}, 0.5,-1e-3\n")).collect();
    for text in [lines.clone(), format!("vx,vy,vz\n{lines}\n")] {
        let found = of_file(&text).unwrap();
        assert!((0..12).all(|node| found[node] == Vector3::new(node as f64, 0.5, -1e-3)), "{found:?}");
    }
    let refused = |text: &str, part: &str| {
        let message = of_file(text).unwrap_err().to_string();
        assert!(message.starts_with("folder/name.toml, line ") && message.contains("initial_velocity[0].per_node is "));
        assert!(message.contains(part), "{message}");
    };
    refused("1,2,3\n4,5,6\n", "which has 2 lines; the mesh has 12 nodes, give a line for each");
    refused(&lines.replacen("0.5", "nan", 1), "line 1 has a number that is not finite");
    refused(&lines.replacen("0.5", "fast", 1), "line 1 is no list of numbers; write x,y,z in m/s");
    refused(&lines.replacen(",-1e-3\n3", "\n3", 1), "line 3 has 2 numbers; write x,y,z in m/s");
    std::fs::remove_file(&file).unwrap();
    let message = body(&scene("per_node = \"nowhere.csv\"")).unwrap_err().to_string();
    assert!(message.contains("cannot be read: ") && message.ends_with("; check the path"), "{message}");
}

#[test]
fn an_initial_velocity_is_checked_at_its_line() {
    let refused = |lines: &str, line: usize, beginning: &str| {
        assert_refused(&scene(lines), line, &format!("initial_velocity[0]{beginning}"));
    };
    refused("", 12, " has no velocity; give velocity, angular or per_node");
    refused("velocity = [0, nan, 0]", 13, ".velocity is NaN; give finite numbers");
    refused("angular = { axis = [0, 0, 0], rate = 1 }", 13, ".angular.axis is zero; give the direction");
    refused("angular = { axis = [0, 0, 1], rate = inf }", 13, ".angular.rate is inf; give finite numbers");
    refused("angular = { axis = [0, 0, 1], center = [inf, 0, 0], rate = 1 }", 13, ".angular.center is inf");
    assert_refused(&scene("speed = 1"), 13, "unknown field `speed`");
    let still = edit(&scene("velocity = [1, 0, 0]"), "implicit_euler", "static");
    assert_refused(&still, 12, "initial_velocity[0] is a motion, and static has none; remove it");
    let outside = body(&scene("velocity = [1, 0, 0]\nnodes = [12]")).unwrap_err().to_string();
    assert!(outside.contains("initial_velocity[0].nodes names node 12; the mesh has nodes 0 to 11"), "{outside}");
}

//! A step allocates nothing once the first ones have made room.

use std::path::Path;

use fem_engine::{engine, scene};

const SCENE: &str = r#"
pipeline = "engine"
[mesh]
box = { size = [2, 1, 1], cells_per_unit = 3 }
[material]
model = "neo_hookean"
C = 1e5
D = 4e5
density = 1000.0
[gravity]
acceleration = [0, 0, -9.81]
[fixed]
plane = { axis = "x", below = 1e-9 }
[drag]
vertex = "highest"
stiffness = 1e3
direction = [1, 0, 0]
amplitude = 0.1
frequency = 1.0
[time]
dt = 0.001
integrator = "INTEGRATOR"
"#;

/// Allocations of twenty steps after ten.
fn allocations(integrator: &str, more: &str) -> u64 {
    let text = format!("{}{more}", SCENE.replace("INTEGRATOR", integrator));
    let scene = scene::parse(&text, Path::new("allocations.toml")).unwrap();
    let body = scene::body(&scene, Path::new("../../data")).unwrap();
    let mut simulation = engine::build(&scene, body).unwrap();
    let mut steps = |count: usize| (0..count).for_each(|_| simulation.step().unwrap());
    steps(10);
    allocation_counter::measure(|| steps(20)).count_total
}

#[test]
fn steps_of_all_methods_allocate_nothing() {
    let methods =
        ["explicit_euler", "semi_implicit_euler", "rk2", "rk4", "verlet", "linearly_implicit_euler", "implicit_euler"];
    for integrator in methods {
        assert_eq!(allocations(integrator, ""), 0, "{integrator}");
    }
}

#[test]
fn steps_of_all_solvers_allocate_nothing() {
    for solver in [
        "kind = \"cholesky\"",
        "kind = \"cg\"",
        "kind = \"pcg\"",
        "kind = \"pcg\"\npreconditioner = \"incomplete_cholesky\"",
        "kind = \"pcg\"\npreconditioner = \"ssor\"",
    ] {
        assert_eq!(allocations("implicit_euler", &format!("[solver]\n{solver}\n")), 0, "{solver}");
    }
}

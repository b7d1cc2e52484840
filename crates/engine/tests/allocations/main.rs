//! A step allocates nothing once the first ones have made room, and a part that is left out takes no memory.

use std::path::Path;

use fem_engine::simulator;
use fem_model::simulation::Simulation;

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
    allocations_of(&SCENE.replace("INTEGRATOR", integrator), more)
}

/// The same of another scene, with further tables.
fn allocations_of(scene: &str, more: &str) -> u64 {
    let text = format!("{scene}{more}");
    let scene = fem_scene::parse(&text, Path::new("allocations.toml")).unwrap();
    let body = fem_scene::body(&scene, Path::new("../../data")).unwrap();
    let mut simulation = simulator::build(body, &scene.method()).unwrap();
    let mut steps = |count: usize| (0..count).for_each(|_| simulation.step().unwrap());
    steps(10);
    allocation_counter::measure(|| steps(20)).count_total
}

#[test]
fn steps_of_all_methods_allocate_nothing() {
    let implicit = ["linearly_implicit_euler", "implicit_euler", "implicit_midpoint", "newmark"];
    let methods =
        ["explicit_euler", "semi_implicit_euler", "rk2", "rk4", "verlet", "generalized_alpha", "bdf2", "bathe"];
    for integrator in methods.into_iter().chain(implicit) {
        assert_eq!(allocations(integrator, ""), 0, "{integrator}");
        assert_eq!(allocations(integrator, "[damping]\nalpha = 1\nbeta = 1e-4\n"), 0, "{integrator}, damped");
    }
}

#[test]
fn adaptive_steps_allocate_nothing() {
    for integrator in ["implicit_midpoint", "newmark", "generalized_alpha", "bdf2", "bathe"] {
        let text = SCENE.replace("dt = 0.001", "dt = 0.01\nadaptive = { tolerance = 1e-5 }");
        assert_eq!(allocations_of(&text.replace("INTEGRATOR", integrator), ""), 0, "{integrator}");
    }
}

#[test]
fn steps_of_all_solvers_allocate_nothing() {
    for solver in
        ["kind = \"cholesky\"", "kind = \"cg\"", "kind = \"pcg\"", "kind = \"pcg\"\npreconditioner = \"ssor\""]
    {
        assert_eq!(allocations("implicit_euler", &format!("[solver]\n{solver}\n")), 0, "{solver}");
    }
}

#[test]
fn steps_in_contact_allocate_nothing() {
    let floor = "[[planes]]\npoint = [0, 0, 0]\nnormal = [0, 0, 1]\nfriction = 0.3\n";
    let methods = ["explicit_euler", "semi_implicit_euler", "rk2", "rk4", "verlet", "implicit_euler"];
    for integrator in methods.into_iter().chain(["implicit_midpoint", "newmark", "generalized_alpha", "bdf2"]) {
        assert_eq!(allocations(integrator, floor), 0, "{integrator}");
    }
}

#[test]
fn steps_with_plastic_flow_allocate_nothing() {
    let hencky =
        SCENE.replace("model = \"neo_hookean\"\nC = 1e5\nD = 4e5", "model = \"hencky\"\nyoung = 1e5\npoisson = 0.3");
    let corotated = hencky.replace("hencky", "corotated");
    let models = [
        (hencky, "model = \"j2\"\nyield_stress = 1e3\nhardening = 1e3\n"),
        (corotated, "model = \"additive\"\nyield_strain = 0.005\ncreep = 5.0\n"),
    ];
    for (scene, model) in models {
        for integrator in ["verlet", "linearly_implicit_euler", "implicit_euler"] {
            let more = format!("[plasticity]\n{model}");
            assert_eq!(allocations_of(&scene.replace("INTEGRATOR", integrator), &more), 0, "{integrator}, {model}");
        }
    }
}

#[test]
fn steps_with_fibres_allocate_nothing() {
    for integrator in ["verlet", "linearly_implicit_euler", "implicit_euler", "newmark"] {
        let family = "[[fibres]]\nmodulus = 1e4\nexponent = 0.5\ndirection = [1, 0, 0]\n";
        assert_eq!(allocations(integrator, family), 0, "{integrator}");
    }
}

#[test]
fn steps_of_flat_bodies_allocate_nothing() {
    let flat = SCENE
        .replace("box = { size = [2, 1, 1], cells_per_unit = 3 }", "rectangle = { size = [2, 1], cells_per_unit = 3 }")
        .replace("acceleration = [0, 0, -9.81]", "acceleration = [0, -9.81, 0]");
    for integrator in ["semi_implicit_euler", "implicit_euler"] {
        assert_eq!(allocations_of(&flat.replace("INTEGRATOR", integrator), ""), 0, "{integrator}");
    }
}

/// A simulation, and the bytes that it has taken and kept.
fn built(text: &str) -> (Box<dyn Simulation>, i64) {
    let mut simulation = None;
    let info = allocation_counter::measure(|| {
        let scene = fem_scene::parse(text, Path::new("allocations.toml")).unwrap();
        let body = fem_scene::body(&scene, Path::new("no data")).unwrap();
        simulation = Some(simulator::build(body, &scene.method()).unwrap());
    });
    (simulation.unwrap(), info.bytes_current)
}

/// Bytes of these parts.
fn bytes(simulation: &dyn Simulation, names: &[&str]) -> i64 {
    let parts = simulation.parts().into_iter().filter(|part| names.contains(&part.name));
    parts.map(|part| part.bytes as i64).sum()
}

#[test]
fn leaving_a_part_out_saves_the_memory_that_it_is_said_to_take() {
    let scene = SCENE.replace("INTEGRATOR", "verlet");
    let without = |table: &str| {
        let start = scene.find(&format!("[{table}]")).unwrap();
        let end = scene[start + 1..].find("\n[").map_or(scene.len(), |end| start + 1 + end + 1);
        format!("{}{}", &scene[..start], &scene[end..])
    };
    let surface = "on = { axis = \"z\", side = \"max\", within = 1e-9 }\n";
    let lumped = format!("{scene}[mass]\nlumped = true\n");
    let cases = [
        ("dead_load", scene.clone(), without("gravity")),
        ("drag", scene.clone(), without("drag")),
        ("damping", format!("{scene}[damping]\nalpha = 1\n"), scene.clone()),
        ("springs", format!("{scene}[[springs]]\nnodes = [1, 20]\nstiffness = 1\n"), scene.clone()),
        ("pressure", format!("{scene}[[traction]]\n{surface}pressure = 1\n"), scene.clone()),
        ("contact", format!("{lumped}[[planes]]\npoint = [0, 0, -1]\nnormal = [0, 0, 1]\n"), lumped.clone()),
    ];
    for (name, with, without) in cases {
        let ((with, most), (without, least)) = (built(&with), built(&without));
        let told = bytes(&*with, &[name]);
        assert_eq!(bytes(&*without, &[name]), 0, "{name}");
        assert!(most - least >= told, "{name}: {told} bytes told, {most} with it and {least} without");
    }
}

#[test]
fn an_explicit_scene_has_no_memory_for_matrix_and_factor() {
    let ((explicit, least), (implicit, most)) =
        (built(&SCENE.replace("INTEGRATOR", "verlet")), built(&SCENE.replace("INTEGRATOR", "implicit_euler")));
    let of_matrices = ["stiffness", "solver"];
    assert_eq!(bytes(&*explicit, &of_matrices), 0);
    // The places in the matrix that elements add to belong to the mesh.
    let places = bytes(&*implicit, &["mesh"]) - bytes(&*explicit, &["mesh"]);
    assert!(places >= 16 * 4 * 324, "{places} bytes for the pairs of nodes of 324 tetrahedra");
    let told = places + bytes(&*implicit, &of_matrices);
    assert!(told > 50_000 && most - least >= told, "{told} bytes told, {most} with them and {least} without");
}

//! Every table and key of the scene format, as its description writes them.

use std::path::PathBuf;

use fem_mesh::Pattern;
use fem_model::{Axis, Integrator, SolverKind};
use fem_scene::Pipeline;
use fem_scene::tables::{Cuboid, DragTable, DragVertex, MassTable, NewtonTable, Plane, SolverTable};

use crate::{LEAST, edit, read};

const ALL: &str = r#"about = "one line"
pipeline = "engine"                     # "course": the 22 functions run it; "engine": the fast engine does
[mesh]                                  # exactly one source
box = { size = [4, 1, 1], cells_per_unit = 6, pattern = "kuhn" }    # "alternating" if left out
display = "meshes/x.obj"                # optional
scale = 0.5                             # optional; both meshes, about the origin
[material]
model = "neo_hookean"                   # linear | corotated | st_venant_kirchhoff | neo_hookean | stable_neo_hookean
C = 2e5                                 # either C and D (neo_hookean only), or young and poisson
D = 1e6
density = 1000.0
[mass]
lumped = true
[gravity]                               # optional, like every table below
acceleration = [0, 0, -9.81]
[fixed]
plane = { axis = "x", below = 1e-9 }
[time]
dt = 0.01
integrator = "implicit_euler"
steps = 50
[newton]                                # [newton] and [solver]: engine pipeline only
max_iterations = 50
tolerance = 1e-10                       # relative, on the velocity update
[solver]
kind = "cholesky"                       # cholesky | lu | cg | pcg
tolerance = 1e-12                       # iterative solvers: relative residual
[drag]                                  # a scripted pull, so that a scene moves without a mouse
vertex = "highest"                      # the first vertex of largest y, or an index
stiffness = 1e5                         # N/m, zero rest length, in the force and in the stiffness
direction = [1, 0, 0]
amplitude = 0.2
frequency = 1.0                         # Hz
"#;

#[test]
fn every_table_of_a_scene_is_read() {
    let scene = read(ALL);
    assert_eq!((scene.name.as_str(), scene.path), ("name", PathBuf::from("folder/name.toml")));
    assert_eq!((scene.about.as_str(), scene.pipeline), ("one line", Pipeline::Engine));
    assert_eq!(scene.mesh.cuboid, Some(Cuboid { size: [4.0, 1.0, 1.0], cells_per_unit: 6, pattern: Pattern::Kuhn }));
    assert_eq!((scene.mesh.file, scene.mesh.display, scene.mesh.scale), (None, Some("meshes/x.obj".into()), 0.5));
    let material = scene.material;
    assert_eq!((material.model.as_str(), material.C, material.D), ("neo_hookean", Some(2e5), Some(1e6)));
    assert_eq!((material.young, material.poisson, material.density), (None, None, 1000.0));
    assert_eq!(scene.mass, MassTable { lumped: Some(true) });
    assert_eq!(scene.gravity.unwrap().acceleration, [0.0, 0.0, -9.81]);
    let fixed = scene.fixed.unwrap();
    assert_eq!((fixed.plane, fixed.nodes), (Some(Plane { axis: Axis::X, below: 1e-9 }), None));
    assert_eq!(
        (scene.time.dt, scene.time.integrator, scene.time.steps),
        (Some(0.01), Integrator::ImplicitEuler, Some(50))
    );
    assert_eq!(
        scene.newton,
        Some(NewtonTable {
            max_iterations: Some(50),
            tolerance: Some(1e-10),
            projection: None,
            accept_unconverged: false
        })
    );
    assert_eq!(
        scene.solver,
        Some(SolverTable { kind: SolverKind::Cholesky, tolerance: Some(1e-12), preconditioner: None, precision: None })
    );
    let drag = DragTable {
        vertex: DragVertex::Highest,
        stiffness: 1e5,
        direction: [1.0, 0.0, 0.0],
        amplitude: 0.2,
        frequency: 1.0,
        in_stiffness: None,
    };
    assert_eq!(scene.drag, Some(drag));
}

#[test]
fn tables_that_a_scene_leaves_out_are_absent() {
    let scene = read(LEAST);
    assert_eq!((scene.about.as_str(), scene.mesh.scale, scene.mass.lumped), ("", 1.0, None));
    assert_eq!((scene.mesh.file, scene.mesh.display), (None, None));
    assert!(scene.gravity.is_none() && scene.fixed.is_none() && scene.drag.is_none());
    assert!(scene.newton.is_none() && scene.solver.is_none() && scene.time.steps.is_none());
}

#[test]
fn every_name_of_the_format_is_known() {
    let names = [
        "explicit_euler",
        "semi_implicit_euler",
        "rk2",
        "rk4",
        "verlet",
        "linearly_implicit_euler",
        "implicit_euler",
        "implicit_midpoint",
        "newmark",
        "generalized_alpha",
        "bdf2",
        "bathe",
        "pbd",
        "xpbd",
        "vbd",
        "projective_dynamics",
        "static",
    ];
    for name in names {
        let scene = read(&edit(LEAST, "\"implicit_euler\"", &format!("\"{name}\"")));
        assert_eq!(scene.time.integrator.name(), name);
        assert_eq!(Integrator::from_name(name), Some(scene.time.integrator));
    }
    assert_eq!(Integrator::ALL.map(Integrator::name), names);
    assert_eq!(Integrator::from_name("euler"), None);
    let moduli = "young = 1e5\npoisson = 0.3\n";
    for name in ["linear", "corotated", "st_venant_kirchhoff", "neo_hookean", "stable_neo_hookean"] {
        read(&edit(&edit(LEAST, "C = 1e5\nD = 4e5\n", moduli), "neo_hookean", name));
    }
    for name in ["cholesky", "lu", "cg", "pcg"] {
        read(&format!("{LEAST}[solver]\nkind = \"{name}\"\n"));
    }
    for (name, axis) in [("x", Axis::X), ("y", Axis::Y), ("z", Axis::Z)] {
        let scene = read(&format!("{LEAST}[fixed]\nplane = {{ axis = \"{name}\", below = 0 }}\n"));
        assert_eq!(scene.fixed.unwrap().plane.unwrap().axis, axis);
    }
}

#[test]
fn integers_are_accepted_as_numbers() {
    let text = edit(&edit(LEAST, "density = 1000.0", "density = 1000"), "dt = 0.01", "dt = 1");
    let scene = read(&text);
    assert_eq!((scene.material.density, scene.time.dt), (1000.0, Some(1.0)));
}

#[test]
fn a_drag_may_name_its_vertex_by_index_and_fixed_nodes_may_be_listed() {
    let drag = "[drag]\nvertex = 7\nstiffness = 1\ndirection = [0, 1, 0]\namplitude = -1\nfrequency = 0\n";
    let scene = read(&format!("{LEAST}[fixed]\nnodes = [3, 0, 3]\n{drag}"));
    assert_eq!(scene.drag.unwrap().vertex, DragVertex::Index(7));
    assert_eq!(scene.fixed.unwrap().nodes, Some(vec![3, 0, 3]));
}

#[test]
fn tables_of_newton_and_solver_may_leave_out_their_numbers() {
    let scene = read(&format!("{LEAST}[newton]\n[solver]\nkind = \"pcg\"\n"));
    assert_eq!(
        scene.newton,
        Some(NewtonTable { max_iterations: None, tolerance: None, projection: None, accept_unconverged: false })
    );
    assert_eq!(
        scene.solver,
        Some(SolverTable { kind: SolverKind::Pcg, tolerance: None, preconditioner: None, precision: None })
    );
}

#[test]
fn boxes_and_rectangles_alternate_unless_they_say_otherwise_and_another_word_is_refused_with_the_two() {
    let engine = edit(LEAST, "course", "engine");
    let flat = |key: &str| edit(&engine, "box = { size = [2, 1, 1]", &format!("rectangle = {{ {key}size = [2, 1]"));
    assert_eq!(read(LEAST).mesh.cuboid.unwrap().pattern, Pattern::Alternating);
    assert_eq!(read(&flat("")).mesh.rectangle.unwrap().pattern, Pattern::Alternating);
    assert_eq!(read(&flat("pattern = \"kuhn\", ")).mesh.rectangle.unwrap().pattern, Pattern::Kuhn);
    let error = fem_scene::parse(&flat("pattern = \"crossed\", "), "x.toml".as_ref()).unwrap_err().to_string();
    assert!(error.contains("`alternating` or `kuhn`") && error.contains("line 3"), "{error}");
}

//! The tables of the engine: their values, and the line of their errors.

use fem_mesh::Side;
use fem_model::{Axis, DampingForm, Precision, Preconditioner, Projection};
use fem_scene::tables::{BodyForceTable, DampingTable, On, SidePlane, SpringTable, StaticTable, TractionTable};

use crate::errors::assert_refused;
use crate::{LEAST, body, edit, read};

/// Every table that only the engine has; together with [`LEAST`], whose last line is 12.
const TABLES: &str = r#"precision = "f32"
[newton]
projection = "always"
[solver]
kind = "pcg"
preconditioner = "multigrid"
[damping]
alpha = 0.5
beta = 1e-3
[mass]
lumped = true
[body_force]
density = [0, 0, -9810]
[[traction]]
on = { axis = "x", side = "max", within = 1e-9 }
force_per_area = [1, 2, 3]
[[traction]]
faces = [[4, 0, 1]]
pressure = -5.0
[[springs]]
nodes = [0, 11]
stiffness = 100.0
rest_length = 0
"#;

fn with_tables() -> String {
    format!("{LEAST}{TABLES}")
}

#[test]
fn the_tables_of_the_engine_are_read() {
    let scene = read(&with_tables());
    assert_eq!(scene.time.precision, Precision::F32);
    assert_eq!(scene.newton.unwrap().projection, Some(Projection::Always));
    assert_eq!(scene.solver.unwrap().preconditioner, Some(Preconditioner::Multigrid));
    assert_eq!(scene.damping, Some(DampingTable { alpha: 0.5, beta: 1e-3, form: DampingForm::KelvinVoigt }));
    assert_eq!(scene.mass.lumped, Some(true));
    assert_eq!(scene.body_force, Some(BodyForceTable { density: [0.0, 0.0, -9810.0], curve: None }));
    let on = Some(On::Side(SidePlane { axis: Axis::X, side: Side::Max, within: 1e-9 }));
    let dead = TractionTable { on, force_per_area: Some([1.0, 2.0, 3.0]), ..TractionTable::default() };
    let faces = Some(vec![[4, 0, 1]]);
    let follower = TractionTable { faces, pressure: Some(-5.0), ..TractionTable::default() };
    assert_eq!(scene.traction, [dead, follower]);
    assert_eq!(scene.springs, [SpringTable { nodes: [0, 11], stiffness: 100.0, rest_length: Some(0.0), damping: 0.0 }]);
}

#[test]
fn load_steps_are_read_for_equilibrium() {
    let text = format!("{}[static]\nload_steps = 4\n", edit(LEAST, "implicit_euler", "static"));
    assert_eq!(read(&text).statics, Some(StaticTable { load_steps: 4, arc_length: false }));
    assert_refused(&edit(&text, "load_steps = 4", "load_steps = 0"), 13, "static.load_steps is 0; give at least one");
}

#[test]
fn parameters_of_newmark_and_generalized_alpha_are_read_and_have_ranges() {
    let newmark = format!("{}[newmark]\nbeta = 0.3025\ngamma = 0.6\n", edit(LEAST, "implicit_euler", "newmark"));
    let parameters = read(&newmark).method().newmark;
    assert_eq!((parameters.beta, parameters.gamma), (0.3025, 0.6));
    let method = read(LEAST).method();
    assert_eq!((method.newmark.beta, method.newmark.gamma, method.rho_inf), (0.25, 0.5, 0.8));
    assert_refused(
        &edit(&newmark, "0.3025", "0.08"),
        13,
        "newmark.beta is 0.08; give a number from 0.3, half of newmark.gamma",
    );
    let conditional = read(&edit(&newmark, "0.3025", "0.0833333333333")).method().newmark;
    assert!(!conditional.is_unconditionally_stable() && parameters.is_unconditionally_stable());
    assert_refused(&edit(&newmark, "0.6", "0.4"), 14, "newmark.gamma is 0.4; give a number from 0.5 to 1");
    assert_refused(&edit(&newmark, "0.6", "nan"), 14, "newmark.gamma");
    let alpha = edit(LEAST, "implicit_euler", "generalized_alpha") + "[generalized_alpha]\nspectral_radius = 0.5\n";
    assert_eq!(read(&alpha).method().rho_inf, 0.5);
    assert_eq!(read(&edit(&alpha, "spectral_radius", "rho_inf")).method().rho_inf, 0.5);
    for wrong in ["-0.1", "1.5", "inf"] {
        assert_refused(
            &edit(&alpha, "spectral_radius = 0.5", &format!("spectral_radius = {wrong}")),
            13,
            "generalized_alpha.spectral_radius is",
        );
    }
    let other = edit(&edit(&alpha, "\"generalized_alpha\"", "\"bdf2\""), "\"course\"", "\"engine\"");
    assert_refused(&other, 12, "generalized_alpha has no effect with");
}

#[test]
fn tables_of_the_engine_have_defaults() {
    let scene = read(&format!("{LEAST}[newton]\n[damping]\nbeta = 2\n"));
    assert_eq!((scene.time.precision, scene.mesh.refine), (Precision::F64, 0));
    assert_eq!(scene.newton.unwrap().projection.unwrap_or_default(), Projection::WhenNeeded);
    assert_eq!(Preconditioner::default(), Preconditioner::BlockJacobi);
    assert_eq!(scene.damping, Some(DampingTable { alpha: 0.0, beta: 2.0, form: DampingForm::KelvinVoigt }));
    assert!(scene.traction.is_empty() && scene.springs.is_empty() && scene.prescribed.is_empty());
    assert!(scene.statics.is_none() && scene.body_force.is_none());
}

#[test]
fn every_name_of_the_engine_s_tables_is_known() {
    for name in ["when_needed", "always", "never"] {
        read(&edit(&with_tables(), "\"always\"", &format!("\"{name}\"")));
    }
    for (name, form) in [("kelvin_voigt", DampingForm::KelvinVoigt), ("rayleigh", DampingForm::Rayleigh)] {
        let scene = read(&edit(&with_tables(), "beta = 1e-3", &format!("beta = 1e-3\nform = \"{name}\"")));
        assert_eq!(scene.damping.unwrap().form, form);
    }
    for name in ["block_jacobi", "ssor", "multigrid"] {
        read(&edit(&with_tables(), "multigrid", name));
    }
    assert_refused(&edit(&with_tables(), "\"f32\"", "\"f16\""), 12, "unknown variant `f16`");
    assert_refused(&edit(&with_tables(), "\"always\"", "\"often\""), 14, "unknown variant `often`");
    assert_refused(&edit(&with_tables(), "\"max\"", "\"top\""), 26, "unknown variant `top`");
}

#[test]
fn numbers_out_of_range_are_refused_at_their_line() {
    let refused = |from: &str, to: &str, line: usize, beginning: &str| {
        assert_refused(&edit(&with_tables(), from, to), line, beginning);
    };
    refused("alpha = 0.5", "alpha = -1", 19, "damping.alpha is -1; give 0 1/s or more");
    refused("beta = 1e-3", "beta = nan", 20, "damping.beta is NaN; give 0 s or more");
    refused("-9810]", "inf]", 24, "body_force.density is inf; give finite numbers");
    refused("within = 1e-9", "within = -1", 26, "traction[0].on has within = -1; give a distance");
    refused("[1, 2, 3]", "[1, nan, 3]", 27, "traction[0].force_per_area is NaN");
    refused("-5.0", "inf", 30, "traction[1].pressure is inf; give finite numbers");
    refused("100.0", "0", 33, "springs[0].stiffness is 0; give a positive number of N/m");
    refused("rest_length = 0", "rest_length = -1", 34, "springs[0].rest_length is -1; give 0 m or more");
    refused("[0, 11]", "[3, 3]", 32, "springs[0].nodes names node 3 twice; a spring joins");
    refused("cells_per_unit = 1 }", "cells_per_unit = 1 }\nrefine = 5", 4, "mesh.refine is 5; cut");
    refused("cells_per_unit = 1 }", "cells_per_unit = 1 }\norder = 0", 4, "mesh.order is 0; write 1");
}

#[test]
fn lists_of_a_wrong_length_are_refused() {
    assert_refused(&edit(&with_tables(), "[0, 11]", "[0, 11, 12]"), 32, "invalid length 3, expected two nodes");
    assert_refused(&edit(&with_tables(), "[[4, 0, 1]]", "[[4, 0, 1, 2]]"), 29, "invalid length 4, expected three");
    assert_refused(&edit(&with_tables(), "[1, 2, 3]", "[1, 2]"), 27, "invalid length 2, expected three numbers");
}

#[test]
fn an_empty_list_of_nodes_or_faces_is_refused() {
    assert_refused(&edit(&with_tables(), "[[4, 0, 1]]", "[]"), 29, "traction[1].faces is empty; name a triangle");
    assert_refused(
        &format!("{LEAST}[fixed]\nnodes = []\n"),
        13,
        "fixed.nodes is empty; name a node, or remove the table",
    );
    let prescribed = format!("{LEAST}[[prescribed]]\nnodes = []\ndisplacement = [0, 0, 0]\n");
    assert_refused(&prescribed, 13, "prescribed[0].nodes is empty; name a node");
}

#[test]
fn a_traction_names_one_place_and_one_force() {
    let place = "traction[1] needs one of on, box, sphere, set, faces and edges; give one and only one";
    let force = "needs either force_per_area or pressure; give one and only one";
    assert_refused(&edit(&with_tables(), "faces = [[4, 0, 1]]\n", ""), 28, place);
    assert_refused(&edit(&with_tables(), "pressure = -5.0\n", ""), 28, &format!("traction[1] {force}"));
    let both = edit(&with_tables(), "force_per_area = [1, 2, 3]\n", "force_per_area = [1, 2, 3]\npressure = 1\n");
    assert_refused(&both, 25, &format!("traction[0] {force}"));
}

#[test]
fn a_preconditioner_belongs_to_the_preconditioned_solver() {
    for kind in ["cholesky", "lu", "cg"] {
        assert_refused(
            &edit(&with_tables(), "\"pcg\"", &format!("\"{kind}\"")),
            17,
            "solver.preconditioner belongs to the kind \"pcg\"; write",
        );
    }
}

#[test]
fn a_traction_on_a_side_loads_its_triangles_and_listed_ones_are_looked_up_in_any_order() {
    let body = body(&with_tables()).unwrap();
    let (side, listed) = (&body.tractions[0].faces, &body.pressures[0].faces);
    assert_eq!(side.len(), 2);
    assert!(side.iter().flatten().all(|&node| body.shape.mesh.vertices()[node].x == 2.0), "{side:?}");
    assert_eq!(listed.len(), 1);
    assert!(
        body.shape.boundary.iter().any(|face| face[..] == listed[0]),
        "as the boundary has it, so that it looks outward"
    );
    assert_eq!((body.springs[0].rest_length, body.springs[0].is_initially_relaxed), (0.0, false));
}

#[test]
fn a_spring_without_a_rest_length_is_at_rest_in_the_undeformed_body() {
    let spring = body(&edit(&with_tables(), "rest_length = 0\n", "")).unwrap().springs[0];
    assert_eq!((spring.rest_length, spring.is_initially_relaxed), (6f64.sqrt(), true));
}

#[test]
fn nodes_and_faces_outside_the_mesh_are_refused() {
    let refused = |from: &str, to: &str, end: &str| {
        let message = body(&edit(&with_tables(), from, to)).unwrap_err().to_string();
        assert!(message.ends_with(end), "{message}");
    };
    refused("[0, 11]", "[0, 12]", "springs[0].nodes names node 12; the mesh has nodes 0 to 11");
    refused(
        "[[4, 0, 1]]",
        "[[0, 1, 11]]",
        "traction[1].faces names [0, 1, 11], which is no triangle of the boundary; correct it",
    );
}

#[test]
fn a_refined_body_has_eight_times_the_elements_and_keeps_its_first_nodes() {
    let plain = body(LEAST).unwrap().shape.mesh;
    let refined = body(&edit(LEAST, "cells_per_unit = 1 }", "cells_per_unit = 1 }\nrefine = 2")).unwrap().shape.mesh;
    assert_eq!(refined.elements(), 64 * plain.elements());
    assert_eq!(refined.vertices()[..12], *plain.vertices());
    assert_eq!(refined.vertices().len(), 9 * 5 * 5, "a grid of quarter cells");
}

#[test]
fn a_refinement_that_would_be_too_large_is_refused_with_its_size() {
    let text =
        edit(LEAST, "size = [2, 1, 1], cells_per_unit = 1 }", "size = [2, 1, 1], cells_per_unit = 20 }\nrefine = 4");
    let message = body(&text).unwrap_err().to_string();
    assert!(message.contains("mesh.refine: box: refined 4 times the mesh would have 3.93216e8 elements"), "{message}");
}

#[test]
fn a_static_scene_may_leave_out_its_time_step_and_no_other_may() {
    let text = edit(LEAST, "dt = 0.01\nintegrator = \"implicit_euler\"", "integrator = \"static\"");
    let scene = read(&text);
    assert_eq!((scene.time.dt, scene.method().dt), (None, 1.0));
    assert_eq!(read(&edit(&text, "[time]\n", "[time]\ndt = 0.5\n")).method().dt, 0.5);
    let mut moving = scene;
    moving.time.integrator = fem_model::Integrator::Rk4;
    let message = moving.check().unwrap_err().to_string();
    assert!(message.ends_with("time.dt is missing, and rk4 needs a time step; give it in seconds"), "{message}");
    moving.time.dt = Some(0.01);
    moving.check().unwrap();
}

#[test]
fn a_drag_is_in_the_stiffness_of_the_engine_always_and_in_that_of_the_course_on_request() {
    let numbers = "stiffness = 1\ndirection = [1, 0, 0]\namplitude = 0.1\nfrequency = 1.0\n";
    let text = |pipeline: &str, value: &str| {
        let scene = edit(LEAST, "course", pipeline);
        format!("{scene}[drag]\nvertex = 1\n{numbers}in_stiffness = {value}\n")
    };
    for (pipeline, value) in [("course", "true"), ("course", "false"), ("engine", "true")] {
        assert_eq!(read(&text(pipeline, value)).drag.unwrap().in_stiffness, Some(value == "true"), "{pipeline}");
    }
    let refused = text("engine", "false");
    assert_refused(&refused, refused.lines().count(), "drag.in_stiffness is false");
    let refused = text("course", "\"no\"");
    assert_refused(&refused, refused.lines().count(), "invalid type: string");
}

#[test]
fn nodal_forces_take_the_selectors_of_fixed_nodes_and_are_checked() {
    let with = |table: &str| format!("{LEAST}[[force]]\n{table}");
    let forces = |table: &str| body(&with(table)).unwrap().nodal_forces;
    let left = forces("plane = { axis = \"x\", below = 1e-9 }\nvalue = [1, 2, 3]\ncurve = { ramp = 2 }\n");
    assert!(!left.is_empty() && left[0].nodes.contains(&0) && left[0].force.as_slice() == [1.0, 2.0, 3.0]);
    assert_eq!(left[0].curve, Some(fem_model::LoadCurve::Ramp(2.0)));
    assert_eq!(forces("nodes = [3, 1, 3]\nvalue = [0, 0, 1]\n")[0].nodes, [1, 3]);
    assert_refused(&with("nodes = []\nvalue = [0, 0, 1]\n"), 13, "force[0].nodes is empty; name a node");
    assert_refused(&with("nodes = [1]\nvalue = [0, nan, 1]\n"), 14, "force[0].value is NaN; give finite numbers");
    assert_refused(&with("value = [0, 0, 1]\n"), 12, "force[0] needs one of plane, on, box, sphere, set and nodes");
    let two = "nodes = [1]\non = \"all\"\nvalue = [0, 0, 1]\n";
    assert_refused(&with(two), 12, "force[0] needs one of plane");
    for (table, message) in [
        ("nodes = [99]\nvalue = [0, 0, 1]\n", "force[0].nodes names node 99; the mesh has nodes 0 to"),
        ("box = { min = [9, 9, 9], max = [10, 10, 10] }\nvalue = [0, 0, 1]\n", "force[0].box (from [9.0, 9.0, 9.0]"),
        ("set = \"tip\"\nvalue = [0, 0, 1]\n", "force[0].set is \"tip\", and the mesh has no sets"),
    ] {
        let error = body(&with(table)).unwrap_err().to_string();
        assert!(error.contains(message), "{error}");
    }
}

#[test]
fn a_nodal_force_on_a_constrained_coordinate_is_told() {
    let text = |force: &str| format!("{LEAST}{force}");
    let warnings = |force: &str| {
        let text = text(force);
        fem_scene::warnings(&read(&text), &body(&text).unwrap())
    };
    let slider = "[[prescribed]]\nnodes = [0, 1]\ndisplacement = [0, 0, 0]\ncomponents = [\"x\"]\n";
    assert!(warnings(&format!("{slider}[[force]]\nnodes = [0, 2]\nvalue = [0, 1, 0]\n")).is_empty());
    let found = warnings(&format!("{slider}[[force]]\nnodes = [0, 2]\nvalue = [4, 1, 0]\n"));
    assert!(
        found.len() == 1 && found[0].contains("force[0]: 1 of its 2 nodes are constrained along the force"),
        "{found:?}"
    );
}

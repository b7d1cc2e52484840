//! Errors know the file and the line, and their text names the field and the remedy.

use std::path::Path;

use fem_scene::{SceneError, parse};

use crate::{LEAST, body, edit, read};

/// Refused at this line with a text that begins like this.
pub fn assert_refused(text: &str, expected_line: usize, beginning: &str) {
    match parse(text, Path::new("folder/name.toml")) {
        Err(SceneError::Line { file, line, problem }) => {
            assert_eq!((file.as_path(), line), (Path::new("folder/name.toml"), expected_line), "{problem}\n{text}");
            assert!(problem.starts_with(beginning), "{problem}");
            assert!(problem.contains("; "), "no remedy in: {problem}");
        }
        other => panic!("{other:?} of\n{text}"),
    }
}

#[test]
fn a_message_begins_with_file_and_line() {
    let message = parse(&edit(LEAST, "0.01", "-1"), Path::new("folder/name.toml")).unwrap_err().to_string();
    assert_eq!(message, "folder/name.toml, line 10: time.dt is -1; give a positive number of seconds");
}

#[test]
fn a_field_is_found_in_every_notation_of_the_file_format() {
    let dotted = edit(LEAST, "[time]\ndt = 0.01\nintegrator = \"implicit_euler\"\n", "");
    assert_refused(&format!("time.integrator = \"rk4\"\n\ntime.dt = 0\n{dotted}"), 3, "time.dt is 0");
    assert_refused(&format!("time = {{ integrator = \"rk4\", dt = 0 }}\n{dotted}"), 1, "time.dt is 0");
    assert_refused(&edit(LEAST, "dt = 0.01", "# dt = 5\n\n  \"dt\"   =   0"), 12, "time.dt is 0");
    assert_refused(&edit(LEAST, "dt = 0.01", "dt = 0").replace('\n', "\r\n"), 10, "time.dt is 0");
    assert_refused(
        &format!("about = \"\"\"\ndt = 1\n\n\"\"\"\n{}", edit(LEAST, "dt = 0.01", "dt = 0")),
        14,
        "time.dt is 0",
    );
}

#[test]
fn a_key_that_is_missing_is_reported_at_its_table() {
    assert_refused(
        &edit(LEAST, "dt = 0.01\n", ""),
        9,
        "time.dt is missing, and implicit_euler needs a time step; give it in seconds",
    );
    assert_refused(
        &edit(LEAST, "D = 4e5\n", ""),
        4,
        "material needs either C and D or young and poisson or lambda and mu",
    );
    assert_refused(&edit(LEAST, "box = { size = [2, 1, 1], cells_per_unit = 1 }\n", ""), 2, "mesh names no elements");
    assert_refused(&format!("{LEAST}[fixed]\n"), 12, "fixed needs one of plane, on, box, sphere, set and nodes; give");
}

#[test]
fn a_table_that_is_written_as_a_list_and_a_list_that_is_written_as_a_table_are_named() {
    let gravity = "[[gravity]]\nacceleration = [0, 0, -9.81]\n";
    assert_refused(&format!("{LEAST}{gravity}"), 12, "[[gravity]] is not a list; write [gravity]");
    assert_refused(&format!("{LEAST}{gravity}{gravity}"), 12, "[[gravity]] is written more than once; keep one");
    let force = "[force]\nnodes = [0]\nvalue = [0, 0, 1]\n";
    assert_refused(&format!("{LEAST}{force}"), 12, "[force] is one of a list; write [[force]]");
}

#[test]
fn the_tables_of_the_engine_are_checked() {
    assert_refused(&format!("{LEAST}[newton]\nmax_iterations = 0\n"), 13, "newton.max_iterations is 0");
    for value in ["0", "-1e-9", "nan", "inf"] {
        assert_refused(&format!("{LEAST}[newton]\ntolerance = {value}\n"), 13, "newton.tolerance is ");
        assert_refused(&format!("{LEAST}[solver]\nkind = \"cg\"\ntolerance = {value}\n"), 14, "solver.tolerance is ");
    }
    assert_refused(&format!("{LEAST}[solver]\nkind = \"magic\"\n"), 13, "unknown variant `magic`");
    assert_refused(&format!("{LEAST}[solver]\n"), 12, "missing field `kind`");
    assert_refused(&format!("{LEAST}[mass]\nlumped = 1\n"), 13, "invalid type: integer `1`");
}

#[test]
fn c_and_d_belong_to_the_neo_hookean_model_alone() {
    for model in ["linear", "corotated", "st_venant_kirchhoff", "stable_neo_hookean"] {
        assert_refused(
            &edit(LEAST, "neo_hookean", model),
            6,
            "material.C and D belong to neo_hookean, gent; give this model",
        );
    }
}

#[test]
fn a_law_takes_its_own_parameters_only_and_the_message_names_them() {
    let with = |model: &str, parameters: &str| {
        edit(&edit(LEAST, "C = 1e5\nD = 4e5\n", parameters), "neo_hookean", model).replace("\"course\"", "\"engine\"")
    };
    assert_refused(
        &with("mooney_rivlin", "C = 1e5\nD = 4e5\n"),
        6,
        "material.C belongs to neo_hookean, gent; give this model C10 and C01",
    );
    assert_refused(
        &with("linear", "C10 = 1\nC01 = 1\nD = 1\n"),
        6,
        "material.C10 and C01 and D belong to mooney_rivlin; ",
    );
    assert_refused(
        &with("mooney_rivlin", "C10 = 1e5\nD = 4e5\n"),
        4,
        "material needs C10 and C01 and D; give these and no",
    );
    assert_refused(
        &with("mooney_rivlin", "C10 = 1\nC01 = nan\nD = 4e5\n"),
        7,
        "material.C01 is NaN; give finite numbers",
    );
    assert_refused(
        &with("rubber", "C = 1e5\nD = 4e5\n"),
        5,
        "material.model is `rubber`, which is no law; write one of linear, ",
    );
    assert_eq!(read(&with("mooney_rivlin", "C10 = 1\nC01 = -0.5\nD = 4e5\n")).material.C01, Some(-0.5));
}

#[test]
fn vectors_have_three_numbers() {
    for numbers in ["[]", "[1]", "[1, 2]", "[1, 2, 3, 4]"] {
        assert_refused(&format!("{LEAST}[gravity]\nacceleration = {numbers}\n"), 13, "invalid length ");
        assert_refused(&edit(LEAST, "[2, 1, 1]", numbers), 3, "invalid length ");
    }
    assert_refused(&format!("{LEAST}[gravity]\nacceleration = [0, \"g\", 0]\n"), 13, "invalid type: string \"g\"");
}

#[test]
fn the_error_of_a_mesh_names_the_scene_s_line_and_field_and_the_mesh_s_own_error() {
    let error = body(&edit(LEAST, "[2, 1, 1]", "[2, 1, 0.3]")).unwrap_err();
    assert!(matches!(&error, SceneError::Mesh { line: 3, field: "mesh.box", .. }), "{error:?}");
    assert!(error.to_string().starts_with("folder/name.toml, line 3: mesh.box: the size 0.3 m"), "{error}");
}

#[test]
fn a_pipeline_can_refuse_a_field_at_its_line() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("name.toml");
    std::fs::write(&path, LEAST).unwrap();
    let error = parse(LEAST, &path).unwrap().refuse("time.integrator", "is out of fashion; use another");
    let problem = "time.integrator is out of fashion; use another".to_owned();
    assert_eq!(error, SceneError::Line { file: path, line: 11, problem });
}

#[test]
fn nodes_beyond_the_mesh_are_refused_and_the_last_one_is_not() {
    let fixed = |node: usize| body(&format!("{LEAST}[fixed]\nnodes = [{node}]\n"));
    assert_eq!(fixed(11).unwrap().fixed_nodes(), Some(&[11][..]));
    assert!(fixed(12).unwrap_err().to_string().ends_with("fixed.nodes names node 12; the mesh has nodes 0 to 11"));
    let drag = |node: usize| {
        let numbers = "stiffness = 1\ndirection = [0, 1, 0]\namplitude = 1\nfrequency = 1";
        body(&format!("{LEAST}[drag]\nvertex = {node}\n{numbers}\n"))
    };
    assert_eq!(drag(11).unwrap().drag.unwrap().node, 11);
    assert!(drag(12).unwrap_err().to_string().ends_with("drag.vertex names node 12; the mesh has nodes 0 to 11"));
}

#[test]
fn a_good_scene_is_not_refused() {
    assert_eq!(read(LEAST).mesh.cuboid.unwrap().size, [2.0, 1.0, 1.0]);
}

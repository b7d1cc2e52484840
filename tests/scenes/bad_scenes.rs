//! Scene files that cannot be used: exit code 2, and one line with the file, the line, the field and the remedy.

use crate::program::{Desk, assert_names};
use crate::scene_text::{CUBE, edit, without};

/// Asserts that the cube's scene with a passage replaced is refused with a message of one line that names this line of the file
/// and contains these parts.
fn assert_refused(from: &str, to: &str, line: usize, parts: &[&str]) {
    assert_text_refused(&edit(CUBE, from, to), line, parts);
}

fn assert_text_refused(text: &str, line: usize, parts: &[&str]) {
    let message = Desk::with("bad.toml", text).refused("bad.toml --headless");
    assert_eq!(message.lines().count(), 1, "{message}");
    assert!(message.starts_with(&format!("error: bad.toml, line {line}: ")), "not line {line}: {message}\n{text}");
    assert_names(&message, parts);
}

#[test]
fn files_that_are_not_text_are_refused() {
    let garbage: Vec<u8> = (0..400_u32).map(|i| (i * i * 31 + 128) as u8).collect();
    let message = Desk::with("bad.toml", garbage).refused("bad.toml --headless");
    assert_names(&message, &["bad.toml: cannot be read: it is not UTF-8 text; check"]);
    assert_text_refused("a\0b", 1, &["correct this line"]);
    assert_text_refused("", 1, &["missing field `pipeline`", "add it"]);
}

#[test]
fn broken_toml_is_refused_where_it_breaks() {
    assert_refused("[gravity]", "[gravity", 10, &["correct this line"]);
    assert_refused("dt = 0.01", "dt = ", 15, &["correct this line"]);
    assert_refused("dt = 0.01", "dt = 0.01\ndt = 0.02", 16, &["duplicate key"]);
    assert_refused("[fixed]", "[gravity]", 12, &["duplicate key"]);
}

#[test]
fn an_unknown_key_is_refused_at_the_top_and_in_every_table() {
    assert_text_refused(&format!("colour = \"red\"\n{CUBE}"), 1, &["unknown field `colour`", "`about`", "`drag`"]);
    assert_text_refused(&format!("{CUBE}[wind]\nspeed = 1\n"), 25, &["unknown field `wind`", "`gravity`"]);
    let tables = [("mesh", 4), ("material", 6), ("gravity", 11), ("fixed", 13), ("time", 15), ("drag", 19)];
    for (table, line) in tables {
        assert_refused(&format!("[{table}]\n"), &format!("[{table}]\nfoo = 1\n"), line, &["unknown field `foo`"]);
    }
    for (table, content) in [("newton", ""), ("solver", "kind = \"cg\"\n"), ("mass", "")] {
        let text = format!("{CUBE}[{table}]\n{content}foo = 1\n");
        assert_text_refused(&text, text.lines().count(), &["unknown field `foo`"]);
    }
    assert_refused("cells_per_unit = 2", "cells_per_unit = 2, foo = 1", 4, &["unknown field `foo`"]);
    assert_refused("below = 0.1", "below = 0.1, foo = 1", 13, &["unknown field `foo`", "`axis`"]);
}

#[test]
fn a_value_of_the_wrong_type_is_refused() {
    assert_refused("dt = 0.01", "dt = \"0.01\"", 15, &["string \"0.01\"", "correct this value"]);
    assert_refused("steps = 4", "steps = 4.5", 17, &["4.5"]);
    assert_refused("steps = 4", "steps = -4", 17, &["-4"]);
    assert_refused("density = 1000.0", "density = true", 9, &["boolean"]);
    assert_refused("[0, -9.81, 0]", "\"down\"", 11, &["\"down\""]);
    assert_refused("[0, -9.81, 0]", "[0, -9.81]", 11, &["length 2", "three numbers"]);
    assert_refused("[0, -9.81, 0]", "[0, -9.81, 0, 0]", 11, &["length 4", "three numbers"]);
    assert_refused("[1, 1, 1]", "[1, 1, 1, 1]", 4, &["length 4", "three numbers"]);
    assert_refused("direction = [1, 0, 0]", "direction = [1, 0, 0, 0]", 21, &["length 4", "three numbers"]);
    assert_refused("plane = { axis = \"y\", below = 0.1 }", "nodes = [0, -1]", 13, &["-1"]);
    assert_refused("plane = { axis = \"y\", below = 0.1 }", "plane = 3", 13, &["integer `3`"]);
    assert_refused("about = \"a rubber cube\"", "about = 3", 1, &["integer `3`"]);
    assert_text_refused(&edit(&without(CUBE, "gravity"), "about", "gravity = 3\nabout"), 1, &["integer `3`"]);
}

#[test]
fn a_missing_table_or_key_is_named() {
    for table in ["mesh", "material", "time"] {
        assert_text_refused(&without(CUBE, table), 1, &[&format!("missing field `{table}`"), "add it"]);
    }
    assert_refused("pipeline = \"course\"\n", "", 1, &["missing field `pipeline`"]);
    assert_refused("model = \"neo_hookean\"\n", "", 5, &["missing field `model`"]);
    assert_refused("density = 1000.0\n", "", 5, &["missing field `density`"]);
    assert_refused("acceleration = [0, -9.81, 0]\n", "", 10, &["missing field `acceleration`"]);
    assert_refused(
        "dt = 0.01\n",
        "",
        14,
        &["time.dt is missing, and implicit_euler needs a time step; give it in seconds"],
    );
    assert_refused("integrator = \"implicit_euler\"\n", "", 14, &["missing field `integrator`"]);
    assert_refused("axis = \"y\", ", "", 13, &["missing field `axis`"]);
    assert_refused(", cells_per_unit = 2", "", 4, &["missing field `cells_per_unit`"]);
    for key in
        ["vertex = \"highest\"", "stiffness = 1e5", "direction = [1, 0, 0]", "amplitude = 0.2", "frequency = 1.0"]
    {
        let name = key.split(' ').next().unwrap();
        assert_refused(&format!("{key}\n"), "", 18, &[&format!("missing field `{name}`")]);
    }
}

#[test]
fn an_unknown_name_is_refused_with_the_known_ones() {
    assert_refused("\"course\"", "\"curse\"", 2, &["`curse`", "`course` or `engine`"]);
    assert_refused("\"neo_hookean\"", "\"rubber\"", 6, &["material.model is `rubber`", "write one of", "neo_hookean"]);
    assert_refused("\"implicit_euler\"", "\"euler\"", 16, &["`euler`", "`implicit_euler`"]);
    assert_refused("axis = \"y\"", "axis = \"w\"", 13, &["`w`", "`x`, `y`"]);
    assert_refused("\"highest\"", "\"lowest\"", 19, &["\"lowest\"", "\"highest\" or the index of a vertex"]);
    assert_refused("\"highest\"", "-1", 19, &["-1", "\"highest\" or the index of a vertex"]);
    assert_refused("\"highest\"", "1.5", 19, &["1.5", "\"highest\" or the index of a vertex"]);
}

#[test]
fn numbers_out_of_range_are_refused_with_their_field() {
    for value in ["0", "-0.01", "nan", "inf", "-inf", "1e-999"] {
        assert_refused(
            "dt = 0.01",
            &format!("dt = {value}"),
            15,
            &["time.dt is ", "give a positive number of seconds"],
        );
        let density = format!("density = {value}");
        assert_refused("density = 1000.0", &density, 9, &["material.density is ", "give a positive number of kg/m³"]);
        assert_refused("C = 1e5", &format!("C = {value}"), 7, &["material.C is ", "give a positive number of Pa"]);
        assert_refused("D = 4e5", &format!("D = {value}"), 8, &["material.D is ", "give a positive number of Pa"]);
        let drag = format!("stiffness = {value}");
        assert_refused("stiffness = 1e5", &drag, 20, &["drag.stiffness is ", "give a positive number of N/m"]);
        let scale = format!("scale = {value}\n[material]");
        assert_refused("[material]", &scale, 5, &["mesh.scale is ", "give a positive number"]);
    }
    assert_refused("steps = 4", "steps = 0", 17, &["time.steps is 0", "at least one"]);
    assert_refused("steps = 4", "substeps = 0", 17, &["time.substeps is 0", "at least one"]);
    assert_refused("steps = 4", "substeps = 1000000", 17, &["time.substeps is 1000000", "at most 100000"]);
    assert_refused("steps = 4", "substeps = 2", 17, &["time.substeps", "engine"]);
    assert_refused("-9.81", "1e999", 11, &["overflow", "correct this line"]);
    for value in ["nan", "inf", "-inf"] {
        assert_refused("-9.81", value, 11, &["gravity.acceleration is ", "give finite numbers"]);
        assert_refused("amplitude = 0.2", &format!("amplitude = {value}"), 22, &["drag.amplitude is ", "give finite"]);
        assert_refused("direction = [1, 0, 0]", &format!("direction = [0, {value}, 0]"), 21, &["drag.direction is "]);
    }
    assert_refused("-9.81", "-1e300", 11, &["gravity.acceleration is too long", "give a shorter vector"]);
    assert_refused("direction = [1, 0, 0]", "direction = [0, 0.0, -0.0]", 21, &["drag.direction is zero"]);
    for value in ["-1", "nan", "inf"] {
        assert_refused("frequency = 1.0", &format!("frequency = {value}"), 23, &["drag.frequency is ", "0 Hz or more"]);
        assert_refused("below = 0.1", &format!("below = {value}"), 13, &["fixed.plane has below = ", "0 m or more"]);
    }
}

#[test]
fn a_material_without_exactly_one_pair_of_moduli_is_refused() {
    let pair = "give one pair and only one";
    assert_refused("D = 4e5\n", "", 5, &["material needs either C and D or young and poisson or lambda and mu", pair]);
    assert_refused("C = 1e5\n", "", 5, &[pair]);
    assert_refused("C = 1e5\nD = 4e5\n", "", 5, &[pair]);
    assert_refused("C = 1e5\nD = 4e5\n", "young = 1e5\n", 5, &[pair]);
    assert_refused("C = 1e5\n", "C = 1e5\nyoung = 1e5\n", 5, &[pair]);
    assert_refused("D = 4e5\n", "D = 4e5\nyoung = 1e5\npoisson = 0.3\n", 5, &[pair]);
}

#[test]
fn moduli_out_of_range_are_refused() {
    for value in ["0", "-1e5", "nan", "inf"] {
        let moduli = format!("young = {value}\npoisson = 0.3\n");
        assert_refused("C = 1e5\nD = 4e5\n", &moduli, 7, &["material.young is ", "a positive number of Pa"]);
    }
    for value in ["0.5", "0.6", "-1.0", "-3", "nan", "inf", "-inf"] {
        let moduli = format!("young = 1e5\npoisson = {value}\n");
        assert_refused("C = 1e5\nD = 4e5\n", &moduli, 8, &["material.poisson is ", "above -1 and below 0.5"]);
    }
}

#[test]
fn fixed_with_two_selectors_or_none_or_an_empty_list_is_refused() {
    let plane = "plane = { axis = \"y\", below = 0.1 }\n";
    assert_refused(plane, "", 12, &["fixed needs one of plane, on,", "give one and only one"]);
    assert_refused(plane, &format!("{plane}nodes = [0]\n"), 12, &["fixed needs one of plane, on,"]);
    assert_refused(plane, "nodes = []\n", 13, &["fixed.nodes is empty", "remove the table"]);
}

#[test]
fn nodes_that_the_mesh_does_not_have_are_refused() {
    let plane = "plane = { axis = \"y\", below = 0.1 }";
    assert_refused(plane, "nodes = [0, 27]", 13, &["fixed.nodes names node 27", "nodes 0 to 26"]);
    assert_refused("\"highest\"", "27", 19, &["drag.vertex names node 27", "nodes 0 to 26"]);
}

#[test]
fn a_box_of_no_whole_number_of_cells_is_refused() {
    assert_refused("[1, 1, 1]", "[1, 1.3, 1]", 4, &["mesh.box", "1.3 m along y", "not a whole number of cells"]);
    assert_refused("[1, 1, 1]", "[1, 1, 0]", 4, &["mesh.box", "0 m along z"]);
    assert_refused("[1, 1, 1]", "[-1, 1, 1]", 4, &["mesh.box", "-1 m along x"]);
    assert_refused("[1, 1, 1]", "[nan, 1, 1]", 4, &["mesh.box", "along x"]);
    assert_refused("cells_per_unit = 2", "cells_per_unit = 0", 4, &["mesh.box", "0 cells per metre"]);
    assert_refused("[1, 1, 1]", "[1e5, 1e5, 1e5]", 4, &["mesh.box", "50000000 is the most", "lower cells_per_unit"]);
    assert_refused("[1, 1, 1]", "[1e300, 1, 1]", 4, &["mesh.box"]);
}

#[test]
fn keys_of_the_engine_are_refused_in_a_course_scene() {
    let on = "on = { axis = \"y\", side = \"max\", within = 0 }\n";
    let tables = [
        "[newton]\n".to_owned(),
        "[solver]\nkind = \"cholesky\"\n".to_owned(),
        "[damping]\nalpha = 1\n".to_owned(),
        "[static]\nload_steps = 2\n".to_owned(),
        "[body_force]\ndensity = [0, 0, 1]\n".to_owned(),
        "[[springs]]\nnodes = [0, 26]\nstiffness = 1\n".to_owned(),
        format!("[[traction]]\n{on}pressure = 1\n"),
        format!("[[prescribed]]\n{on}displacement = [1, 0, 0]\n"),
        "[[initial_velocity]]\nvelocity = [1, 0, 0]\n".to_owned(),
        "[[materials]]\non = \"all\"\nmodel = \"neo_hookean\"\nC = 1e5\nD = 4e5\ndensity = 1.0\n".to_owned(),
    ];
    for table in tables {
        assert_text_refused(&format!("{CUBE}{table}"), 25, &["belongs to the engine", "remove it"]);
    }
    assert_text_refused(&format!("{CUBE}[mass]\nlumped = true\n"), 26, &["mass.lumped belongs to the engine"]);
    assert_refused("dt = 0.01", "precision = \"f32\"\ndt = 0.01", 15, &["time.precision belongs to the engine"]);
    assert_refused("[material]", "refine = 1\n[material]", 5, &["mesh.refine belongs to the engine"]);
    assert_refused(
        "\"implicit_euler\"",
        "\"verlet\"",
        16,
        &["time.integrator is verlet", "use linearly_implicit_euler or"],
    );
    for model in ["linear", "corotated", "st_venant_kirchhoff", "stable_neo_hookean"] {
        let parts = ["material.model", "write \"neo_hookean\""];
        let material = format!("model = \"{model}\"\nyoung = 1e5\npoisson = 0.3\n");
        assert_refused("model = \"neo_hookean\"\nC = 1e5\nD = 4e5\n", &material, 6, &parts);
        assert_refused(
            "\"neo_hookean\"",
            &format!("\"{model}\""),
            7,
            &["material.C", "give this model young and poisson"],
        );
    }
}

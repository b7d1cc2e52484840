//! Scenes whose meshes cannot be used: exit code 2, and one line with the scene's file and line, the mesh's, and the remedy.

use crate::program::{Desk, assert_names};
use crate::scene_text::{CUBE, edit};

const BOX: &str = "box = { size = [1, 1, 1], cells_per_unit = 2 }";
const NODES: &str = "5 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n4 1 1 1\n";
const ELEMENTS: &str = "2 4 0\n0 0 1 2 3\n1 1 2 3 4\n";

fn desk(mesh_table: &str, nodes: &str, elements: &str) -> Desk {
    let desk = Desk::with("bad.toml", edit(CUBE, BOX, mesh_table));
    desk.write("m.node", nodes);
    desk.write("m.ele", elements);
    desk
}

/// Asserts a message of one line that names this line of the scene and contains these parts.
fn assert_refused(desk: &Desk, line: usize, parts: &[&str]) {
    let message = desk.refused("bad.toml --headless");
    assert_eq!(message.lines().count(), 1, "{message}");
    assert!(message.starts_with(&format!("error: bad.toml, line {line}: mesh")), "{message}");
    assert_names(&message, parts);
}

fn assert_mesh_refused(nodes: &str, elements: &str, line: usize, parts: &[&str]) {
    assert_refused(&desk("file = \"m.node\"", nodes, elements), line, parts);
}

#[test]
fn the_mesh_of_these_tests_runs_without_changes() {
    desk("file = \"m.node\"", NODES, ELEMENTS).run_well("bad.toml --headless");
}

#[test]
fn a_scene_needs_one_source_of_tetrahedra_and_only_one() {
    let both = format!("{BOX}\nfile = \"m.node\"");
    assert_refused(&desk(&both, NODES, ELEMENTS), 4, &["mesh.box stands beside `file`", "keep one of the two"]);
    assert_refused(
        &desk("scale = 1.0", NODES, ELEMENTS),
        3,
        &["mesh names no elements", "`file`, `files`, `box`, `surface`, `rectangle` or `picture`"],
    );
}

#[test]
fn missing_files_are_refused_with_their_names() {
    let file = |name: &str| desk(&format!("file = \"{name}\""), NODES, ELEMENTS);
    assert_refused(&file("no.node"), 4, &["mesh.file", "no.node: there is no such file", "check the path"]);
    assert_refused(&file("m.stl"), 4, &["mesh.file", "`.stl` is unknown", ".node with .ele"]);
    let lonely = file("lonely.node");
    lonely.write("lonely.node", NODES);
    assert_refused(&lonely, 4, &["lonely.node: the mesh needs `", "lonely.ele` as well", "side by side"]);
    let display = desk("file = \"m.node\"\ndisplay = \"no.obj\"", NODES, ELEMENTS);
    assert_refused(&display, 5, &["mesh.display", "no.obj: there is no such file"]);
}

#[test]
fn an_unusable_display_surface_is_refused() {
    let desk = desk("file = \"m.node\"\ndisplay = \"s.obj\"", NODES, ELEMENTS);
    desk.write("s.obj", b"\xff\x00\xfe garbage");
    assert_refused(&desk, 5, &["mesh.display", "s.obj"]);
    desk.write("s.obj", "");
    assert_refused(&desk, 5, &["mesh.display", "s.obj: the mesh has no"]);
    desk.write("s.obj", "v 0 0 0\nv 1 0 0\nf 1 2 3\n");
    assert_refused(&desk, 5, &["s.obj, line 3: vertex 3 does not exist"]);
    desk.write("s.obj", "v 0 0 0\nv 1 nan 0\nv 0 1 0\nf 1 2 3\n");
    assert_refused(&desk, 5, &["s.obj, line 2", "`nan` is not finite"]);
}

#[test]
fn wrong_counts_and_indices_are_refused() {
    assert_mesh_refused(&NODES.replacen('5', "6", 1), ELEMENTS, 4, &["mesh.file", "announces 6 nodes and holds 5"]);
    assert_mesh_refused(NODES, &ELEMENTS.replacen('2', "3", 1), 4, &["m.ele", "announces 3 tetrahedra and holds 2"]);
    assert_mesh_refused(NODES, "2 4 0\n0 0 1 2 3\n1 1 2 3 5\n", 4, &["m.ele, line 3: vertex 5 does not exist"]);
    assert_mesh_refused(NODES, "2 4 0\n0 0 1 2 3\n1 1 2 3 -1\n", 4, &["m.ele, line 3: vertex -1 does not exist"]);
}

#[test]
fn coordinates_that_are_not_finite_numbers_are_refused() {
    for word in ["nan", "inf", "1e999"] {
        let nodes = NODES.replacen("2 0 1 0", &format!("2 0 {word} 0"), 1);
        assert_mesh_refused(&nodes, ELEMENTS, 4, &["m.node, line 4", &format!("`{word}` is not finite")]);
    }
    assert_mesh_refused(&NODES.replacen("2 0 1 0", "2 0 a 0", 1), ELEMENTS, 4, &["line 4: `a` is not a coordinate"]);
}

#[test]
fn elements_without_positive_volume_are_refused_with_their_number() {
    let flat = NODES.replacen("4 1 1 1", "4 0.5 0.5 0", 1);
    assert_mesh_refused(
        &flat,
        ELEMENTS,
        3,
        &["m.node: element 1", "no volume", "move its vertices apart, or leave such"],
    );
    let swapped = "2 4 0\n0 0 1 2 3\n1 2 1 3 4\n";
    assert_mesh_refused(
        NODES,
        swapped,
        3,
        &["element 1", "negative volume -3.3", "the first of 1", "`mesh convert --orient`"],
    );
    let repeated = "2 4 0\n0 0 1 2 3\n1 1 2 4 4\n";
    assert_mesh_refused(NODES, repeated, 3, &["element 1", "has vertex 4 twice"]);
}

#[test]
fn a_vertex_without_an_element_is_left_out_with_a_note() {
    let outcome = desk("file = \"m.node\"", NODES, "1 4 0\n0 0 1 2 3\n").run("bad.toml --headless");
    assert_eq!(outcome.code, Some(0), "{outcome:?}");
    assert_eq!(outcome.stderr, "note: bad.toml: mesh m.node: 1 nodes belong to no element and are left out\n");
}

#[test]
fn an_empty_mesh_is_refused() {
    assert_mesh_refused("0 3 0 0\n", "0 4 0\n", 4, &["m.node", "the mesh has no "]);
    assert_mesh_refused("", "", 4, &["m.node", "the mesh has no "]);
}

#[test]
fn a_scale_out_of_range_is_refused() {
    let scaled = |scale: &str| desk(&format!("file = \"m.node\"\nscale = {scale}"), NODES, ELEMENTS);
    assert_refused(&scaled("1e-200"), 5, &["mesh.scale is 1e-200", "too small", "give 1e-60 or more"]);
    assert_refused(&scaled("1e200"), 5, &["mesh.scale is 1e200", "too large", "give at most 1e60"]);
    let far = |size: &str| desk("file = \"m.node\"", &NODES.replace("1 1 1\n", &format!("{size} 1 1\n")), ELEMENTS);
    assert_refused(&far("1e200"), 3, &["element 1", "too large", "scale the mesh to metres"]);
    scaled("1e-6").run_well("bad.toml --headless --steps 1");
}

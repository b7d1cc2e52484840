//! Selectors: the nodes, triangles and elements that the keys of a table name, and the refusal of empty ones.

use std::fs;

use fem_mesh::{Pattern, box_mesh, write_tetrahedra};
use fem_model::Body;
use fem_scene::{SceneError, load};

use crate::errors::assert_refused;
use crate::{LEAST, body, edit};

/// The fixed nodes of the smallest scene, a box of 2 × 1 × 1 cells whose nodes are (i, j, k) at i + 3 (j + 2 k).
fn fixed(selector: &str) -> Vec<usize> {
    body(&format!("{LEAST}[fixed]\n{selector}\n")).unwrap().fixed_nodes().unwrap().to_vec()
}

/// The message of a body that is refused.
fn refusal(tables: &str) -> String {
    body(&format!("{LEAST}{tables}\n")).unwrap_err().to_string()
}

/// The faces under a pressure.
fn loaded(selector: &str) -> Vec<Vec<usize>> {
    let text = format!("{LEAST}[[traction]]\n{selector}\npressure = 1.0\n");
    body(&text).unwrap().pressures.remove(0).faces
}

#[test]
fn nodes_are_selected_by_side_box_sphere_and_all() {
    assert_eq!(fixed("on = { axis = \"x\", side = \"max\", within = 1e-9 }"), [2, 5, 8, 11]);
    assert_eq!(fixed("on = { axis = \"y\", side = \"min\", within = 0 }"), [0, 1, 2, 6, 7, 8]);
    assert_eq!(fixed("on = \"all\""), (0..12).collect::<Vec<_>>());
    assert_eq!(fixed("box = { min = [0.5, -1, -1], max = [1.5, 2, 0.5] }"), [1, 4]);
    assert_eq!(fixed("sphere = { center = [0, 0, 0], radius = 1.1 }"), [0, 1, 3, 6]);
}

#[test]
fn the_surface_of_a_box_and_of_a_sphere_belongs_to_it_in_spite_of_rounding() {
    assert_eq!(fixed("box = { min = [0, 0, 0], max = [0, 1, 1] }"), [0, 3, 6, 9]);
    assert_eq!(fixed("sphere = { center = [0, 0, 0], radius = 1 }"), [0, 1, 3, 6]);
    let third = edit(LEAST, "size = [2, 1, 1], cells_per_unit = 1", "size = [1, 1, 1], cells_per_unit = 10");
    let text = format!("{third}[fixed]\nbox = {{ min = [0, 0, 0], max = [{}, 0, 0] }}\n", 0.1 + 0.2 - 1e-16);
    assert_eq!(body(&text).unwrap().fixed_nodes().unwrap(), [0, 1, 2, 3], "0.3 as three tenths");
}

#[test]
fn prescribed_nodes_and_tractions_take_the_same_selectors() {
    let motion = |selector: &str| {
        let text = format!("{LEAST}[[prescribed]]\n{selector}\ndisplacement = [1, 0, 0]\n");
        body(&text).unwrap().dirichlet.remove(0).nodes
    };
    assert_eq!(motion("box = { min = [2, 0, 0], max = [2, 1, 0] }"), [2, 5]);
    assert_eq!(motion("on = \"all\"").len(), 12);
    assert_eq!(loaded("on = \"all\""), body(LEAST).unwrap().shape.boundary, "the whole boundary");
    assert_eq!(loaded("box = { min = [0, 0, 0], max = [0, 1, 1] }").len(), 2);
    let side = loaded("on = { axis = \"x\", side = \"min\", within = 0 }");
    assert_eq!(loaded("box = { min = [0, 0, 0], max = [0, 1, 1] }"), side);
    assert_eq!(loaded("sphere = { center = [0, 0.5, 0.5], radius = 0.8 }"), side);
}

#[test]
fn a_table_has_one_selector_and_no_more() {
    let keys = "fixed needs one of plane, on, box, sphere, set and nodes; give one and only one";
    assert_refused(&format!("{LEAST}[fixed]\n"), 12, keys);
    assert_refused(&format!("{LEAST}[fixed]\nset = \"a\"\nnodes = [1]\n"), 12, keys);
    let both = "sphere = { center = [0, 0, 0], radius = 1 }\nplane = { axis = \"x\", below = 0 }";
    assert_refused(&format!("{LEAST}[fixed]\n{both}\n"), 12, keys);
}

#[test]
fn selectors_are_checked_at_their_line() {
    let refused = |selector: &str, beginning: &str| {
        assert_refused(&format!("{LEAST}[fixed]\n{selector}\n"), 13, beginning);
    };
    refused("on = \"some\"", "invalid value: string \"some\", expected \"all\" or { axis, side, within }");
    refused("on = { axis = \"x\", side = \"max\" }", "missing field `within`");
    refused("on = { axis = \"x\", side = \"max\", within = 0, below = 1 }", "unknown field `below`");
    refused(
        "sphere = { center = [0, 0, 0], radius = 0 }",
        "fixed.sphere.radius is 0; give a positive number of metres",
    );
    refused("sphere = { center = [0, nan, 0], radius = 1 }", "fixed.sphere.center is NaN");
    refused("box = { min = [0, 0, 0], max = [1, -1, 1] }", "fixed.box has min above max along y: 0 > -1; swap them");
    refused("box = { min = [0, 0], max = [1, 1, 1] }", "invalid length 2, expected three numbers");
}

#[test]
fn an_empty_selection_is_refused_with_the_extent_of_the_mesh() {
    let span = "the mesh spans [0, 0, 0] to [2, 1, 1] m, enlarge or correct it";
    let cases = [
        ("box = { min = [3, 0, 0], max = [4, 1, 1] }", "fixed.box (from [3.0, 0.0, 0.0] to [4.0, 1.0, 1.0] m)"),
        ("sphere = { center = [0.5, 0.5, 0.5], radius = 0.1 }", "fixed.sphere (radius 0.1 m about [0.5, 0.5, 0.5] m)"),
    ];
    for (selector, beginning) in cases {
        let message = refusal(&format!("[fixed]\n{selector}"));
        assert!(message.contains(&format!("{beginning} names no node; {span}")), "{message}");
    }
    let message = refusal("[[traction]]\nbox = { min = [0, 0, 0], max = [0, 0, 1] }\npressure = 1");
    assert!(message.contains("traction[0].box") && message.contains("names no triangle of the boundary"), "{message}");
}

/// Two tetrahedra glued on a face, with a set in every dimension.
const GROUPS: &str = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n\
    $PhysicalNames\n5\n0 1 \"tip\"\n1 2 \"an edge\"\n2 3 \"floor\"\n2 5 \"glue\"\n3 4 \"soft\"\n$EndPhysicalNames\n\
    $Entities\n1 1 2 2\n1 0 0 1 1 1\n1 0 0 0 1 1 1 1 2 0\n1 0 0 0 1 1 1 1 3 0\n2 0 0 0 1 1 1 1 5 0\n\
    1 0 0 0 1 1 1 1 4 0\n2 0 0 0 1 1 1 0 0\n$EndEntities\n\
    $Nodes\n1 5 1 5\n3 1 0 5\n1\n2\n3\n4\n5\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 1 1\n$EndNodes\n\
    $Elements\n6 6 1 6\n0 1 15 1\n1 4\n1 1 1 1\n2 1 2\n2 1 2 1\n3 1 3 2\n2 2 2 1\n4 2 3 4\n3 1 4 1\n5 1 2 3 4\n\
    3 2 4 1\n6 2 3 4 5\n$EndElements\n";

fn with_groups(tables: &str) -> Result<Body, SceneError> {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("m.msh"), GROUPS).unwrap();
    let text = edit(LEAST, "box = { size = [2, 1, 1], cells_per_unit = 1 }", "file = \"m.msh\"");
    fs::write(folder.path().join("a.toml"), format!("{text}{tables}\n")).unwrap();
    let scene = load(folder.path().join("a.toml").to_str().unwrap(), folder.path()).unwrap();
    fem_scene::body(&scene, folder.path())
}

#[test]
fn a_set_of_the_mesh_gives_its_nodes_and_its_triangles() {
    let fixed = |set: &str| with_groups(&format!("[fixed]\nset = {set:?}")).unwrap().fixed_nodes().unwrap().to_vec();
    assert_eq!(fixed("tip"), [3]);
    assert_eq!(fixed("an edge"), [0, 1]);
    assert_eq!(fixed("floor"), [0, 1, 2]);
    assert_eq!(fixed("soft"), [0, 1, 2, 3]);
    let body = with_groups("[[traction]]\nset = \"floor\"\npressure = 1").unwrap();
    assert_eq!(body.pressures[0].faces, [[0, 2, 1]], "as the boundary has it, seen from outside");
}

#[test]
fn a_set_that_does_not_fit_is_refused_with_the_sets_of_the_mesh() {
    let refused = |tables: &str, parts: &[&str]| {
        let message = with_groups(tables).unwrap_err().to_string();
        assert!(parts.iter().all(|part| message.contains(part)), "{message}");
    };
    refused(
        "[fixed]\nset = \"flor\"",
        &[
            "a.toml, line 13: fixed.set is \"flor\", and the mesh has the sets",
            "\"floor\" (1 triangles)",
            "\"soft\" (1 tetrahedra)",
        ],
    );
    let traction = |set: &str| format!("[[traction]]\nset = {set:?}\npressure = 1");
    refused(&traction("soft"), &["traction[0].set is \"soft\", which has 1 tetrahedra and no triangles"]);
    refused(&traction("glue"), &["traction[0].set names [1, 2, 3], which is no triangle of the boundary"]);
    let message = refusal("[fixed]\nset = \"floor\"");
    assert!(message.contains("the mesh has no sets; give a .msh file with physical groups"), "{message}");
}

#[test]
fn parts_without_a_condition_and_coincident_nodes_are_warned_of() {
    let warnings = |gap: f64, tables: &str| {
        let mut mesh = box_mesh([1.0, 1.0, 1.0], 1, Pattern::Alternating).unwrap();
        let (vertices, elements) = (mesh.vertices.clone(), mesh.elements.clone());
        mesh.vertices.extend(vertices.iter().map(|x| x + nalgebra::Vector3::x() * (1.0 + gap)));
        mesh.elements.extend(elements.iter().map(|element| element.map(|node| node + 8)));
        let scene = crate::read(&format!("{LEAST}{tables}"));
        fem_scene::warnings(&scene, &fem_scene::body_of(&scene, mesh, "no data".as_ref()).unwrap())
    };
    let clamp = "[fixed]\nplane = { axis = \"x\", below = 0 }\n";
    let loose = "1 of 2 connected parts have no Dirichlet condition and move freely, the first with node 8";
    let touching = "4 nodes lie at the place of another one, the first are 1 and 8";
    assert!(warnings(0.5, "").is_empty(), "a free body of two parts");
    let found = warnings(0.5, clamp);
    assert!(found.len() == 1 && found[0].contains(loose), "{found:?}");
    let found = warnings(0.0, clamp);
    assert!(found.len() == 2 && found[0].contains(touching) && found[1].contains(loose), "{found:?}");
    let spring = format!("{clamp}[[springs]]\nnodes = [1, 8]\nstiffness = 1.0\n");
    assert!(warnings(0.5, &spring).is_empty(), "a spring connects");
    assert!(warnings(0.5, "[fixed]\non = \"all\"\n").is_empty());
}

#[test]
fn a_set_keeps_its_part_of_the_body_when_the_mesh_is_scaled_and_refined() {
    let folder = tempfile::tempdir().unwrap();
    let mut mesh = box_mesh([1.0, 1.0, 1.0], 2, Pattern::Alternating).unwrap();
    let floor =
        fem_mesh::boundary(&mesh).into_iter().filter(|face| face.iter().all(|&node| mesh.vertices[node].z == 0.0));
    let edge: Vec<usize> =
        (0..27).filter(|&node| mesh.vertices[node].y == 0.0 && mesh.vertices[node].z == 0.0).collect();
    let set = fem_mesh::MeshSet { faces: floor.map(sorted).collect(), ..Default::default() };
    let edges = edge.windows(2).map(|pair| [pair[0], pair[1]]).collect();
    mesh.sets.insert("floor".to_owned(), set);
    mesh.sets.insert("edge".to_owned(), fem_mesh::MeshSet { edges, ..Default::default() });
    write_tetrahedra(&folder.path().join("m.msh"), &mesh).unwrap();
    let refined = "file = \"m.msh\"\nrefine = 2\nscale = 0.1";
    let text = edit(LEAST, "box = { size = [2, 1, 1], cells_per_unit = 1 }", refined);
    let nodes = |set: &str| {
        fs::write(folder.path().join("a.toml"), format!("{text}[fixed]\nset = {set:?}\n")).unwrap();
        let scene = load(folder.path().join("a.toml").to_str().unwrap(), folder.path()).unwrap();
        let body = fem_scene::body(&scene, folder.path()).unwrap();
        (body.fixed_nodes().unwrap().to_vec(), body.shape.mesh.vertices().to_vec())
    };
    let (found, vertices) = nodes("floor");
    assert_eq!(found, (0..vertices.len()).filter(|&node| vertices[node].z == 0.0).collect::<Vec<_>>());
    assert_eq!(found.len(), 81);
    let (found, vertices) = nodes("edge");
    assert_eq!(found.len(), 9);
    assert!(found.iter().all(|&node| vertices[node].y == 0.0 && vertices[node].z == 0.0));
}

fn sorted(mut face: [usize; 3]) -> [usize; 3] {
    face.sort_unstable();
    face
}

#[test]
fn edges_of_the_outline_are_named_by_their_ends_in_any_order() {
    let flat = edit(LEAST, "box = { size = [2, 1, 1]", "rectangle = { size = [2, 1]");
    let flat = edit(&edit(&flat, "\"course\"", "\"engine\""), "C = 1e5\nD = 4e5\n", "young = 1e5\npoisson = 0.3\n");
    let load = |keys: &str| body(&format!("{flat}[[traction]]\n{keys}\npressure = 1.0\n"));
    assert_eq!(load("edges = [[1, 0], [2, 5]]").unwrap().pressures[0].faces, [[0, 1], [2, 5]]);
    let quadratic = edit(&flat, "[mesh]\n", "[mesh]\norder = 2\n");
    let text = format!("{quadratic}[[traction]]\nedges = [[1, 0]]\npressure = 1.0\n");
    assert_eq!(body(&text).unwrap().pressures[0].faces[0].len(), 3, "with the node in its middle");
    for (keys, remedy) in [
        ("edges = [[0, 4]]", "names [0, 4], which is no edge of the outline; correct it"),
        ("edges = []", "traction[0].edges is empty; name an edge of the outline"),
        ("faces = [[0, 1, 4]]", "name them by edges"),
    ] {
        let text = format!("{flat}[[traction]]\n{keys}\npressure = 1.0\n");
        let parsed = fem_scene::parse(&text, "name.toml".as_ref());
        let message = parsed.and_then(|scene| fem_scene::body(&scene, "no data".as_ref())).unwrap_err().to_string();
        assert!(message.contains(remedy), "{message}");
    }
    assert!(refusal("[[traction]]\nedges = [[0, 1]]\npressure = 1.0").contains("name them by faces"));
}

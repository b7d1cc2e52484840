//! From a scene to its body: scale, fixed nodes, the dragged node.

use std::fs;

use fem_mesh::boundary;
use fem_scene::load;
use nalgebra::Vector3;

use crate::{LEAST, body, edit};

#[test]
fn a_body_has_its_mesh_its_boundary_and_only_the_parts_of_its_scene() {
    let body = body(LEAST).unwrap();
    assert_eq!((body.shape.mesh.vertices().len(), body.shape.mesh.elements()), (12, 12));
    assert_eq!(body.shape.boundary, boundary(&body.shape.mesh.mesh().unwrap()));
    assert_eq!((body.fixed_nodes(), body.drag, &body.shape.display), (None, None, &None));
}

#[test]
fn a_scale_multiplies_the_coordinates_of_both_meshes() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("s.obj"), "v 1 0.5 0.25\nv 2 1 1\nv 0 1 0\nf 1 2 3\n").unwrap();
    let text = edit(LEAST, "[mesh]\n", "[mesh]\ndisplay = \"s.obj\"\nscale = 0.01\n");
    fs::write(folder.path().join("a.toml"), text).unwrap();
    let scene = load(folder.path().join("a.toml").to_str().unwrap(), folder.path()).unwrap();
    let scaled = fem_scene::body(&scene, folder.path()).unwrap().shape;
    let plain = body(LEAST).unwrap().shape;
    for (scaled, plain) in scaled.mesh.vertices().iter().zip(plain.mesh.vertices()) {
        assert_eq!(*scaled, plain * 0.01);
    }
    assert_eq!(scaled.mesh.tetrahedra(), plain.mesh.tetrahedra());
    let volume: f64 = scaled.mesh.volumes().iter().sum();
    assert!((volume - 2e-6).abs() < 1e-20, "{volume}");
    assert_eq!(scaled.display.unwrap().vertices[0], Vector3::new(1.0, 0.5, 0.25) * 0.01);
}

/// The nodes of a box of 4 × 1 × 1 cells of ⅓ m that a plane fixes.
fn fixed_by(axis: &str, below: f64) -> Vec<usize> {
    let text = edit(
        LEAST,
        "size = [2, 1, 1], cells_per_unit = 1",
        "size = [1.3333333333333333, 0.3333333333333333, 0.3333333333333333], cells_per_unit = 3",
    );
    body(&format!("{text}[fixed]\nplane = {{ axis = \"{axis}\", below = {below:e} }}\n"))
        .unwrap()
        .fixed_nodes()
        .unwrap()
        .to_vec()
}

#[test]
fn a_plane_fixes_the_nodes_up_to_a_distance_above_the_lowest_and_those_at_it() {
    assert_eq!(fixed_by("x", 0.0), [0, 5, 10, 15]);
    assert_eq!(fixed_by("x", 1e-9), [0, 5, 10, 15]);
    assert_eq!(fixed_by("x", 1.0 / 3.0), [0, 1, 5, 6, 10, 11, 15, 16], "a node exactly at the distance is fixed");
    assert_eq!(fixed_by("x", 0.3333), [0, 5, 10, 15]);
    assert_eq!(fixed_by("y", 0.1), [0, 1, 2, 3, 4, 10, 11, 12, 13, 14]);
    assert_eq!(fixed_by("z", 0.1), [0, 1, 2, 3, 4, 5, 6, 7, 8, 9]);
    assert_eq!(fixed_by("x", 100.0), (0..20).collect::<Vec<_>>());
}

#[test]
fn the_plane_counts_from_the_lowest_node_of_the_scaled_mesh() {
    let folder = tempfile::tempdir().unwrap();
    let nodes = "5 3 0 0\n0 0 -7 0\n1 1 -7 0\n2 0 -6 0\n3 0 -6.9 1\n4 1 -6 1\n";
    fs::write(folder.path().join("m.node"), nodes).unwrap();
    fs::write(folder.path().join("m.ele"), "2 4 0\n0 0 1 2 3\n1 1 2 3 4\n").unwrap();
    let source = "box = { size = [2, 1, 1], cells_per_unit = 1 }";
    let fixed = |scale: f64, below: f64| {
        let plane = format!("[fixed]\nplane = {{ axis = \"y\", below = {below} }}\n");
        let text = edit(LEAST, source, &format!("file = \"m.node\"\nscale = {scale}"));
        fs::write(folder.path().join("a.toml"), text + &plane).unwrap();
        let scene = load(folder.path().join("a.toml").to_str().unwrap(), folder.path()).unwrap();
        fem_scene::body(&scene, folder.path()).unwrap().fixed_nodes().unwrap().to_vec()
    };
    assert_eq!(fixed(1.0, 0.05), [0, 1]);
    assert_eq!(fixed(1.0, 0.2), [0, 1, 3]);
    assert_eq!(fixed(0.1, 0.05), [0, 1, 3], "the distance is in metres, not in units of the file");
}

#[test]
fn listed_nodes_are_sorted_and_counted_once() {
    let fixed =
        |list: &str| body(&format!("{LEAST}[fixed]\nnodes = {list}\n")).unwrap().fixed_nodes().map(<[usize]>::to_vec);
    assert_eq!(fixed("[7, 0, 3, 7, 0]"), Some(vec![0, 3, 7]));
}

#[test]
fn the_highest_vertex_is_the_first_of_largest_y() {
    let drag = "[drag]\nvertex = \"highest\"\nstiffness = 1\ndirection = [0, 1, 0]\namplitude = 1\nfrequency = 1\n";
    // Nodes 3, 4, 5 and 9, 10, 11 of the box have y = 1.
    assert_eq!(body(&format!("{LEAST}{drag}")).unwrap().drag.unwrap().node, 3);
}

#[test]
fn several_files_are_bodies_of_one_scene_and_sets_of_their_names() {
    let folder = tempfile::tempdir().unwrap();
    for (name, shift) in [("left.node", 0.0), ("right.vtu", 3.0)] {
        let mut mesh = fem_mesh::box_mesh([1.0, 1.0, 1.0], 1, fem_mesh::Pattern::Alternating).unwrap();
        mesh.vertices.iter_mut().for_each(|vertex| vertex.x += shift);
        fem_mesh::write_tetrahedra(&folder.path().join(name), &mesh).unwrap();
    }
    let files = edit(LEAST, "box = { size = [2, 1, 1], cells_per_unit = 1 }", "files = [\"left.node\", \"right.vtu\"]");
    let file = folder.path().join("a.toml");
    let read = |text: &str| {
        std::fs::write(&file, text).unwrap();
        fem_scene::load(file.to_str().unwrap(), folder.path()).and_then(|scene| fem_scene::body(&scene, folder.path()))
    };
    let body = read(&format!("{files}[fixed]\nset = \"right\"\n")).unwrap();
    assert_eq!((body.shape.mesh.vertices().len(), body.shape.mesh.elements(), body.shape.boundary.len()), (16, 12, 24));
    assert_eq!(body.fixed_nodes(), Some(&(8..16).collect::<Vec<_>>()[..]));

    let message = |text: &str| read(text).unwrap_err().to_string();
    let beside = edit(&files, "[material]", "file = \"left.node\"\n[material]");
    assert!(message(&beside).contains("mesh.files stands beside `file`; keep one of the two"));
    let empty = edit(&files, "\"left.node\", \"right.vtu\"", "");
    assert!(message(&empty).contains("mesh.files is empty; name a file"));
    let missing = edit(&files, "right.vtu", "wrong.vtu");
    assert!(message(&missing).contains("wrong.vtu"), "{}", message(&missing));
}

#[test]
#[cfg(feature = "pictures")]
fn a_picture_becomes_a_flat_body_with_its_holes_and_its_height() {
    let data = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data");
    let source = "picture = { file = \"pictures/donut.png\", edge = 0.1, height = 2.0 }";
    let text = edit(LEAST, "box = { size = [2, 1, 1], cells_per_unit = 1 }", source);
    let scene = fem_scene::parse(&text, "a.toml".as_ref()).unwrap();
    let mesh = fem_scene::body(&scene, &data).unwrap().shape.mesh;
    assert_eq!(mesh.dimension(), 2);
    let height = mesh.vertices().iter().map(|x| x.y).fold(0.0, f64::max);
    assert!((height - 2.0).abs() < 0.02, "{height}");
    // V - E + T of a ring is 0.
    let edges = (3 * mesh.elements() + mesh.faces().len()) / 2;
    assert_eq!(mesh.vertices().len() + mesh.elements(), edges);

    let missing = text.replace("donut", "no-such");
    let scene = fem_scene::parse(&missing, "a.toml".as_ref()).unwrap();
    let message = fem_scene::body(&scene, &data).unwrap_err().to_string();
    assert!(message.contains("mesh.picture cannot be meshed") && message.contains("no such file"), "{message}");
}

//! The folders in which scenes and their meshes are searched.

use std::fs;
use std::path::Path;

use fem_scene::{SceneError, body, load, names};
use tempfile::TempDir;

use crate::{LEAST, data, edit};

/// A tetrahedron of this edge length, m, as `NAME.node` and `NAME.ele`.
fn write_tetrahedron(folder: &Path, name: &str, edge: f64) {
    fs::create_dir_all(folder).unwrap();
    let nodes = format!("4 3 0 0\n0 0 0 0\n1 {edge} 0 0\n2 0 {edge} 0\n3 0 0 {edge}\n");
    fs::write(folder.join(format!("{name}.node")), nodes).unwrap();
    fs::write(folder.join(format!("{name}.ele")), "1 4 0\n0 0 1 2 3\n").unwrap();
}

fn scene_of(file: &str) -> String {
    edit(LEAST, "box = { size = [2, 1, 1], cells_per_unit = 1 }", &format!("file = '{file}'"))
}

/// A folder `data` with the scenes b and a, and a folder beside it.
fn folders() -> TempDir {
    let root = tempfile::tempdir().unwrap();
    fs::create_dir_all(root.path().join("data/scenes")).unwrap();
    for name in ["b", "a"] {
        fs::write(root.path().join(format!("data/scenes/{name}.toml")), scene_of("m.node")).unwrap();
    }
    fs::write(root.path().join("data/scenes/notes.txt"), "no scene").unwrap();
    root
}

#[test]
fn names_are_those_of_the_toml_files_in_order() {
    let root = folders();
    assert_eq!(names(&root.path().join("data")), ["a", "b"]);
    assert_eq!(names(&root.path().join("nowhere")), [""; 0]);
}

#[test]
fn a_scene_is_loaded_by_name_or_by_path() {
    let root = folders();
    let data = root.path().join("data");
    let by_name = load("a", &data).unwrap();
    assert_eq!((by_name.name.as_str(), by_name.path.clone()), ("a", data.join("scenes/a.toml")));
    let by_path = load(by_name.path.to_str().unwrap(), Path::new("elsewhere")).unwrap();
    assert_eq!(by_path, by_name);
}

#[test]
fn an_unknown_name_is_refused_with_the_known_ones() {
    let root = folders();
    let message = load("c", &root.path().join("data")).unwrap_err().to_string();
    assert_eq!(message, "there is no scene `c`; choose one of a, b, or the path of a .toml file");
    let message = load("c", root.path()).unwrap_err().to_string();
    assert!(message.contains("there are none in "), "{message}");
}

#[test]
fn a_scene_file_that_cannot_be_read_is_named() {
    let root = folders();
    let garbage = root.path().join("garbage.toml");
    fs::write(&garbage, b"\xff\xfe").unwrap();
    for path in [garbage, root.path().join("missing.toml"), root.path().join("data")] {
        let error = load(path.to_str().unwrap(), &data()).unwrap_err();
        assert!(matches!(&error, SceneError::Unreadable { file, .. } if *file == path), "{error:?}");
        assert!(error.to_string().contains("; check the path and that you may read it"), "{error}");
    }
}

#[test]
fn a_mesh_is_searched_beside_the_scene_and_then_in_data() {
    let root = folders();
    let data = root.path().join("data");
    write_tetrahedron(&data, "m", 2.0);
    let scene = load("a", &data).unwrap();
    assert_eq!(body(&scene, &data).unwrap().shape.mesh.vertices()[1].x, 2.0);
    write_tetrahedron(&data.join("scenes"), "m", 1.0);
    assert_eq!(body(&scene, &data).unwrap().shape.mesh.vertices()[1].x, 1.0, "the one beside the scene comes first");
}

#[test]
fn an_absolute_path_of_a_mesh_is_used_as_it_is() {
    let root = folders();
    let data = root.path().join("data");
    write_tetrahedron(&root.path().join("far away"), "m", 3.0);
    let path = root.path().join("far away/m.node");
    fs::write(data.join("scenes/a.toml"), scene_of(path.to_str().unwrap())).unwrap();
    let found = body(&load("a", &data).unwrap(), &data).unwrap();
    assert_eq!(found.shape.mesh.vertices()[1].x, 3.0);
}

#[test]
fn a_display_surface_is_searched_in_the_same_places() {
    let root = folders();
    let data = root.path().join("data");
    write_tetrahedron(&data, "m", 1.0);
    fs::write(data.join("scenes/a.toml"), edit(&scene_of("m.node"), "[mesh]\n", "[mesh]\ndisplay = \"s.obj\"\n"))
        .unwrap();
    let scene = load("a", &data).unwrap();
    let missing = body(&scene, &data).unwrap_err();
    assert!(matches!(&missing, SceneError::Mesh { line: 3, field: "mesh.display", .. }), "{missing:?}");
    fs::write(data.join("s.obj"), "v 0 0 0\nv 0.1 0 0\nv 0 0.1 0\nf 1 2 3\n").unwrap();
    assert_eq!(body(&scene, &data).unwrap().shape.display.unwrap().vertices.len(), 3);
}

#[test]
fn every_shipped_scene_is_found_with_its_meshes() {
    let names = names(&data());
    assert!(names.len() >= 3, "{names:?}");
    for name in names {
        let scene = load(&name, &data()).unwrap();
        // Pictures need a feature, and their files are there.
        if let Some(picture) = &scene.mesh.picture {
            assert!(data().join(&picture.file).is_file(), "{name}");
            continue;
        }
        let body = body(&scene, &data()).unwrap();
        assert_eq!(body.shape.display.is_some(), scene.mesh.display.is_some(), "{name}");
        assert_eq!(body.fixed_nodes().is_some(), scene.fixed.is_some(), "{name}");
        assert_eq!(body.drag.is_some(), scene.drag.is_some(), "{name}");
    }
}

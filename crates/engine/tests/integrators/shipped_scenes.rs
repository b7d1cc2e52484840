//! The engine's scenes in `data`.

use std::path::PathBuf;

use fem_scene::{body, load};

/// The repository's `data`.
pub fn data() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../data")
}

#[test]
fn the_large_armadillo_has_as_many_nodes_and_tetrahedra_as_it_says() {
    let mesh = body(&load("arma-large", &data()).unwrap(), &data()).unwrap().shape.mesh;
    assert_eq!((mesh.vertices.len(), mesh.elements.len()), (21639, 107712));
}

#[test]
fn engine_scenes_that_repeat_one_of_the_course_differ_in_name_and_pipeline_alone() {
    for name in ["arma", "bunny"] {
        let course = load(name, &data()).unwrap();
        let mut engine = load(&format!("{name}-engine"), &data()).unwrap();
        assert_ne!(engine.pipeline, course.pipeline);
        (engine.name, engine.path, engine.about) = (course.name.clone(), course.path.clone(), course.about.clone());
        (engine.pipeline, engine.source) = (course.pipeline, course.source.clone());
        assert_eq!(engine, course);
    }
}

//! Mesh files as people have them, in commands and in scenes.

use fem_mesh::{Pattern, box_mesh, read_tetrahedra, volumes, write_tetrahedra};

use crate::program::Desk;

/// A file of `crates/mesh/tests/mesh/other_programs/untidy`.
fn untidy(name: &str) -> String {
    format!("{}/crates/mesh/tests/mesh/other_programs/untidy/{name}", env!("CARGO_MANIFEST_DIR"))
}

#[test]
fn nodes_of_no_element_are_told_once_by_commands_and_by_scenes() {
    let desk = Desk::new();
    let file = untidy("orphan_gmsh_arc_centre_4.1.msh");
    for command in
        [format!("mesh info {file}"), format!("mesh convert {file} a.msh"), format!("mesh improve {file} b.msh")]
    {
        let outcome = desk.run(&command);
        assert_eq!(outcome.code, Some(0), "{outcome:?}");
        let expected = format!("note: {file}: 2 nodes belong to no element and are left out\n");
        assert_eq!(outcome.stderr, expected, "{command}");
    }
    desk.run_well("mesh info a.msh");
    desk.write(
        "s.toml",
        format!(
            "pipeline = \"engine\"\n[mesh]\nfile = \"{file}\"\n[material]\nmodel = \"neo_hookean\"\nyoung = 1e5\npoisson = 0.3\n\
             density = 1000.0\n[gravity]\nacceleration = [0, -9.81, 0]\n[fixed]\nplane = {{ axis = \"z\", below = 0.1 }}\n[time]\n\
             integrator = \"linearly_implicit_euler\"\ndt = 0.01\n"
        ),
    );
    let outcome = desk.run("s.toml --headless --steps 1");
    assert_eq!(outcome.code, Some(0), "{outcome:?}");
    let expected = format!("s.toml: mesh {file}: 2 nodes belong to no element and are left out\n");
    assert!(outcome.stderr.contains(&expected) && outcome.stderr.lines().count() == 1, "{outcome:?}");
}

#[test]
fn conversion_turns_elements_and_leaves_out_faulty_ones_if_asked_to() {
    let desk = Desk::new();
    let mut mesh = box_mesh([2.0, 1.0, 1.0], 1, Pattern::Alternating).unwrap();
    [3, 7].into_iter().for_each(|element| mesh.elements[element].swap(0, 1));
    write_tetrahedra(&desk.path("mixed.vtu"), &mesh).unwrap();
    let message = desk.refused("mesh convert mixed.vtu m.msh");
    assert!(
        message.contains("element 3 (counted from 0) has the negative volume")
            && message.contains("the first of 2 such elements; turn them by `mesh convert --orient`"),
        "{message}"
    );
    let outcome = desk.run("mesh convert mixed.vtu m.msh --orient");
    assert_eq!(outcome.stderr, "note: mixed.vtu: 2 elements are turned\n", "{outcome:?}");
    assert!((volumes(&read_tetrahedra(&desk.path("m.msh")).unwrap()).iter().sum::<f64>() - 2.0).abs() < 1e-12);
    mesh.elements.push(mesh.elements[0]);
    mesh.elements.push([0, 1, 1, 2]);
    write_tetrahedra(&desk.path("faulty.vtu"), &mesh).unwrap();
    assert!(desk.refused("mesh convert faulty.vtu m.msh --orient").contains("`mesh convert --clean`"));
    let text = desk.run("mesh convert faulty.vtu m.msh --orient --clean").stderr;
    assert!(
        text.contains("1 elements without a size are left out") && text.contains("1 elements that repeat"),
        "{text}"
    );
    assert_eq!(read_tetrahedra(&desk.path("m.msh")).unwrap().elements.len(), 12);
}

#[test]
fn bodies_that_overlap_are_told_with_their_names_and_the_place() {
    let desk = Desk::new();
    let mut mesh = box_mesh([1.0, 1.0, 1.0], 2, Pattern::Alternating).unwrap();
    write_tetrahedra(&desk.path("lower.node"), &mesh).unwrap();
    mesh.vertices.iter_mut().for_each(|x| x.y += 0.75);
    write_tetrahedra(&desk.path("upper.msh"), &mesh).unwrap();
    mesh.vertices.iter_mut().for_each(|x| x.y += 0.25);
    write_tetrahedra(&desk.path("above.msh"), &mesh).unwrap();
    let run = |second: &str| {
        desk.write(
            "s.toml",
            format!(
                "pipeline = \"engine\"\n[mesh]\nfiles = [\"lower.node\", \"{second}\"]\n[material]\nmodel = \"neo_hookean\"\nyoung = 1e5\n\
                 poisson = 0.3\ndensity = 1000.0\n[fixed]\non = \"all\"\n[time]\nintegrator = \"linearly_implicit_euler\"\ndt = 0.01\n"
            ),
        );
        desk.run("s.toml --headless --steps 1").stderr
    };
    let text = run("upper.msh");
    let expected = "mesh.files: the bodies \"lower\" and \"upper\" overlap, from (0.0000, 0.7500, 0.0000) to (1.0000, 1.0000, 1.0000) m";
    assert!(text.contains(expected), "{text}");
    assert!(!run("above.msh").contains("overlap"), "faces that touch are no overlap");
}

#[test]
fn a_picture_without_a_transparent_pixel_is_told() {
    let desk = Desk::new();
    let picture = untidy("alpha254.png");
    let outcome = desk.run(&format!("mesh from-picture {picture} a.vtu --edge 0.2"));
    assert_eq!(outcome.code, Some(0), "{outcome:?}");
    let expected =
        "no pixel lies outside of the region, whose least opacity is 254 of 255, so nothing is cut out of the picture";
    assert!(outcome.stderr.contains(expected), "{outcome:?}");
}

//! Bad input of the commands that make meshes: exit code 2, one message with the file and the remedy, and no file.

use crate::program::{Desk, assert_names, data};

/// A picture of the mesh library's tests.
fn sample(name: &str) -> String {
    data().join("../crates/mesh/tests/pictures").join(name).display().to_string()
}

/// Files that every command below may be given, and a desk with them.
fn desk() -> Desk {
    let desk = Desk::with("good.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
    desk.write("nan.obj", "v 0 0 0\nv 1 0 nan\nv 0 1 0\nf 1 2 3\n");
    desk.write("good.node", "4 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n");
    desk.write("good.ele", "1 4 0\n0 0 1 2 3\n");
    desk.write("good.csv", "0,0,0\n1,0,0\n0,1,0\n0,0,1\n");
    for name in ["folder.png/x", "folder.obj/x", "folder.msh/x", "folder.csv/x"] {
        desk.write(name, "");
    }
    desk.write("text.png", "no picture");
    desk
}

fn assert_refused(command: &str, parts: &[&str]) {
    let desk = desk();
    let message = desk.refused(command);
    assert_eq!(message.lines().count(), 1, "{command}: {message}");
    assert_names(&message, parts);
    assert!(!desk.path("out.vtu").exists(), "{command}");
}

#[test]
fn pictures_without_a_region_and_files_that_are_none_are_refused() {
    let cases: [(&str, &[&str]); 6] = [
        (&sample("transparent.png"), &["transparent.png: the picture has no region", "check the picture"]),
        (&sample("one_colour.png"), &["one_colour.png: all pixels have one colour", "a light background"]),
        ("text.png", &["text.png: is neither a PNG nor a JPEG file; convert it"]),
        ("good.obj", &["good.obj: is neither a PNG nor a JPEG file; convert it"]),
        ("missing.png", &["missing.png: there is no such file; check the path"]),
        ("folder.png", &["folder.png: cannot be read", "check that it is a file"]),
    ];
    for (picture, parts) in cases {
        assert_refused(&format!("mesh from-picture {picture} out.vtu --edge 0.1"), parts);
    }
}

#[test]
fn lengths_that_do_not_fit_a_picture_are_refused_before_memory_is_taken() {
    let donut = data().join("pictures/donut.png").display().to_string();
    for (lengths, part) in [
        ("--edge 2", "donut.png: an edge of 2 m is longer than the region"),
        (
            "--edge 1e-5",
            "donut.png: with edges of 0.00001 m the region would have 1.5e10 triangles, and 1e8 is the most",
        ),
        ("--edge 1e-300", "take longer edges"),
        ("--edge 0", "donut.png: an edge of 0 m; give a length above 0"),
        ("--edge nan", "donut.png: an edge of NaN m; give a length above 0"),
        ("--edge 0.1 --height -1", "donut.png: a height of -1 m; give a length above 0"),
        ("--edge 0.1 --height inf", "donut.png: a height of inf m; give a length above 0"),
    ] {
        assert_refused(&format!("mesh from-picture {donut} out.vtu {lengths}"), &[part]);
    }
}

#[test]
fn a_line_one_pixel_wide_has_triangles() {
    let desk = Desk::new();
    let outcome = desk.run(&format!("mesh from-picture {} out.vtu --edge 0.5", sample("line.png")));
    assert_eq!(outcome.code, Some(0), "{outcome:?}");
    assert!(outcome.stdout.starts_with("out.vtu: ") && desk.path("out.vtu").exists(), "{outcome:?}");
}

#[test]
fn surfaces_that_cannot_be_filled_are_refused() {
    let cases: [(&str, &[&str]); 9] = [
        ("missing.obj out.vtu --edge 0.1", &["missing.obj: there is no such file; check the path"]),
        ("folder.obj out.vtu --edge 0.1", &["folder.obj: cannot be read", "check that it is a file"]),
        ("text.png out.vtu --edge 0.1", &["text.png: the extension `.png` is unknown here; use one of .obj"]),
        ("nan.obj out.vtu --edge 0.1", &["nan.obj, line 2: the coordinate `nan` is not finite"]),
        (
            "good.obj out.vtu --edge 40",
            &["good.obj: ", "no point of the lattice lies inside the surface; take shorter edges"],
        ),
        ("good.obj out.vtu --edge 1e-4", &["good.obj: ", "tetrahedra, and 1e8 is the most; take longer edges"]),
        ("good.obj out.vtu --edge 1e-300", &["good.obj: ", "tetrahedra, and 1e8 is the most; take longer edges"]),
        ("good.obj out.vtu --edge inf", &["good.obj: ", "an edge of inf m; give a length above 0"]),
        ("good.obj out.vtu --edge 1e-4 --cage", &["good.obj: ", "tetrahedra, and 1e8 is the most; take longer edges"]),
    ];
    for (arguments, parts) in cases {
        assert_refused(&format!("mesh from-surface {arguments}"), parts);
    }
}

#[test]
fn meshes_and_points_that_cannot_be_used_are_refused() {
    let cases: [(&str, &[&str]); 9] = [
        ("improve missing.msh out.vtu", &["missing.msh: there is no such file; check the path"]),
        ("improve folder.msh out.vtu", &["folder.msh: cannot be read", "check that it is a file"]),
        ("improve text.png out.vtu", &["text.png: the extension `.png` is unknown here; use one of"]),
        ("improve nan.obj out.vtu", &["nan.obj, line 2: the coordinate `nan` is not finite"]),
        ("improve good.obj out.vtu", &["good.obj: "]),
        ("improve good.node out.vtu --iterations=-1", &["--iterations"]),
        ("delaunay missing.csv out.vtu", &["missing.csv: there is no such file; check the path"]),
        ("delaunay folder.csv out.vtu", &["folder.csv: cannot be read", "check that it is a file"]),
        ("delaunay text.png out.vtu", &["text.png: the extension `.png` is unknown here; use one of"]),
    ];
    for (arguments, parts) in cases {
        let message = desk().refused(&format!("mesh {arguments}"));
        assert_names(&message, parts);
    }
    desk().run_well("mesh improve good.node out.vtu --iterations 18446744073709551615");
}

#[test]
fn an_unusable_output_is_refused_before_the_input_is_meshed() {
    let donut = data().join("pictures/donut.png").display().to_string();
    // Edges so short that the meshing itself would be refused, had it begun.
    let commands = [
        format!("from-picture {donut} OUT --edge 1e-9"),
        "from-surface good.obj OUT --edge 1e-9".to_owned(),
        "improve good.node OUT".to_owned(),
        "delaunay good.csv OUT".to_owned(),
    ];
    for command in &commands {
        for (out, parts) in [
            ("no/such/out.vtu", ["no/such/out.vtu: cannot be written", "its folder does not exist"]),
            ("folder.msh", ["folder.msh: cannot be written", "it is a folder"]),
            ("out.dae", ["out.dae: the extension `.dae` is unknown here", "use one of"]),
        ] {
            assert_refused(&format!("mesh {}", command.replace("OUT", out)), &parts);
        }
    }
    let triangles = ["out.obj: a mesh of tetrahedra in a .obj file", "write it as .node"];
    commands[1..]
        .iter()
        .for_each(|command| assert_refused(&format!("mesh {}", command.replace("OUT", "out.obj")), &triangles));
}

//! `mesh info` and `mesh convert`.

use fem_mesh::{
    MeshSet, Pattern, SurfaceMesh, TetrahedralMesh, boundary, box_mesh, read_surface, read_tetrahedra, surface_quality,
    volumes, write_surface, write_tetrahedra,
};

use crate::program::{Desk, data};

#[test]
fn info_prints_the_numbers_of_vertices_and_tetrahedra_and_the_volume() {
    let path = data().join("stanford/bunny_coarse.node");
    let mesh = read_tetrahedra(&path).unwrap();
    let text = Desk::new().run_well(&format!("mesh info {}", path.display())).stdout;
    let value = |label: &str| {
        let line = text.lines().find(|line| line.starts_with(label)).unwrap_or_else(|| panic!("{label}:\n{text}"));
        line.split_whitespace().last().unwrap().parse::<f64>().unwrap()
    };
    assert_eq!(value("vertices"), mesh.vertices.len() as f64);
    assert_eq!(value("tetrahedra"), mesh.elements.len() as f64);
    let volume: f64 = volumes(&mesh).iter().sum();
    assert!((value("volume") - volume).abs() <= 1e-6 * volume);
    assert!(!text.ends_with("\n\n"), "an empty line at the end");
}

#[test]
fn a_mesh_is_the_same_after_conversion_through_every_format() {
    let desk = Desk::new();
    let original = data().join("own/armadillo_own_coarse.node");
    let mut from = original.display().to_string();
    for to in ["a.mesh", "a.msh", "a.vtu", "a.node", "b.ele"] {
        let text = desk.run_well(&format!("mesh convert {from} {to}")).stdout;
        assert_eq!(text, format!("{to}: 220 nodes, 602 tetrahedra\n"));
        from = to.to_owned();
    }
    let expected = read_tetrahedra(&original).unwrap();
    for name in ["a.mesh", "a.msh", "a.vtu", "a.node", "b.node"] {
        assert_eq!(read_tetrahedra(&desk.path(name)).unwrap(), expected, "{name}");
    }
}

#[test]
fn triangles_in_a_file_of_meshes_are_a_surface() {
    let desk = Desk::new();
    desk.write("square.csv", "0,0\n2,0\n2,1\n0,1\n0.7,0.3\n");
    desk.run_well("mesh delaunay square.csv a.vtu");
    let mut from = "a.vtu".to_owned();
    for to in ["b.node", "c.mesh", "d.msh", "e.vtk", "f.ply", "g.ele", "h.obj", "i.vtu.gz", "j.stl"] {
        assert_eq!(desk.run_well(&format!("mesh convert {from} {to}")).stdout, format!("{to}: 5 nodes, 4 triangles\n"));
        from = to.to_owned();
    }
    let text = desk.run_well("mesh info i.vtu.gz").stdout;
    assert!(text.contains("area, m²") && text.contains("2.000000e0"), "{text}");
    assert_eq!(read_surface(&desk.path("a.vtu")).unwrap(), read_surface(&desk.path("i.vtu.gz")).unwrap());
}

/// A box whose file names a side and the whole body.
fn box_with_sets() -> TetrahedralMesh {
    let mut mesh = box_mesh([2.0, 1.0, 1.0], 1, Pattern::Alternating).unwrap();
    let side = boundary(&mesh).into_iter().filter(|face| face.iter().all(|&node| mesh.vertices[node].x == 0.0));
    let mut faces: Vec<[usize; 3]> = side.collect();
    faces.iter_mut().for_each(|face| face.sort_unstable());
    faces.sort_unstable();
    mesh.sets.insert("left".to_owned(), MeshSet { faces, ..MeshSet::default() });
    mesh.sets.insert("body".to_owned(), MeshSet { elements: (0..12).collect(), ..MeshSet::default() });
    mesh
}

#[test]
fn info_prints_named_sets_and_connectivity() {
    let desk = Desk::new();
    let mut mesh = box_with_sets();
    write_tetrahedra(&desk.path("m.msh.gz"), &mesh).unwrap();
    let text = desk.run_well("mesh info m.msh.gz").stdout;
    let lines = ["set \"left\": 2 triangles, 4 nodes", "set \"body\": 12 tetrahedra, 12 nodes"];
    assert!(lines.iter().all(|line| text.lines().any(|found| found == *line)), "{text}");
    let value = |text: &str, label: &str| {
        let line = text.lines().find(|line| line.starts_with(label)).unwrap_or_else(|| panic!("{label}:\n{text}"));
        line[label.len()..].trim().to_owned()
    };
    let counts = ["connected parts", "coincident nodes", "duplicate elements"];
    assert_eq!(counts.map(|label| value(&text, label)), ["1", "0", "0"]);

    let (vertices, elements) = (mesh.vertices.clone(), mesh.elements.clone());
    mesh.vertices.extend(vertices.iter().map(|x| x + nalgebra::Vector3::x() * 2.0));
    mesh.elements.extend(elements.iter().map(|element| element.map(|node| node + 12)));
    write_tetrahedra(&desk.path("two.vtu"), &mesh).unwrap();
    let text = desk.run_well("mesh info two.vtu").stdout;
    assert_eq!(counts.map(|label| value(&text, label)), ["2", "4 (the first: 2 and 12)", "0"]);
    mesh.elements.push(mesh.elements[3]);
    write_tetrahedra(&desk.path("repeated.vtu"), &mesh).unwrap();
    let message = desk.refused("mesh info repeated.vtu");
    assert!(message.contains("element 24 (counted from 0) has the same vertices as element 3"), "{message}");
}

#[test]
fn a_conversion_keeps_sets_and_warns_where_they_are_lost() {
    let desk = Desk::new();
    write_tetrahedra(&desk.path("m.msh"), &box_with_sets()).unwrap();
    for name in ["n.msh.gz", "n.vtu", "n.vtk", "n.inp", "n.mesh", "n.node"] {
        desk.run_well(&format!("mesh convert m.msh {name}"));
        assert_eq!(read_tetrahedra(&desk.path(name)).unwrap(), box_with_sets(), "{name}");
    }
    desk.write("plate.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\ng a\nf 1 2 3\ng b\nf 2 4 3\n");
    let outcome = desk.run("mesh convert plate.obj plate.ply");
    assert_eq!(outcome.code, Some(0));
    let warning = "warning: plate.ply: this format has no sets, and the mesh 2; .msh, .vtu and .vtk keep all\n";
    assert_eq!(outcome.stderr, warning);
}

#[test]
fn points_in_the_plane_become_triangles_and_points_in_space_tetrahedra() {
    let desk = Desk::new();
    desk.write("square.csv", "x,y\n0,0\n1,0\n1,1\n0,1\n0.5,0.5\n1,1\n");
    let text = desk.run_well("mesh delaunay square.csv square.ply").stdout;
    assert_eq!(
        text,
        "square.ply: 5 nodes, 4 triangles\n1 points are at the place of an earlier one and share its node\n"
    );
    let text = desk.run_well("mesh info square.ply").stdout;
    assert!(text.lines().any(|line| line.starts_with("open edges") && line.ends_with(" 4")), "{text}");
    desk.write("cube.csv", "0;0;0\n1;0;0\n0;1;0\n1;1;0\n0;0;1\n1;0;1\n0;1;1\n1;1;1\n0.5;0.5;0.5\n");
    assert_eq!(desk.run_well("mesh delaunay cube.csv cube.vtu").stdout, "cube.vtu: 9 nodes, 12 tetrahedra\n");
    let volume: f64 = volumes(&read_tetrahedra(&desk.path("cube.vtu")).unwrap()).iter().sum();
    assert!((volume - 1.0).abs() < 1e-14);
    desk.run_well("mesh delaunay cube.csv cube.node");
    assert_eq!(desk.run_well("mesh delaunay cube.node again.node").stdout, "again.node: 9 nodes, 12 tetrahedra\n");
}

#[test]
fn points_without_a_mesh_are_refused_with_the_file_and_the_remedy() {
    let desk = Desk::new();
    for (text, part) in [
        ("0,0\n1,1\n2,2\n", "p.csv: all 3 points lie on one line; add a point outside of it"),
        ("0,0,0\n1,0,0\n0,1,0\n5,5,0\n", "p.csv: all 4 points lie in one plane"),
        ("x,y\n", "p.csv: the mesh has no points"),
        ("0,0\n1,nan\n", "p.csv, line 2: the coordinate `nan` is not finite"),
        ("0,0\n1\n", "p.csv, line 2: a coordinate, which is a number is missing here"),
        (
            "0,0\n1,2,3\n",
            "p.csv, line 2: `3` stands after as many numbers as the first line has, where the row should end",
        ),
        ("1\n2\n", "p.csv: a file with 1 coordinates for each point is not supported; give two or three"),
    ] {
        desk.write("p.csv", text);
        let message = desk.refused("mesh delaunay p.csv out.vtu");
        assert!(message.contains(part), "{message}");
    }
}

#[test]
fn a_surface_is_converted_and_measured() {
    let desk = Desk::new();
    let bunny = data().join("stanford/bunny_10k.obj");
    desk.run_well(&format!("mesh convert {} bunny.ply.gz", bunny.display()));
    let of = |file: &str| desk.run_well(&format!("mesh info {file}")).stdout;
    assert_eq!(of("bunny.ply.gz"), of(&bunny.display().to_string()));
    assert!(desk.refused("mesh convert bunny.ply.gz bunny.dae").contains("use one of .obj"));
    assert!(desk.refused("mesh convert bunny.ply.gz bunny.node").contains("outside of the plane z = 0"));
}

#[test]
fn tetrahedra_are_made_inside_a_surface_by_a_command_and_by_a_scene() {
    let desk = Desk::new();
    let bunny = data().join("stanford/bunny_10k.obj");
    let text = desk.run_well(&format!("mesh from-surface {} bunny.vtu --edge 0.08", bunny.display())).stdout;
    let mesh = read_tetrahedra(&desk.path("bunny.vtu")).unwrap();
    assert_eq!(text, format!("bunny.vtu: {} nodes, {} tetrahedra\n", mesh.vertices.len(), mesh.elements.len()));
    let enclosed = surface_quality(&read_surface(&bunny).unwrap()).volume;
    let volume: f64 = volumes(&mesh).iter().sum();
    assert!((volume / enclosed - 1.0).abs() < 0.07, "{volume} {enclosed}");
    let body = "[material]\nmodel = \"neo_hookean\"\nyoung = 1e5\npoisson = 0.3\ndensity = 1000.0\n[gravity]\n\
                acceleration = [0, -9.81, 0]\n[fixed]\nplane = { axis = \"y\", below = 0.1 }\n[time]\nintegrator = \"static\"\n";
    let scene = |edge: f64| {
        format!("pipeline = \"engine\"\n[mesh]\nsurface = {{ file = \"{}\", edge = {edge} }}\n{body}", bunny.display())
    };
    desk.write("s.toml", scene(0.08));
    let text = desk.run_well("s.toml --headless --steps 1 --stats s.json").stdout;
    assert!(text.contains("reaction force of fixed"), "{text}");
    let reaction = desk.json("s.json")["reactions"]["fixed"][1].as_f64().unwrap();
    assert!((reaction / (9.81 * 1000.0 * volume) - 1.0).abs() < 1e-6, "{reaction}");
    desk.write("s.toml", scene(0.08).replace("edge = 0.08", "edge = 0.04, grading = 2, improve = 1"));
    desk.run_well("s.toml --headless --steps 1");
    desk.write("s.toml", scene(1e-5));
    assert!(desk.refused("s.toml --headless").contains("take longer edges"));
    desk.write("s.toml", scene(0.08).replace("surface", "box = { size = [1, 1, 1], cells_per_unit = 1 }\nsurface"));
    assert!(desk.refused("s.toml --headless").contains("mesh.surface stands beside `box`; keep one of the two"));
}

#[test]
fn improvement_keeps_the_body_and_raises_its_worst_element() {
    let desk = Desk::new();
    let bunny = data().join("stanford/bunny_10k.obj");
    desk.run_well(&format!("mesh from-surface {} raw.msh --edge 0.08", bunny.display()));
    let text = desk.run_well("mesh improve raw.msh improved.msh --iterations 4").stdout;
    assert!(text.contains("smallest dihedral angle") && text.contains("improved.msh: "), "{text}");
    desk.run_well(&format!("mesh from-surface {} slid.msh --edge 0.08 --improve 4", bunny.display()));
    let [raw, improved, slid] = ["raw", "improved", "slid"].map(|name| {
        let mesh = read_tetrahedra(&desk.path(&format!("{name}.msh"))).unwrap();
        let quality = fem_mesh::quality(&mesh);
        (quality.volume, quality.dihedral_angles[0].value, quality.radius_ratio.value)
    });
    assert!((improved.0 / raw.0 - 1.0).abs() < 1e-12, "{raw:?} {improved:?}");
    assert!((slid.0 / raw.0 - 1.0).abs() < 0.01, "{raw:?} {slid:?}");
    assert!(improved.1 > raw.1 && improved.2 > raw.2, "{raw:?} {improved:?}");
    assert!(slid.1 > improved.1 && slid.2 > raw.2, "{improved:?} {slid:?}");
    let count = |name: &str| read_tetrahedra(&desk.path(name)).unwrap().elements.len();
    desk.run_well(&format!("mesh from-surface {} fine.msh --edge 0.03", bunny.display()));
    desk.run_well(&format!("mesh from-surface {} graded.msh --edge 0.03 --grading 3", bunny.display()));
    assert!(4 * count("graded.msh") < 3 * count("fine.msh"), "{} {}", count("graded.msh"), count("fine.msh"));
    let solid = box_mesh([1.0, 1.0, 1.0], 1, Pattern::Alternating).unwrap();
    let surface = SurfaceMesh::new(solid.vertices.clone(), boundary(&solid));
    write_surface(&desk.path("cube.stl"), &surface).unwrap();
    let text = desk.run_well("mesh from-surface cube.stl cube.vtu --edge 0.17 --features 40").stdout;
    assert!(text.contains("feature lines: 12.000000 m, of which the mesh keeps 12.000000 m"), "{text}");
    assert!(desk.refused("mesh from-surface cube.stl c.vtu --edge 0.2 --features nan").contains("such as 40"));
    assert!(desk.refused("mesh improve missing.msh out.msh").contains("there is no such file"));
}

#[test]
fn an_open_surface_is_filled_with_a_warning() {
    let desk = Desk::new();
    let mut surface = read_surface(&data().join("stanford/bunny_10k.obj")).unwrap();
    surface.elements.truncate(surface.elements.len() - 30);
    write_surface(&desk.path("open.stl"), &surface).unwrap();
    let outcome = desk.run("mesh from-surface open.stl b.msh --edge 0.15");
    assert!(outcome.code == Some(0) && outcome.stderr.contains("open edges"), "{}", outcome.stderr);
    let outcome = desk.run("mesh from-surface open.stl b.msh --edge 0.1");
    assert!(outcome.stderr.contains("the mesh has 2 connected parts and the surface 1"), "{}", outcome.stderr);
    assert!(desk.refused("mesh from-surface open.stl b.msh --edge 0").contains("give a length above 0"));
    assert!(desk.refused("mesh from-surface open.stl b.msh --edge 1e-4").contains("is the most; take longer edges"));
}

#[test]
fn a_picture_becomes_triangles_that_improve_reads_again() {
    let desk = Desk::new();
    let picture = data().join("pictures/donut.png");
    let text = desk.run_well(&format!("mesh from-picture {} a.vtu --edge 0.1 --height 2", picture.display())).stdout;
    assert!(text.contains("worst circumradius / edge") && text.starts_with("a.vtu: "), "{text}");
    let found = surface_quality(&read_surface(&desk.path("a.vtu")).unwrap());
    let area = std::f64::consts::PI * (1.0 - (48.0_f64 / 112.0).powi(2));
    assert!((found.area / area - 1.0).abs() < 0.005 && found.euler_characteristic == 0, "{found}");
    let text = desk.run_well("mesh improve a.vtu b.vtu --iterations 3").stdout;
    assert!(text.contains("smallest angle"), "{text}");
    let refused = |arguments: &str, word: &str| {
        let text = desk.refused(&format!("mesh from-picture {} b.vtu {arguments}", picture.display()));
        assert!(text.contains("donut.png") && text.contains(word), "{text}");
    };
    refused("--edge -1", "above 0");
    refused("--edge 3", "longer than the region");
    refused("--edge 1e-6", "take longer edges");
    assert!(desk.refused("mesh from-picture a.vtu b.vtu --edge 0.1").contains("neither a PNG nor a JPEG"));
}

#[test]
fn bad_files_and_paths_are_refused_with_the_remedy() {
    let desk = Desk::new();
    desk.write("empty.obj", "");
    desk.write("point.obj", "v 0 0 0\n");
    desk.write("nan.obj", "v 0 0 0\nv 1 0 nan\nv 0 1 0\nf 1 2 3\n");
    desk.write("folder.obj/x", "");
    desk.write("good.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
    let cases: [(&str, &[&str]); 13] = [
        ("mesh info empty.obj", &["empty.obj: the mesh has no faces; give one that has some"]),
        ("mesh info point.obj", &["point.obj: the mesh has no faces"]),
        ("mesh info nan.obj", &["nan.obj, line 2: the coordinate `nan` is not finite; give the vertex a finite"]),
        ("mesh info folder.obj", &["folder.obj: cannot be read", "check that it is a file"]),
        ("mesh info missing.msh", &["missing.msh: there is no such file; check the path"]),
        ("mesh info /dev/null", &["/dev/null: the extension `.` is unknown here; use one of"]),
        ("mesh convert good.obj good.dae", &["good.dae: the extension `.dae` is unknown here; use one of"]),
        (
            "mesh convert good.obj no/such/folder.ply",
            &["no/such/folder.ply: cannot be written", "check that the folder"],
        ),
        ("mesh convert good.obj folder.obj", &["folder.obj: cannot be written"]),
        (
            "mesh from-surface good.obj out.vtu --edge 0.0001",
            &["good.obj: ", "9.1e12 tetrahedra, and 1e8 is the most; take longer edges"],
        ),
        ("mesh from-surface good.obj out.vtu --edge nan", &["edge"]),
        ("mesh from-surface good.obj out.vtu --edge -1", &["edge"]),
        ("mesh from-surface nan.obj out.vtu --edge 0.1", &["nan.obj, line 2"]),
    ];
    for (command, parts) in cases {
        let message = desk.refused(command);
        assert!(parts.iter().all(|part| message.contains(part)), "{command}: {message}");
    }
    assert!(!desk.path("out.vtu").exists());
    // The input is read whole before the output has its name, so both may be one file.
    desk.run_well("mesh convert good.obj good.obj");
    assert_eq!(read_surface(&desk.path("good.obj")).unwrap().elements.len(), 4);
}

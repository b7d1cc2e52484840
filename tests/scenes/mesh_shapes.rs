//! `mesh info` of shapes and crossings, and cages.

use fem_mesh::read_surface;

use crate::program::{Desk, data};

#[test]
fn info_prints_distributions_and_the_boundary_and_draws_them() {
    let desk = Desk::new();
    let path = data().join("own/armadillo_own_coarse.node");
    let text = desk.run_well(&format!("mesh info {} --picture a.svg", path.display())).stdout;
    for line in [
        "boundary: closed                   yes",
        "boundary: manifold                 yes",
        "self-intersections                   0",
    ] {
        assert!(text.lines().any(|found| found == line), "{line}\n{text}");
    }
    for title in [
        "dihedral angle, °",
        "radius ratio",
        "aspect ratio",
        "circumradius / shortest edge",
        "volume ratio of neighbours",
    ] {
        assert!(text.lines().any(|found| found == title), "{title}\n{text}");
    }
    // The bins of a histogram hold all values: six angles of each of 602 tetrahedra.
    let bins = text.lines().skip_while(|line| *line != "dihedral angle, °").skip(1).take_while(|line| !line.is_empty());
    let count = |line: &str| line.split_whitespace().nth(3).unwrap().parse::<usize>().unwrap();
    assert_eq!(bins.map(count).sum::<usize>(), 6 * 602);
    let picture = std::fs::read_to_string(desk.path("a.svg")).unwrap();
    assert!(picture.matches("<polygon").count() > 150 && picture.contains(">radius ratio<"));
    assert!(desk.refused(&format!("mesh info {} --picture a.png", path.display())).contains("use one of .svg"));
}

#[test]
fn info_prints_the_condition_number_of_the_stiffness_which_slivers_raise() {
    let desk = Desk::new();
    // Points on a grid that are moved a little: their Delaunay tetrahedra have slivers.
    let shift = |k: usize| 0.01 * (k as f64 * 12.9898).sin();
    let row = |i: usize| {
        format!(
            "{},{},{}\n",
            (i % 5) as f64 + shift(3 * i),
            (i / 5 % 5) as f64 + shift(3 * i + 1),
            (i / 25) as f64 + shift(3 * i + 2)
        )
    };
    desk.write("points.csv", (0..125).map(row).collect::<String>());
    desk.run_well("mesh delaunay points.csv slivers.msh");
    desk.run_well("mesh improve slivers.msh improved.msh");
    let number = |file: &str| {
        let text = desk.run_well(&format!("mesh info {file} --stiffness")).stdout;
        let line = text.lines().find(|line| line.starts_with("condition number")).unwrap_or_else(|| panic!("{text}"));
        line.split_whitespace().last().unwrap().parse::<f64>().unwrap()
    };
    let (before, after) = (number("slivers.msh"), number("improved.msh"));
    assert!(after > 10.0 && before > 1.5 * after, "{before} {after}");
    desk.write("s.obj", "v 0 0 0\nv 2 0 0\nv 0 2 0\nf 1 2 3\n");
    assert!(desk.refused("mesh info s.obj --stiffness").contains("--stiffness: s.obj has no tetrahedra"));
}

#[test]
fn info_counts_crossing_triangles_of_a_surface() {
    let desk = Desk::new();
    desk.write("s.obj", "v 0 0 0\nv 2 0 0\nv 0 2 0\nv 0.5 0.5 -1\nv 0.5 0.5 1\nv 3 3 0\nf 1 2 3\nf 4 5 6\n");
    let text = desk.run_well("mesh info s.obj").stdout;
    assert!(text.contains("self-intersections        1 (the first: triangles 0 and 1)"), "{text}");
}

#[test]
fn a_cage_carries_its_display_surface_in_a_scene_of_the_course() {
    let desk = Desk::new();
    let surface = data().join("own/armadillo_own_37k.obj");
    desk.run_well(&format!("mesh from-surface {} cage.node --edge 0.2 --cage", surface.display()));
    let scene = format!(
        "pipeline = \"course\"\n[mesh]\nfile = \"cage.node\"\ndisplay = \"{}\"\n[material]\nmodel = \"neo_hookean\"\n\
         C = 1e5\nD = 4e5\ndensity = 1000.0\n[gravity]\nacceleration = [0, -9.81, 0]\n[fixed]\n\
         plane = {{ axis = \"y\", below = 0.1 }}\n[time]\ndt = 0.01\nintegrator = \"linearly_implicit_euler\"\n",
        surface.display()
    );
    desk.write("cage.toml", scene);
    let outcome = desk.run("cage.toml --headless --steps 2 --export posed.obj");
    assert_eq!(outcome.code, Some(0), "{outcome:?}");
    assert!(!outcome.stderr.contains("outside"), "{outcome:?}");
    let [rest, posed] = [surface, desk.path("posed.obj")].map(|file| read_surface(&file).unwrap());
    assert_eq!(posed.elements, rest.elements);
    let moved = rest.vertices.iter().zip(&posed.vertices).map(|(a, b)| (a - b).norm()).fold(0.0, f64::max);
    assert!(moved > 1e-6 && moved < 0.1, "{moved}");
}

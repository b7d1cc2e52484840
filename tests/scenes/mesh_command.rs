//! `mesh info` and `mesh convert`.

use fem_mesh::{read_tetrahedra, volumes};

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

//! No file, however broken, makes a reader panic, hang or take memory that the file does not have.

use std::collections::HashMap;
use std::fs;
use std::path::Path;
use std::sync::LazyLock;

use fem_mesh::{Pattern, box_mesh, check, read_surface, read_tetrahedra, write_surface, write_tetrahedra};
use fem_mesh::{SurfaceMesh, boundary};
use proptest::prelude::*;
use proptest::sample::Index;
use tempfile::tempdir;

use crate::{fixed_seed, folder_with, gmsh, surfaces, vtk};

/// A good file of each format.
static VALID: LazyLock<HashMap<&str, Vec<u8>>> = LazyLock::new(|| {
    let folder = tempdir().unwrap();
    let mesh = box_mesh([1.0, 1.0, 1.0], 1, Pattern::Alternating).unwrap();
    for name in ["m.node", "m.mesh", "m.msh", "m.vtu"] {
        write_tetrahedra(&folder.path().join(name), &mesh).unwrap();
    }
    let surface = SurfaceMesh::new(mesh.vertices.clone(), boundary(&mesh));
    for name in ["s.obj", "s.ply", "s.stl"] {
        write_surface(&folder.path().join(name), &surface).unwrap();
    }
    let names = ["m.node", "m.ele", "m.mesh", "m.msh", "m.vtu", "s.obj", "s.ply", "s.stl"];
    names.into_iter().map(|name| (name, fs::read(folder.path().join(name)).unwrap())).collect()
});

/// One way to break a file.
#[derive(Clone, Debug)]
enum Damage {
    Cut(Index),
    Flip(Index, u8),
    Insert(Index, Vec<u8>),
    Remove(Index, usize),
    /// Replaces the digits found from there on.
    Number(Index, &'static str),
}

const NUMBERS: [&str; 9] = [
    "99999999999999999999",
    "1000000000000000000",
    "-1",
    "-9223372036854775808",
    "9223372036854775807",
    "18446744073709551615",
    "1e308",
    "nan",
    "0",
];

fn damage() -> impl Strategy<Value = Damage> {
    prop_oneof![
        any::<Index>().prop_map(Damage::Cut),
        (any::<Index>(), any::<u8>()).prop_map(|(at, mask)| Damage::Flip(at, mask)),
        (any::<Index>(), prop::collection::vec(any::<u8>(), 0..20)).prop_map(|(at, bytes)| Damage::Insert(at, bytes)),
        (any::<Index>(), 1..40_usize).prop_map(|(at, count)| Damage::Remove(at, count)),
        (any::<Index>(), prop::sample::select(&NUMBERS[..])).prop_map(|(at, number)| Damage::Number(at, number)),
    ]
}

fn apply(bytes: &mut Vec<u8>, damage: &Damage) {
    if bytes.is_empty() {
        return;
    }
    let length = bytes.len();
    match damage {
        Damage::Cut(at) => bytes.truncate(at.index(length)),
        Damage::Flip(at, mask) => bytes[at.index(length)] ^= mask,
        Damage::Insert(at, more) => drop(bytes.splice(at.index(length)..at.index(length), more.iter().copied())),
        Damage::Remove(at, count) => drop(bytes.drain(at.index(length)..length.min(at.index(length) + count))),
        Damage::Number(at, number) => {
            let is_digit = |&i: &usize| bytes[i].is_ascii_digit();
            if let Some(start) = (at.index(length)..length).find(is_digit) {
                let end = (start..length).find(|i| !is_digit(i)).unwrap_or(length);
                bytes.splice(start..end, number.bytes());
            }
        }
    }
}

/// Reads a damaged file. If a mesh results and passes the check, it has a boundary.
fn read_anything(path: &Path) {
    if let Ok(mesh) = read_tetrahedra(path)
        && check(&mesh, path).is_ok()
    {
        assert!(!boundary(&mesh).is_empty());
    }
}

proptest! {
    #![proptest_config(fixed_seed(600))]

    #[test]
    fn damaged_files_are_read_or_refused(
        name in prop::sample::select(&["m.node", "m.ele", "m.mesh", "m.msh", "m.vtu"][..]),
        damages in prop::collection::vec(damage(), 1..4),
    ) {
        let mut bytes = VALID[name].clone();
        damages.iter().for_each(|damage| apply(&mut bytes, damage));
        let partner = if name == "m.node" { "m.ele" } else { "m.node" };
        read_anything(&folder_with(&[(name, &bytes), (partner, &VALID[partner])]).1);
    }

    #[test]
    fn damaged_text_arrays_of_vtk_are_read_or_refused(damages in prop::collection::vec(damage(), 1..4)) {
        let mut bytes = include_bytes!("appended.vtu").to_vec();
        damages.iter().for_each(|damage| apply(&mut bytes, damage));
        read_anything(&folder_with(&[("m.vtu", &bytes)]).1);
    }

    #[test]
    fn damaged_binary_files_are_read_or_refused(which in 0..4_usize, damages in prop::collection::vec(damage(), 1..4)) {
        let files = [("m.msh", gmsh::binary_2()), ("m.msh", gmsh::binary_4()), ("m.vtk", vtk::binary(false)), ("m.vtk", vtk::binary(true))];
        let (name, mut bytes) = files[which].clone();
        damages.iter().for_each(|damage| apply(&mut bytes, damage));
        read_anything(&folder_with(&[(name, &bytes)]).1);
    }

    #[test]
    fn damaged_surfaces_are_read_or_refused(
        name in prop::sample::select(&["s.obj", "s.ply", "s.stl", "text.ply", "text.stl"][..]),
        damages in prop::collection::vec(damage(), 1..4),
    ) {
        let text = match name {
            "text.ply" => Some(surfaces::TEXT_PLY),
            "text.stl" => Some(surfaces::TEXT_STL),
            _ => None,
        };
        let mut bytes = text.map_or_else(|| VALID[name].clone(), |text| text.as_bytes().to_vec());
        damages.iter().for_each(|damage| apply(&mut bytes, damage));
        if let Ok(surface) = read_surface(&folder_with(&[(name, &bytes)]).1) {
            assert!(surface.elements.iter().flatten().all(|&i| i < surface.vertices.len()));
        }
    }

    #[test]
    fn random_bytes_are_refused(
        name in prop::sample::select(&["m.ele", "m.mesh", "m.msh", "m.vtu", "m.vtk", "m.obj.gz", "m.obj", "m.ply", "m.stl"][..]),
        bytes in prop::collection::vec(any::<u8>(), 0..300),
    ) {
        let path = folder_with(&[(name, &bytes), ("m.node", &bytes)]).1;
        prop_assert!(read_tetrahedra(&path).is_err());
        prop_assert!(read_surface(&path).is_err());
    }
}

#[test]
fn elements_nested_without_end_do_not_overflow_the_stack() {
    let nested = "<a>".repeat(1_000_000);
    assert!(read_tetrahedra(&folder_with(&[("m.vtu", nested.as_bytes())]).1).is_err());
    let entities = "<!DOCTYPE a [<!ENTITY b \"bbbbbbbbbb\"><!ENTITY c \"&b;&b;&b;&b;\">]><a>&c;</a>";
    assert!(read_tetrahedra(&folder_with(&[("m.vtu", entities.as_bytes())]).1).is_err());
}

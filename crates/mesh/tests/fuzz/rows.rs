//! Text files with one row or one count broken: they are refused or give the mesh of the whole file, never another one.

use std::fs;

use fem_mesh::{AnyMesh, read_mesh};
use nalgebra::Vector3;
use tempfile::tempdir;

use super::mutation::write_over;
use super::mutation::{Random, bytes_to_mutate};
use super::{others, own, text_ply, text_stl};

/// Breaks one line of a text: a word less or more, a line less or more, or a number that is 1 more or less. Returns the bytes that are
/// touched, and `None` if nothing is changed.
fn break_row(random: &mut Random, text: &str, rules: &Rules) -> Option<(String, usize)> {
    let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
    let at = random.below(lines.len());
    let words: Vec<String> = lines[at].split_whitespace().map(str::to_owned).collect();
    // Comments and names are no rows.
    if words.is_empty() || lines[at].contains(['#', '"']) || !(rules.is_row)(&lines[at]) {
        return None;
    }
    let word = random.below(words.len());
    let mut changed = words.clone();
    match random.below(5) {
        0 => drop(changed.remove(word)),
        1 => changed.insert(random.below(words.len() + 1), words[word].clone()),
        2 if rules.has_counts => drop(lines.remove(at)),
        3 if rules.has_counts => lines.insert(at, lines[at].clone()),
        4 if rules.has_counts && (rules.is_count)(&lines, at) => {
            let number: i64 = words[word].parse().ok()?;
            changed[word] = (number + [-1, 1, 7][random.below(3)]).to_string();
        }
        _ => return None,
    }
    if changed != words {
        if (rules.is_whole)(&changed) {
            return None;
        }
        lines[at] = changed.join(" ");
    }
    Some((lines.join("\n") + "\n", words.concat().len()))
}

/// What a format has.
struct Rules {
    /// The file announces the number of its rows.
    has_counts: bool,
    /// Returns true for lines that may be broken.
    is_row: fn(&str) -> bool,
    /// Returns true for lines of counts.
    is_count: fn(&[String], usize) -> bool,
    /// Returns true if a broken row is by chance a whole row of something else.
    is_whole: fn(&[String]) -> bool,
}

const ANY: Rules = Rules { has_counts: true, is_row: |_| true, is_count: |_, _| false, is_whole: |_| false };

fn check_rows(ending: &str, files: &[Vec<u8>], partner: Option<(&str, Vec<u8>)>, rules: &Rules) {
    let folder = tempdir().unwrap();
    let path = folder.path().join(format!("m.{ending}"));
    if let Some((ending, bytes)) = &partner {
        fs::write(folder.path().join(format!("m.{ending}")), bytes).unwrap();
    }
    let texts: Vec<&str> = files.iter().filter_map(|bytes| str::from_utf8(bytes).ok()).collect();
    let whole: Vec<AnyMesh> = texts
        .iter()
        .map(|text| {
            write_over(&path, text.as_bytes());
            read_mesh(&path).unwrap()
        })
        .collect();
    let (mut mutated, mut refused, mut random) = (0, 0, Random(texts.len() as u64));
    // A row has fewer bytes than the runs of the other test.
    while mutated < bytes_to_mutate() / 10 {
        let which = random.below(texts.len());
        let Some((text, bytes)) = break_row(&mut random, texts[which], rules) else { continue };
        mutated += bytes;
        write_over(&path, text.as_bytes());
        match read_mesh(&path) {
            Err(_) => refused += 1,
            Ok(found) => assert!(shape(&found) == shape(&whole[which]), "{ending}: another mesh from\n{text}"),
        }
    }
    println!("{ending}: {mutated} bytes, {refused} files refused");
    assert!(refused > 0);
}

/// Vertices and corners of the elements; a row can name another set and be whole.
fn shape(mesh: &AnyMesh) -> (&[Vector3<f64>], &[usize]) {
    match mesh {
        AnyMesh::Tetrahedra(mesh) => (&mesh.vertices, mesh.elements.as_flattened()),
        AnyMesh::Triangles(mesh) => (&mesh.vertices, mesh.elements.as_flattened()),
    }
}

#[test]
fn a_broken_row_of_gmsh_gives_the_same_mesh_or_an_error() {
    let is_count =
        |lines: &[String], at: usize| at > 0 && ["$Nodes", "$Elements", "$PhysicalNames"].contains(&&lines[at - 1][..]);
    // A row of version 2 tells its own type and number of tags: without its first number it can be a whole row of another type.
    let others = others("msh").into_iter().filter(|bytes| !bytes.starts_with(b"$MeshFormat\n2"));
    check_rows("msh", &[own("msh"), others.collect()].concat(), None, &Rules { is_count, ..ANY });
}

#[test]
fn a_broken_row_of_medit_gives_the_same_mesh_or_an_error() {
    let is_count = |lines: &[String], at: usize| !lines[at].contains(' ');
    check_rows("mesh", &[own("mesh"), others("mesh")].concat(), None, &Rules { is_count, ..ANY });
}

#[test]
fn a_broken_row_of_vtk_gives_the_same_mesh_or_an_error() {
    let is_count = |lines: &[String], at: usize| {
        ["POINTS", "CELLS", "CELL_TYPES", "CELL_DATA", "POINT_DATA"].iter().any(|word| lines[at].starts_with(word))
    };
    // A file without the fields behind its cells is whole, and its sets are fields; the first two lines are free text.
    let is_row = |line: &str| !line.starts_with("FIELD") && !line.starts_with("set:") && !line.contains("fem-mesh");
    check_rows("vtk", &own("vtk"), None, &Rules { is_count, is_row, ..ANY });
}

#[test]
fn a_broken_row_of_tetgen_gives_the_same_mesh_or_an_error() {
    let is_count = |lines: &[String], at: usize| at == 0 || lines[at - 1].starts_with('#');
    for which in [0, 1] {
        let (nodes, elements) = (own("node")[which].clone(), own("ele")[which].clone());
        check_rows("node", std::slice::from_ref(&nodes), Some(("ele", elements.clone())), &Rules { is_count, ..ANY });
        check_rows("ele", &[elements], Some(("node", nodes)), &Rules { is_count, ..ANY });
    }
}

#[test]
fn a_broken_row_of_a_surface_gives_the_same_mesh_or_an_error() {
    let is_count = |lines: &[String], at: usize| lines[at].starts_with("element");
    // Without the comment and the colour the rest is the same.
    // `3 19 4 5` with a second 4 before it is a quadrangle.
    let is_whole = |row: &[String]| row.first().is_some_and(|count| count.parse() == Ok(row.len() - 1));
    check_rows("ply", &[text_ply()], None, &Rules { is_count, is_whole, ..ANY });
    let is_row = |line: &str| line.starts_with("vertex") || line.starts_with("endfacet");
    check_rows("stl", &[text_stl()], None, &Rules { has_counts: false, is_row, ..ANY });
    let is_row = |line: &str| line.starts_with("v ");
    check_rows("obj", &own("obj"), None, &Rules { has_counts: false, is_row, ..ANY });
}

#[test]
fn a_broken_row_of_abaqus_gives_the_same_mesh_or_an_error() {
    // Rows of the nodes and of the elements.
    let is_row = |line: &str| line.contains('.') || line.matches(',').count() == 4;
    check_rows("inp", &own("inp"), None, &Rules { has_counts: false, is_row, ..ANY });
}

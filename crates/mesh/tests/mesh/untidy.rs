//! Files as other programs write them, in `other_programs/untidy/`: each was refused once, or read wrongly.

use std::path::{Path, PathBuf};

use fem_mesh::{AnyMesh, MeshFile, check, check_plane, read_file, surface_quality, volumes};

fn path(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("mesh/other_programs/untidy").join(name)
}

fn read(name: &str) -> MeshFile {
    read_file(&path(name)).unwrap_or_else(|error| panic!("{error}"))
}

fn refusal(name: &str) -> String {
    read_file(&path(name)).unwrap_err().to_string()
}

/// Number of tetrahedra and volume of a mesh that passes the check.
fn body(found: &MeshFile, name: &str) -> (usize, f64) {
    let AnyMesh::Tetrahedra(mesh) = &found.mesh else { panic!("{name} has no tetrahedra") };
    check(mesh, Path::new(name)).unwrap();
    (mesh.elements.len(), volumes(mesh).iter().sum())
}

/// Number of triangles and area.
fn surface(found: &MeshFile, name: &str) -> (usize, f64) {
    let AnyMesh::Triangles(mesh) = &found.mesh else { panic!("{name} is no surface") };
    (mesh.elements.len(), surface_quality(mesh).area)
}

/// The names of the sets with their counts.
fn sets(found: &MeshFile) -> Vec<String> {
    let AnyMesh::Tetrahedra(mesh) = &found.mesh else { return Vec::new() };
    mesh.sets.iter().map(|(name, set)| format!("{name}: {}", set.counts())).collect()
}

#[test]
fn nodes_of_no_element_are_left_out_and_counted() {
    for name in ["orphan_gmsh_arc_centre_4.1.msh", "orphan_gmsh_arc_centre.mesh"] {
        let found = read(name);
        let (count, volume) = body(&found, name);
        assert_eq!(count, 382, "{name}");
        assert!((volume - 3.088358).abs() < 1e-6, "{name}: {volume}");
        assert_eq!(
            found.notes.iter().filter(|note| note.contains("nodes belong to no element")).count(),
            1,
            "{:?}",
            found.notes
        );
    }
}

#[test]
fn a_mesh_of_the_other_orientation_is_turned_and_its_elements_counted() {
    let found = read("all_negative.mesh");
    let (count, volume) = body(&found, "all_negative.mesh");
    assert!(count > 0 && volume > 0.0);
    assert_eq!(found.notes.len(), 1);
    assert!(found.notes[0].starts_with(&format!("all {count} tetrahedra had a negative volume")), "{:?}", found.notes);
}

#[test]
fn rows_that_are_all_longer_than_the_header_says_are_read_and_told() {
    let found = read("ply_meshlab_wedge_colour.ply");
    assert_eq!(surface(&found, "wedge").0, 4);
    let told =
        found.notes.iter().any(|note| note.contains("`face` are longer than the header says, the first in line 20"));
    assert!(told, "{:?}", found.notes);
    assert!(found.notes.iter().any(|note| note.contains("`texcoord` of face")), "{:?}", found.notes);
    assert_eq!(found.program.as_deref(), Some("VCGLIB generated"));
}

#[test]
fn groups_of_a_partitioned_file_are_sets() {
    let found = read("partitioned_4.1_groups_lost.msh");
    assert_eq!(body(&found, "partitioned").0, 200);
    let expected = [
        "clamped: 14 triangles",
        "corner: 1 points",
        "edge: 2 edges",
        "soft: 100 tetrahedra",
        "stiff part: 100 tetrahedra",
    ];
    assert_eq!(sets(&found), expected);
}

#[test]
fn regions_and_markers_of_tetgen_are_sets() {
    for name in ["tetgen_regions.node", "tetgen_regions.ele"] {
        let found = read(name);
        assert_eq!(body(&found, name).0, 12);
        assert_eq!(sets(&found), ["11: 6 tetrahedra", "22: 6 tetrahedra", "5: 4 points"]);
    }
    assert_eq!(read("tetgen_regions.ele").program.as_deref(), Some("tetgen -pqA bar.poly"));
}

#[test]
fn lines_that_go_on_after_a_backslash_are_one() {
    assert_eq!(surface(&read("obj_continued.obj"), "continued"), (12, 6.0));
}

#[test]
fn a_binary_field_of_strings_is_skipped_and_integers_beside_it_are_sets() {
    let found = read("vtk51_binary_string_field.vtk");
    let (count, volume) = body(&found, "strings");
    assert_eq!(count, 200);
    assert!((volume - 2.0).abs() < 1e-12, "{volume}");
    assert_eq!(sets(&found).len(), 2, "{:?}", sets(&found));
    let told = found.notes.join("\n");
    assert!(["`note`", "`u`", "`empty name ü`"].iter().all(|field| told.contains(field)), "{told}");
    assert_eq!(found.program.as_deref(), Some("vtk output"));
}

#[test]
fn strips_and_indices_of_64_bits_are_triangles() {
    for name in ["ply_tristrips_l.ply", "ply_int64_l.ply"] {
        let found = read(name);
        assert_eq!(surface(&found, name), (12, 6.0), "{name}");
        let AnyMesh::Triangles(mesh) = &found.mesh else { unreachable!() };
        assert!(surface_quality(mesh).is_closed(), "{name}");
    }
}

#[test]
fn capitals_and_byte_order_marks_are_no_obstacle() {
    for name in ["stl_upper.stl", "stl_ascii_bom.stl"] {
        assert_eq!(surface(&read(name), name), (12, 6.0), "{name}");
    }
}

#[test]
fn files_of_medit_come_with_small_letters_real_references_version_0_and_texts() {
    for name in ["medit_lower.mesh", "medit_float_ref.mesh"] {
        let found = read(name);
        let (count, volume) = body(&found, name);
        assert_eq!(count, 2);
        assert!((volume - 0.5).abs() < 1e-15);
        assert!(sets(&found).contains(&"10: 1 triangles".to_owned()), "{:?}", sets(&found));
        assert!(found.notes.iter().any(|note| note.contains("the section Ridges")), "{:?}", found.notes);
    }
    let found = read("medit_bamg0.mesh");
    let AnyMesh::Triangles(mesh) = &found.mesh else { panic!() };
    check_plane(mesh, Path::new("bamg")).unwrap();
    assert_eq!((mesh.vertices.len(), mesh.elements.len()), (9, 8));
    assert!((surface_quality(mesh).area - 16.0).abs() < 1e-12);
    assert_eq!(mesh.sets["2"].edges.len(), 4);
}

#[test]
fn a_quadrangle_is_the_same_two_triangles_in_every_format() {
    let [medit, vtk] = ["medit_quads.mesh", "vtk_quads_ok.vtk"].map(read);
    assert_eq!(medit.mesh, vtk.mesh);
    assert_eq!(surface(&medit, "quads"), (2, 1.0));
}

#[test]
fn version_1_of_gmsh_is_read() {
    let found = read("gmsh1.msh");
    let (count, volume) = body(&found, "gmsh1");
    assert_eq!(count, 200);
    assert!((volume - 2.0).abs() < 1e-12, "{volume}");
    assert!(sets(&found).contains(&"1: 200 tetrahedra".to_owned()), "{:?}", sets(&found));
}

#[test]
fn faces_of_two_corners_are_left_out_and_counted() {
    let found = read("obj_face_two.obj");
    assert_eq!(surface(&found, "two"), (12, 6.0));
    assert_eq!(found.notes, ["1 faces with fewer than three corners are left out"]);
}

#[test]
fn a_first_line_that_is_not_of_the_format_is_named() {
    let message = refusal("first_line_wrong_number.vtk");
    assert!(message.contains("first_line_wrong_number.vtk, line 1: "), "{message}");
}

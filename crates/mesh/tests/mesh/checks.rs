//! Meshes that the check refuses, and meshes that pass it.

use std::path::Path;

use fem_mesh::{Pattern, TetrahedralMesh, box_mesh, check, volumes};
use nalgebra::{Rotation3, Vector3};

use crate::two_tetrahedra;

/// The message for a mesh that is refused; it names the file.
fn refusal(mesh: &TetrahedralMesh) -> String {
    let message = check(mesh, Path::new("some.node")).unwrap_err().to_string();
    assert!(message.starts_with("some.node: "), "{message}");
    message
}

fn one(places: [[f64; 3]; 4]) -> TetrahedralMesh {
    TetrahedralMesh::new(places.map(Vector3::from).to_vec(), vec![[0, 1, 2, 3]])
}

fn corner() -> TetrahedralMesh {
    one([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]])
}

/// The mesh turned by an oblique rotation, scaled, and moved along all axes.
fn placed(mesh: &TetrahedralMesh, scale: f64, offset: f64) -> TetrahedralMesh {
    let turn = Rotation3::from_euler_angles(0.3, 1.1, -0.7);
    let vertices = mesh.vertices.iter().map(|x| turn * x * scale + Vector3::repeat(offset)).collect();
    TetrahedralMesh::new(vertices, mesh.elements.clone())
}

#[test]
fn two_good_tetrahedra_pass() {
    check(&two_tetrahedra(), Path::new("some.node")).unwrap();
}

#[test]
fn an_empty_mesh_is_refused() {
    assert!(refusal(&TetrahedralMesh::default()).contains("no vertices"));
    let without = TetrahedralMesh { elements: vec![], ..corner() };
    let message = refusal(&without);
    assert!(message.contains("no tetrahedra; give one that has some"), "{message}");
}

#[test]
fn a_coordinate_that_is_not_finite_is_refused_with_its_vertex() {
    for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let mut mesh = corner();
        mesh.vertices[2].y = value;
        let message = refusal(&mesh);
        assert!(
            message.contains("vertex 2 has a coordinate that is not finite; give it a finite position"),
            "{message}"
        );
    }
}

#[test]
fn an_index_out_of_range_is_refused_with_its_element_and_the_range() {
    let mut mesh = two_tetrahedra();
    mesh.elements[1][3] = 5;
    let message = refusal(&mesh);
    assert!(message.contains("element 1 names vertex 5") && message.contains("0 to 4"), "{message}");
    assert!(message.contains("correct the index"), "{message}");
    mesh.elements[1][3] = usize::MAX;
    refusal(&mesh);
}

#[test]
fn a_vertex_twice_in_an_element_is_refused_with_both() {
    let mut mesh = two_tetrahedra();
    mesh.elements[1] = [0, 2, 4, 2];
    let message = refusal(&mesh);
    assert!(message.contains("element 1") && message.contains("vertex 2 twice; give it different"), "{message}");
}

#[test]
fn a_negative_element_is_refused_with_its_volume_and_the_remedy() {
    let mut mesh = corner();
    mesh.elements[0].swap(0, 1);
    let message = refusal(&mesh);
    assert!(message.contains("element 0") && message.contains("-1.6666666666666666e-1 m³"), "{message}");
    assert!(message.contains("the first of 1 such elements; turn them by `mesh convert --orient`"), "{message}");
}

#[test]
fn flat_elements_are_refused_in_every_direction_at_every_scale_and_far_from_the_origin() {
    let plane = one([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.3, 0.4, 0.0]]);
    let line = one([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0], [5.0, 0.0, 0.0]]);
    let point = one([[1.0; 3]; 4]);
    for flat in [plane, line, point] {
        for (scale, offset) in [(1.0, 0.0), (1e-6, 0.0), (1e6, 0.0), (1.0, 1e6), (1e-3, 1e6)] {
            let message = refusal(&placed(&flat, scale, offset));
            assert!(
                message.contains("element 0") && message.contains("move its vertices apart, or leave such"),
                "{message}"
            );
        }
    }
}

#[test]
fn slivers_of_aspect_a_million_pass() {
    let cap = one([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.3, 0.3, 1e-6]]);
    let needle = one([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.5, 1e-6, 0.0], [0.5, 0.0, 1e-6]]);
    for sliver in [cap, needle] {
        for (scale, offset) in [(1.0, 0.0), (1e-6, 0.0), (1e6, 0.0), (1.0, 1e2)] {
            check(&placed(&sliver, scale, offset), Path::new("some.node")).unwrap();
        }
    }
}

#[test]
fn a_box_passes_at_every_scale_and_a_thousand_kilometres_away() {
    let mesh = box_mesh([2.0, 1.0, 1.0], 4, Pattern::Alternating).unwrap();
    for (scale, offset) in [(1e-6, 0.0), (1e6, 0.0), (1.0, 1e6), (1.0, -1e6), (1e-3, 1e6)] {
        check(&placed(&mesh, scale, offset), Path::new("some.node")).unwrap();
    }
    let far: f64 = volumes(&placed(&mesh, 1.0, 1e6)).iter().sum();
    approx::assert_relative_eq!(far, 2.0, max_relative = 1e-8);
}

#[test]
fn elements_with_the_same_vertices_are_refused_with_their_number() {
    let mut mesh = box_mesh([1.0, 1.0, 1.0], 1, Pattern::Alternating).unwrap();
    let [a, b, c, d] = mesh.elements[2];
    mesh.elements.push([b, c, a, d]);
    mesh.elements.push(mesh.elements[5]);
    let message = refusal(&mesh);
    assert!(message.contains("element 6 (counted from 0) has the same vertices as element 2"), "{message}");
    assert!(
        message.contains("2 elements repeat an earlier one; leave them out by `mesh convert --clean`"),
        "{message}"
    );
}

#[test]
fn an_element_too_large_for_its_volume_is_refused() {
    let message = refusal(&placed(&corner(), 1e150, 0.0));
    assert!(message.contains("element 0") && message.contains("scale the mesh"), "{message}");
}

#[test]
fn a_vertex_without_an_element_is_refused_with_its_index() {
    let mut mesh = two_tetrahedra();
    mesh.elements.pop();
    let message = refusal(&mesh);
    assert!(message.contains("vertex 4") && message.contains("remove it"), "{message}");
}

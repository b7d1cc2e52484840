//! Properties of uniform refinement.

use std::path::Path;

use approx::assert_relative_eq;
use fem_mesh::{Pattern, TetrahedralMesh, boundary, box_mesh, check, quality, read_tetrahedra, refine, volumes};
use nalgebra::Vector3;

use crate::box_rule::{assert_closed, enclosed_volume};

fn refined(mesh: TetrahedralMesh, times: u32) -> TetrahedralMesh {
    refine(mesh, times, Path::new("test")).unwrap()
}

/// A tetrahedron whose octahedron has its shortest diagonal between the midpoints of the edge (0, `partner`) and the other.
fn with_shortest_diagonal(partner: usize) -> TetrahedralMesh {
    let mut corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(Vector3::from);
    // Two opposite edges that come nearer to each other bring their midpoints together.
    let others: Vec<usize> = (1..4).filter(|&corner| corner != partner).collect();
    let shift = 0.3 * ((corners[0] + corners[partner]) - (corners[others[0]] + corners[others[1]]));
    others.iter().for_each(|&corner| corners[corner] += shift);
    TetrahedralMesh::new(corners.to_vec(), vec![[0, 1, 2, 3]])
}

#[test]
fn the_eight_children_of_a_tetrahedron_have_an_eighth_of_its_volume_each() {
    for partner in 1..4 {
        let mesh = with_shortest_diagonal(partner);
        let whole = volumes(&mesh)[0];
        assert!(whole > 0.0);
        let children = refined(mesh, 1);
        assert_eq!((children.vertices.len(), children.elements.len()), (10, 8));
        for volume in volumes(&children) {
            assert_relative_eq!(volume, whole / 8.0, max_relative = 1e-14);
        }
        let faces = boundary(&children);
        assert_eq!(faces.len(), 16);
        assert_closed(&faces);
    }
}

#[test]
fn the_octahedron_is_cut_about_its_shortest_diagonal() {
    for partner in 1..4 {
        let mesh = with_shortest_diagonal(partner);
        let others: Vec<usize> = (1..4).filter(|&corner| corner != partner).collect();
        let ends = [[0, partner], [others[0], others[1]]].map(|[a, b]| 0.5 * (mesh.vertices[a] + mesh.vertices[b]));
        let children = refined(mesh, 1);
        let has = |element: &[usize; 4], place: &Vector3<f64>| element.iter().any(|&i| children.vertices[i] == *place);
        let both = children.elements.iter().filter(|element| ends.iter().all(|end| has(element, end)));
        assert_eq!(both.count(), 4, "partner {partner}");
    }
}

#[test]
fn a_refined_cage_keeps_its_volume_its_surface_and_its_nodes() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../data/stanford/armadillo_coarse.node");
    let coarse = read_tetrahedra(&path).unwrap();
    let fine = refined(coarse.clone(), 2);
    check(&fine, &path).unwrap();
    assert_eq!(fine.elements.len(), 64 * coarse.elements.len());
    assert_eq!(fine.vertices[..coarse.vertices.len()], coarse.vertices);
    let whole = |mesh: &TetrahedralMesh| volumes(mesh).iter().sum::<f64>();
    assert_relative_eq!(whole(&fine), whole(&coarse), max_relative = 1e-12);
    let faces = boundary(&fine);
    assert_eq!(faces.len(), 16 * boundary(&coarse).len());
    assert_closed(&faces);
    assert_relative_eq!(enclosed_volume(&fine, &faces), whole(&coarse), max_relative = 1e-12);
}

#[test]
fn shapes_stay_bounded_however_often_a_mesh_is_refined() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../data/stanford/armadillo_coarse.node");
    for coarse in [box_mesh([1.0, 1.0, 1.0], 1, Pattern::Alternating).unwrap(), read_tetrahedra(&path).unwrap()] {
        let worst = |times: u32| quality(&refined(coarse.clone(), times)).radius_ratio.value;
        let [plain, first, second] = [0, 1, 2].map(worst);
        assert!(first > 0.5 * plain && second > 0.999 * first, "{plain} {first} {second}");
    }
}

#[test]
fn zero_refinements_keep_the_mesh_and_two_are_one_after_another() {
    let mesh = box_mesh([2.0, 1.0, 1.0], 1, Pattern::Alternating).unwrap();
    assert_eq!(refined(mesh.clone(), 0), mesh);
    assert_eq!(refined(refined(mesh.clone(), 1), 1), refined(mesh, 2));
}

#[test]
fn too_fine_a_mesh_is_refused_with_its_size() {
    let mesh = box_mesh([2.0, 1.0, 1.0], 1, Pattern::Alternating).unwrap();
    let message = refine(mesh.clone(), 9, Path::new("m.node")).unwrap_err().to_string();
    assert!(message.starts_with("m.node: refined 9 times the mesh would have 1.610612736e9 elements"), "{message}");
    assert!(refine(mesh, u32::MAX, Path::new("m.node")).is_err());
}

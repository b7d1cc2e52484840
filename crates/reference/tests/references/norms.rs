//! Norms of differences.

use fem_mesh::{Pattern, box_mesh};
use fem_model::BodyMesh;
use fem_reference::space::norms::{distance, l2, largest, length, mesh_hash, momenta, weights};

#[test]
fn a_translation_has_its_length_in_both_norms() {
    let mesh = BodyMesh::from(box_mesh([2.0, 1.0, 1.0], 2, Pattern::Alternating).unwrap());
    let a: Vec<f64> = mesh.vertices().iter().flat_map(|x| x.iter().copied()).collect();
    let b: Vec<f64> = a.iter().enumerate().map(|(i, a)| a + [0.3, 0.0, -0.4][i % 3]).collect();
    let weights = weights(&mesh);
    assert!((weights.iter().sum::<f64>() - 2.0).abs() < 1e-14);
    assert!((l2(&weights, &a, &b) - 0.5).abs() < 1e-14);
    assert!((largest(&a, &b) - 0.5).abs() < 1e-14);
    assert_eq!(length(&mesh), 2.0);
}

#[test]
fn distances_keep_nan() {
    assert!(largest(&[0.0, f64::NAN, 0.0, 1.0, 0.0, 0.0], &[0.0; 6]).is_nan());
    assert!(l2(&[1.0], &[f64::NAN, 0.0, 0.0], &[0.0; 3]).is_nan());
}

#[test]
fn a_rotating_box_has_angular_momentum_only() {
    let mesh = BodyMesh::from(box_mesh([1.0, 1.0, 1.0], 2, Pattern::Alternating).unwrap());
    let weights = weights(&mesh);
    let q: Vec<f64> = mesh.vertices().iter().flat_map(|x| x.iter().copied()).collect();
    let v: Vec<f64> = mesh.vertices().iter().flat_map(|x| [-(x.y - 0.5), x.x - 0.5, 0.0]).collect();
    let (linear, angular) = momenta(&mesh, &weights, 10.0, &q, &v);
    let inertia: f64 =
        mesh.vertices().iter().zip(&weights).map(|(x, w)| 10.0 * w * ((x.x - 0.5).powi(2) + (x.y - 0.5).powi(2))).sum();
    assert!(distance(linear, [0.0; 3]) < 1e-14);
    // The mesh has no mirror symmetry, so the other two components are not zero.
    assert!((angular[2] - inertia).abs() < 1e-13, "{angular:?}");
}

#[test]
fn different_meshes_have_different_hashes() {
    let [a, b] = [1, 2].map(|cells| BodyMesh::from(box_mesh([1.0; 3], cells, Pattern::Alternating).unwrap()));
    assert_ne!(mesh_hash(&a), mesh_hash(&b));
    assert_eq!(mesh_hash(&a), mesh_hash(&a.clone()));
}

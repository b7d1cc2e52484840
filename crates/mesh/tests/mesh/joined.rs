//! Meshes that are joined, and bodies that overlap.

use fem_mesh::{MeshSet, Pattern, box_mesh, join, overlap, volumes};
use nalgebra::Vector3;

#[test]
fn joined_meshes_follow_one_another_with_their_sets() {
    let small = box_mesh([1.0, 1.0, 1.0], 1, Pattern::Alternating).unwrap();
    let mut large = box_mesh([2.0, 1.0, 1.0], 1, Pattern::Alternating).unwrap();
    large.vertices.iter_mut().for_each(|vertex| vertex.y += 5.0);
    let corner = MeshSet { faces: vec![[0, 1, 4]], points: vec![3], ..MeshSet::default() };
    large.sets.insert("corner".to_owned(), corner);
    let joined = join([("small".to_owned(), small), ("large".to_owned(), large)]);
    assert_eq!((joined.vertices.len(), joined.elements.len()), (8 + 12, 6 + 12));
    assert!((volumes(&joined).iter().sum::<f64>() - 3.0).abs() < 1e-12);
    assert!(joined.elements[6..].iter().flatten().all(|&node| node >= 8));
    assert_eq!(joined.sets["small"].elements, [0, 1, 2, 3, 4, 5]);
    assert_eq!(joined.sets["large"].elements, (6..18).collect::<Vec<_>>());
    assert_eq!((&joined.sets["corner"].faces[..], &joined.sets["corner"].points[..]), (&[[8, 9, 12]][..], &[11][..]));
}

/// Two boxes, the second one scaled and moved.
fn two(scale: f64, shift: Vector3<f64>) -> Option<[Vector3<f64>; 2]> {
    let first = box_mesh([2.0, 1.0, 1.0], 2, Pattern::Alternating).unwrap();
    let mut second = first.clone();
    second.vertices.iter_mut().for_each(|x| *x = scale * *x + shift);
    let count = first.elements.len();
    let mesh = join([("a".to_owned(), first), ("b".to_owned(), second)]);
    overlap(&mesh.vertices, &mesh.elements, &(0..count).collect::<Vec<_>>(), &(count..2 * count).collect::<Vec<_>>())
}

#[test]
fn the_box_of_an_overlap_is_that_of_the_common_volume() {
    let [least, largest] = two(1.0, Vector3::new(1.3, 0.2, -0.4)).unwrap();
    assert!((least - Vector3::new(1.3, 0.2, 0.0)).amax() < 1e-3, "{least}");
    assert!((largest - Vector3::new(2.0, 1.0, 0.6)).amax() < 1e-3, "{largest}");
    let [least, largest] = two(1.0, Vector3::zeros()).unwrap();
    assert!(least.amax() < 1e-3 && (largest - Vector3::new(2.0, 1.0, 1.0)).amax() < 1e-3, "equal bodies");
    let [least, largest] = two(0.1, Vector3::repeat(0.3)).unwrap();
    assert!((least - Vector3::repeat(0.3)).amax() < 1e-3 && (largest - Vector3::new(0.5, 0.4, 0.4)).amax() < 1e-3);
}

#[test]
fn bodies_that_touch_or_are_apart_do_not_overlap() {
    assert_eq!(two(1.0, Vector3::new(2.0, 0.0, 0.0)), None);
    assert_eq!(two(1.0, Vector3::new(0.3, 1.0, 0.1)), None);
    assert_eq!(two(1.0, Vector3::new(0.0, 0.0, 1.5)), None);
}

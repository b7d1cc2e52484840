//! Closest points of surfaces.

use fem_mesh::SurfaceMesh;
use fem_mesh::generate::Solid;
use nalgebra::Vector3;

/// Vectors with coordinates from −1 to 1, Marsaglia, Xorshift RNGs (2003).
fn random(seed: u64) -> impl FnMut() -> Vector3<f64> {
    let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1;
    move || {
        Vector3::from_fn(|_, _| {
            state ^= state << 13;
            state ^= state >> 7;
            state ^= state << 17;
            (state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
        })
    }
}

fn solid(triangles: &[[Vector3<f64>; 3]]) -> Solid {
    let elements = (0..triangles.len()).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    Solid::new(&SurfaceMesh::new(triangles.as_flattened().to_vec(), elements))
}

#[test]
fn no_point_of_a_triangle_is_closer_than_the_closest() {
    let mut next = random(4);
    for _ in 0..300 {
        let corners = [next(), next(), next()];
        let point = next() * 2.0;
        let found = solid(&[corners]).closest(&point).unwrap();
        let least = (found - point).norm();
        let [a, b, c] = corners;
        let mut sampled = f64::INFINITY;
        for i in 0..=60 {
            for j in 0..=60 - i {
                let (u, v) = (f64::from(i) / 60.0, f64::from(j) / 60.0);
                sampled = sampled.min((a + (b - a) * u + (c - a) * v - point).norm());
            }
        }
        assert!(least <= sampled + 1e-12 && sampled <= least + 0.06, "{corners:?} {point:?}: {least} {sampled}");
    }
}

#[test]
fn the_tree_finds_the_closest_triangle() {
    let mut next = random(7);
    let triangles: Vec<[Vector3<f64>; 3]> = (0..100).map(|_| [next(), next(), next()]).collect();
    let each: Vec<Solid> = triangles.iter().map(|triangle| solid(&[*triangle])).collect();
    let all = solid(&triangles);
    let distance = |solid: &Solid, point: &Vector3<f64>| (solid.closest(point).unwrap() - point).norm();
    for _ in 0..200 {
        let point = next() * 2.0;
        let least = each.iter().map(|solid| distance(solid, &point)).fold(f64::INFINITY, f64::min);
        assert_eq!(distance(&all, &point), least);
    }
    assert_eq!(Solid::new(&SurfaceMesh::default()).closest(&Vector3::zeros()), None);
}

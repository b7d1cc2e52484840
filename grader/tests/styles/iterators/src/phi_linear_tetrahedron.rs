use nalgebra::{Vector3, Vector4};

/// Ratios of volumes: the point takes the place of each vertex in turn.
pub fn phi_linear_tetrahedron(V: &[Vector3<f64>], element: &[usize; 4], x: &Vector3<f64>) -> Vector4<f64> {
    let corners = element.map(|vertex| V[vertex]);
    let with_point = |i: usize| {
        let mut moved = corners;
        moved[i] = *x;
        volume(&moved)
    };
    Vector4::from_iterator((0..4).map(|i| with_point(i) / volume(&corners)))
}

/// Six times the signed volume.
fn volume([a, b, c, d]: &[Vector3<f64>; 4]) -> f64 {
    (b - a).cross(&(c - a)).dot(&(d - a))
}

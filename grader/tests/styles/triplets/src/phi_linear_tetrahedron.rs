use nalgebra::{Vector3, Vector4};

/// One weight for each face: the height above it, in units of the vertex's own height.
pub fn phi_linear_tetrahedron(V: &[Vector3<f64>], element: &[usize; 4], x: &Vector3<f64>) -> Vector4<f64> {
    let corner = |i: usize| V[element[i % 4]];
    let height = |i: usize, point: &Vector3<f64>| {
        let base = corner(i + 1);
        let normal = (corner(i + 2) - base).cross(&(corner(i + 3) - base));
        normal.dot(&(point - base))
    };
    Vector4::from_fn(|i, _| height(i, x) / height(i, &corner(i)))
}

use nalgebra::{Matrix4, Vector3, Vector4};

/// Four equations for four weights: they blend to the point, and they sum to one.
pub fn phi_linear_tetrahedron(V: &[Vector3<f64>], element: &[usize; 4], x: &Vector3<f64>) -> Vector4<f64> {
    let size = (V[element[1]] - V[element[0]]).norm();
    let mut A = Matrix4::from_element(1.0);
    for (column, vertex) in element.iter().enumerate() {
        A.fixed_view_mut::<3, 1>(1, column).copy_from(&((V[*vertex] - x) / size));
    }
    A.full_piv_lu().solve(&Vector4::x()).expect("an element with volume")
}

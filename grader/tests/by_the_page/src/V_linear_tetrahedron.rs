use nalgebra::{DVector, Matrix3, Vector3};

/// The integral of the density at F = Σ x_i ∇φ_iᵀ.
pub fn V_linear_tetrahedron(
    q: &DVector<f64>,
    V: &[Vector3<f64>],
    element: &[usize; 4],
    volume: f64,
    C: f64,
    D: f64,
) -> f64 {
    crate::quadrature_single_point(V, element, volume, |X| {
        let dphi = crate::dphi_linear_tetrahedron_dX(V, element, X);
        // Positions relative to vertex 0, as the page advises for bodies far from the origin.
        let x = element.map(|vertex| q.fixed_rows::<3>(3 * vertex) - q.fixed_rows::<3>(3 * element[0]));
        let mut F = Matrix3::zeros();
        for i in 0..4 {
            F += x[i] * dphi.row(i);
        }
        crate::psi_neo_hookean(&F, C, D)
    })
}

use nalgebra::{SMatrix, SVector};

/// A sum of outer products: every vertex alone, and all of them together.
pub fn mass_matrix_linear_tetrahedron(density: f64, volume: f64) -> SMatrix<f64, 12, 12> {
    let mut M = SMatrix::<f64, 12, 12>::identity();
    for axis in 0..3 {
        let along = SVector::<f64, 12>::from_fn(|local, _| if local % 3 == axis { 1.0 } else { 0.0 });
        M.ger(1.0, &along, &along, 1.0);
    }
    M * (density * volume / 20.0)
}

use nalgebra::DVector;

/// A double loop over the vertices.
pub fn T_linear_tetrahedron(qdot: &DVector<f64>, element: &[usize; 4], density: f64, volume: f64) -> f64 {
    let mut sum = 0.0;
    for i in 0..4 {
        for j in 0..4 {
            let weight = if i == j { 2.0 } else { 1.0 };
            for k in 0..3 {
                sum += weight * qdot[3 * element[i] + k] * qdot[3 * element[j] + k];
            }
        }
    }
    density * volume / 40.0 * sum
}

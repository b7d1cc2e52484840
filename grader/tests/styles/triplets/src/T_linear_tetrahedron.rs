use nalgebra::{DVector, Vector3};

/// An integral over four points, which is exact for squares of linear functions.
pub fn T_linear_tetrahedron(qdot: &DVector<f64>, element: &[usize; 4], density: f64, volume: f64) -> f64 {
    let speed = |vertex: usize| Vector3::new(qdot[3 * vertex], qdot[3 * vertex + 1], qdot[3 * vertex + 2]);
    let (near, far) = ((5.0 + 3.0 * 5f64.sqrt()) / 20.0, (5.0 - 5f64.sqrt()) / 20.0);
    let mut T = 0.0;
    for point in 0..4 {
        let mut v = Vector3::zeros();
        for i in 0..4 {
            v += speed(element[i]) * if i == point { near } else { far };
        }
        T += density * v.norm_squared() / 2.0 * (volume / 4.0);
    }
    T
}

use nalgebra::{DVector, Vector3};

/// The mean square of the velocities and the square of their mean.
pub fn T_linear_tetrahedron(qdot: &DVector<f64>, element: &[usize; 4], density: f64, volume: f64) -> f64 {
    fn sum(qdot: &DVector<f64>, vertices: &[usize]) -> (Vector3<f64>, f64) {
        let Some((vertex, rest)) = vertices.split_first() else { return (Vector3::zeros(), 0.0) };
        let v = Vector3::from_fn(|k, _| qdot[3 * vertex + k]);
        let (all, squares) = sum(qdot, rest);
        (v + all, v.norm_squared() + squares)
    }
    let (all, squares) = sum(qdot, element);
    density * volume * (all.norm_squared() + squares) / 40.0
}

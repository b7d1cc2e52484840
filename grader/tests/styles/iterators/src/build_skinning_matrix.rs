use nalgebra::Vector3;
use nalgebra_sparse::{CooMatrix, CsrMatrix};

/// The last of those that hold a point would do as well; the best one is taken here.
pub fn build_skinning_matrix(V: &[Vector3<f64>], T: &[[usize; 4]], V_skin: &[Vector3<f64>]) -> CsrMatrix<f64> {
    let best = |x: &Vector3<f64>| {
        T.iter()
            .map(|element| (element, crate::phi_linear_tetrahedron(V, element, x)))
            .max_by(|(_, a), (_, b)| a.min().total_cmp(&b.min()))
    };
    let mut N = CooMatrix::new(V_skin.len(), V.len());
    V_skin.iter().enumerate().filter_map(|(row, x)| Some((row, best(x)?))).for_each(|(row, (element, phi))| {
        element.iter().zip(phi.iter()).for_each(|(&column, &weight)| N.push(row, column, weight));
    });
    CsrMatrix::from(&N)
}

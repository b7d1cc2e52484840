use nalgebra::{Vector3, Vector4};
use nalgebra_sparse::{CooMatrix, CsrMatrix};

/// Searches the list of elements from its head, and remembers the best one on the way.
pub fn build_skinning_matrix(V: &[Vector3<f64>], T: &[[usize; 4]], V_skin: &[Vector3<f64>]) -> CsrMatrix<f64> {
    type Found<'a> = Option<(&'a [usize; 4], Vector4<f64>)>;
    fn search<'a>(V: &[Vector3<f64>], elements: &'a [[usize; 4]], x: &Vector3<f64>, best: Found<'a>) -> Found<'a> {
        // Halves, so that the depth is the logarithm of the length.
        match elements {
            [] => best,
            [element] => {
                let phi = crate::phi_linear_tetrahedron(V, element, x);
                let is_better = best.is_none_or(|(_, best)| best.min() < -1e-6 && phi.min() > best.min());
                if is_better { Some((element, phi)) } else { best }
            }
            several => {
                let (left, right) = several.split_at(several.len() / 2);
                let best = search(V, left, x, best);
                if best.is_some_and(|(_, phi)| phi.min() >= -1e-6) { best } else { search(V, right, x, best) }
            }
        }
    }
    let mut N = CooMatrix::new(V_skin.len(), V.len());
    for (row, x) in V_skin.iter().enumerate() {
        if let Some((element, phi)) = search(V, T, x, None) {
            (0..4).for_each(|i| N.push(row, element[i], phi[i]));
        }
    }
    CsrMatrix::from(&N)
}

use nalgebra::{Vector3, Vector4};
use nalgebra_sparse::CsrMatrix;

use crate::phi_linear_tetrahedron;

/// A point counts as inside an element if no shape function is below −`TOLERANCE` there.
const TOLERANCE: f64 = 1e-6;

/// Weights N with which display vertices follow the mesh: x_skin = N x, one row per display vertex.
pub fn build_skinning_matrix(V: &[Vector3<f64>], T: &[[usize; 4]], V_skin: &[Vector3<f64>]) -> CsrMatrix<f64> {
    assert!(!T.is_empty() || V_skin.is_empty(), "{} display vertices, but no element to follow", V_skin.len());
    let boxes: Vec<_> = T.iter().map(|element| padded_box(V, element)).collect();

    let (mut columns, mut weights) = (Vec::with_capacity(4 * V_skin.len()), Vec::with_capacity(4 * V_skin.len()));
    for x in V_skin {
        let (element, phi) = first_that_holds(V, T, &boxes, x).unwrap_or_else(|| nearest(V, T, x));
        let mut entries = [0, 1, 2, 3].map(|i| (T[element][i], phi[i]));
        entries.sort_by_key(|&(vertex, _)| vertex);
        columns.extend(entries.map(|(vertex, _)| vertex));
        weights.extend(entries.map(|(_, weight)| weight));
    }
    let offsets = (0..=V_skin.len()).map(|row| 4 * row).collect();
    CsrMatrix::try_from_csr_data(V_skin.len(), V.len(), offsets, columns, weights)
        .expect("an element has four different vertices of the mesh")
}

/// The first element that contains `x`, and its shape functions there. Bounding boxes rule out most elements.
fn first_that_holds(
    V: &[Vector3<f64>],
    T: &[[usize; 4]],
    boxes: &[(Vector3<f64>, Vector3<f64>)],
    x: &Vector3<f64>,
) -> Option<(usize, Vector4<f64>)> {
    let in_box = |(low, high): &(Vector3<f64>, Vector3<f64>)| (0..3).all(|i| low[i] <= x[i] && x[i] <= high[i]);
    (0..T.len())
        .filter(|&element| in_box(&boxes[element]))
        .map(|element| (element, phi_linear_tetrahedron(V, &T[element], x)))
        .find(|(_, phi)| phi.min() >= -TOLERANCE)
}

/// The element whose smallest shape function at `x` is largest, and its shape functions there.
fn nearest(V: &[Vector3<f64>], T: &[[usize; 4]], x: &Vector3<f64>) -> (usize, Vector4<f64>) {
    let candidates = (0..T.len()).map(|element| (element, phi_linear_tetrahedron(V, &T[element], x)));
    let first = (0, phi_linear_tetrahedron(V, &T[0], x));
    candidates.fold(first, |best, next| if next.1.min() > best.1.min() { next } else { best })
}

/// Bounding box of an element, wide enough for every point that the tolerance lets in.
fn padded_box(V: &[Vector3<f64>], element: &[usize; 4]) -> (Vector3<f64>, Vector3<f64>) {
    let X = element.map(|vertex| V[vertex]);
    let (low, high) = X.iter().fold((X[0], X[0]), |(low, high), x| (low.inf(x), high.sup(x)));
    let margin = (high - low) * (10.0 * TOLERANCE);
    (low - margin, high + margin)
}

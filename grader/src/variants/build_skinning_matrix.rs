//! Mistakes in `build_skinning_matrix`.

use finite_elements_3d as solved;
use nalgebra::{Vector3, Vector4};
use nalgebra_sparse::{CooMatrix, CsrMatrix};

use super::Variant;

const TOLERANCE: f64 = 1e-6;

/// The mistakes that are known.
pub const VARIANTS: &[Variant] = &[
    variant!(
        build_skinning_matrix,
        "strict test",
        "A point on a face belongs to an element too: its row is empty, and the vertex jumps to the origin.",
        |V, T, V_skin| skinned(V, T, V_skin, |x| best(V, T, x).filter(|(_, phi)| phi.min() > 0.0))
    ),
    variant!(
        build_skinning_matrix,
        "empty row outside",
        "A display vertex may lie a little outside of all elements. It must still follow one of them.",
        |V, T, V_skin| skinned(V, T, V_skin, |x| best(V, T, x).filter(|(_, phi)| phi.min() >= -TOLERANCE))
    ),
    variant!(
        build_skinning_matrix,
        "local for global indices",
        "All weights stand in the first four columns: which vertices of the mesh do they belong to?",
        |V, T, V_skin| skinned(V, T, V_skin, |x| best(V, T, x).map(|(_, phi)| ([0, 1, 2, 3], phi)))
    ),
    variant!(
        build_skinning_matrix,
        "nearest instead of containing",
        "The element with the nearest centroid need not be the one that holds the point; a long thin one shows it.",
        |V, T, V_skin| skinned(V, T, V_skin, |x| nearest_centroid(V, T, x))
    ),
    variant!(
        build_skinning_matrix,
        "nearest centroid outside",
        "Inside all is well. Outside, how far a point is from an element is not how far it is from its middle.",
        |V, T, V_skin| skinned(V, T, V_skin, |x| {
            best(V, T, x).filter(|(_, phi)| phi.min() >= -TOLERANCE).or_else(|| nearest_centroid(V, T, x))
        })
    ),
    variant!(
        build_skinning_matrix,
        "clamped",
        "Outside, some weights must be negative, else the surface does not come back where it was.",
        |V, T, V_skin| skinned(V, T, V_skin, |x| {
            best(V, T, x).map(|(element, phi)| {
                let positive = phi.map(|weight| weight.max(0.0));
                (element, positive / positive.sum())
            })
        })
    ),
    variant!(
        build_skinning_matrix,
        "wrong vertex order",
        "The weights are right, but they are given to the wrong vertices of the element.",
        |V, T, V_skin| skinned(V, T, V_skin, |x| { best(V, T, x).map(|([a, b, c, d], phi)| ([b, c, d, a], phi)) })
    ),
    variant!(
        build_skinning_matrix,
        "one row for each coordinate",
        "The matrix is three times too large each way: it has one row for each display vertex.",
        |V, T, V_skin| {
            let N = solved::build_skinning_matrix(V, T, V_skin);
            let mut large = CooMatrix::new(3 * N.nrows(), 3 * N.ncols());
            for (row, column, &weight) in N.triplet_iter() {
                (0..3).for_each(|i| large.push(3 * row + i, 3 * column + i, weight));
            }
            CsrMatrix::from(&large)
        }
    ),
    variant!(
        build_skinning_matrix,
        "all that hold it",
        "On a shared face the row adds up to more than one: a display vertex follows a single element.",
        |V, T, V_skin| {
            let mut entries = CooMatrix::new(V_skin.len(), V.len());
            for (row, x) in V_skin.iter().enumerate() {
                let holding = T.iter().map(|element| (*element, solved::phi_linear_tetrahedron(V, element, x)));
                let holding: Vec<_> = holding.filter(|(_, phi)| phi.min() >= -TOLERANCE).collect();
                let all = if holding.is_empty() { best(V, T, x).into_iter().collect() } else { holding };
                all.iter().for_each(|(element, phi)| push(&mut entries, row, element, phi));
            }
            CsrMatrix::from(&entries)
        }
    ),
];

type Place = ([usize; 4], Vector4<f64>);

/// One row for each display vertex, from an element and its weights; an empty row without an element.
fn skinned(
    V: &[Vector3<f64>],
    T: &[[usize; 4]],
    V_skin: &[Vector3<f64>],
    place: impl Fn(&Vector3<f64>) -> Option<Place>,
) -> CsrMatrix<f64> {
    let mut entries = CooMatrix::new(V_skin.len(), V.len());
    for (row, x) in V_skin.iter().enumerate().filter(|_| !T.is_empty()) {
        if let Some((element, phi)) = place(x) {
            push(&mut entries, row, &element, &phi);
        }
    }
    CsrMatrix::from(&entries)
}

fn push(entries: &mut CooMatrix<f64>, row: usize, element: &[usize; 4], phi: &Vector4<f64>) {
    element.iter().zip(phi).for_each(|(&column, &weight)| entries.push(row, column, weight));
}

/// The element whose smallest weight is largest. It contains the point if any element does.
fn best(V: &[Vector3<f64>], T: &[[usize; 4]], x: &Vector3<f64>) -> Option<Place> {
    let places = T.iter().map(|element| (*element, solved::phi_linear_tetrahedron(V, element, x)));
    places.max_by(|(_, a), (_, b)| a.min().total_cmp(&b.min()))
}

fn nearest_centroid(V: &[Vector3<f64>], T: &[[usize; 4]], x: &Vector3<f64>) -> Option<Place> {
    let distance = |element: &[usize; 4]| (element.iter().map(|&i| V[i]).sum::<Vector3<f64>>() / 4.0 - x).norm();
    let nearest = T.iter().min_by(|a, b| distance(a).total_cmp(&distance(b)))?;
    Some((*nearest, solved::phi_linear_tetrahedron(V, nearest, x)))
}

use nalgebra::{DVector, Vector3};

/// The first element's force, added to that of the others.
pub fn assemble_forces(
    q: &DVector<f64>,
    V: &[Vector3<f64>],
    T: &[[usize; 4]],
    v0: &[f64],
    C: f64,
    D: f64,
) -> DVector<f64> {
    fn add(f: &mut DVector<f64>, q: &DVector<f64>, V: &[Vector3<f64>], elements: &[([usize; 4], f64)], C: f64, D: f64) {
        match elements {
            [] => {}
            [(element, volume)] => {
                let gradient = crate::dV_linear_tetrahedron_dq(q, V, element, *volume, C, D);
                (0..12).for_each(|local| f[3 * element[local / 3] + local % 3] -= gradient[local]);
            }
            several => {
                let (left, right) = several.split_at(several.len() / 2);
                add(f, q, V, left, C, D);
                add(f, q, V, right, C, D);
            }
        }
    }
    let elements: Vec<_> = T.iter().copied().zip(v0.iter().copied()).collect();
    let mut f = DVector::zeros(q.len());
    add(&mut f, q, V, &elements, C, D);
    f
}

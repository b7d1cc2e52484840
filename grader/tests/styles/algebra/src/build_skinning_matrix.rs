use nalgebra::Vector3;
use nalgebra_sparse::{CooMatrix, CsrMatrix};

/// A box around each element spares most of the weights.
pub fn build_skinning_matrix(V: &[Vector3<f64>], T: &[[usize; 4]], V_skin: &[Vector3<f64>]) -> CsrMatrix<f64> {
    let boxes: Vec<Bounds> = T.iter().map(|element| Bounds::around(element.map(|vertex| V[vertex]))).collect();
    let weights = |e: usize, x: &Vector3<f64>| crate::phi_linear_tetrahedron(V, &T[e], x);
    let mut N = CooMatrix::new(V_skin.len(), V.len());
    for (row, x) in V_skin.iter().enumerate() {
        let holds = |&e: &usize| boxes[e].hold(x) && weights(e, x).min() >= -1e-6;
        let chosen = (0..T.len()).find(holds).or_else(|| {
            let rank = |a: &usize, b: &usize| weights(*a, x).min().total_cmp(&weights(*b, x).min());
            (0..T.len()).max_by(rank)
        });
        if let Some(e) = chosen {
            let phi = weights(e, x);
            (0..4).for_each(|i| N.push(row, T[e][i], phi[i]));
        }
    }
    CsrMatrix::from(&N)
}

struct Bounds {
    least: Vector3<f64>,
    most: Vector3<f64>,
}

impl Bounds {
    /// With room for the slack of points on a face.
    fn around(corners: [Vector3<f64>; 4]) -> Self {
        let least = corners.iter().fold(corners[0], |least, corner| least.inf(corner));
        let most = corners.iter().fold(corners[0], |most, corner| most.sup(corner));
        let room = (most - least) * 1e-5;
        Self { least: least - room, most: most + room }
    }

    fn hold(&self, x: &Vector3<f64>) -> bool {
        (0..3).all(|axis| self.least[axis] <= x[axis] && x[axis] <= self.most[axis])
    }
}

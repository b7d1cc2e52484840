//! Fixed nodes: P eliminates their coordinates, x0 puts them back.

use nalgebra::{DVector, Vector3};
use nalgebra_sparse::CsrMatrix;

use crate::fixed_point_constraints;
use crate::given::select;

/// P, its transpose and the fixed coordinates; `None` if the scene fixes no node.
pub(super) struct Constraints(Option<Fixed>);

struct Fixed {
    P: CsrMatrix<f64>,
    P_transposed: CsrMatrix<f64>,
    /// The fixed coordinates, zero for free ones, m.
    x0: DVector<f64>,
}

impl Constraints {
    pub(super) fn new(V: &[Vector3<f64>], fixed: Option<&[usize]>) -> Self {
        Self(fixed.map(|nodes| {
            let P = fixed_point_constraints(3 * V.len(), nodes);
            let P_transposed = P.transpose();
            let X = stack(V);
            let x0 = &X - &P_transposed * (&P * &X);
            Fixed { P, P_transposed, x0 }
        }))
    }

    /// Returns true if no node is fixed.
    pub(super) fn is_free(&self) -> bool {
        self.0.as_ref().is_none_or(|fixed| fixed.P.nrows() == fixed.P.ncols())
    }

    /// `Pᵀ q + x0`: all coordinates, the free ones from q.
    pub(super) fn all_coordinates(&self, q: &DVector<f64>) -> DVector<f64> {
        match &self.0 {
            Some(fixed) => &fixed.P_transposed * q + &fixed.x0,
            None => q.clone(),
        }
    }

    /// `Pᵀ v`: all velocities, zero for fixed coordinates.
    pub(super) fn all_velocities(&self, v: &DVector<f64>) -> DVector<f64> {
        self.0.as_ref().map_or_else(|| v.clone(), |fixed| &fixed.P_transposed * v)
    }

    /// `P f`
    pub(super) fn free_coordinates(&self, f: DVector<f64>) -> DVector<f64> {
        match &self.0 {
            Some(fixed) => &fixed.P * &f,
            None => f,
        }
    }

    /// `P K Pᵀ`
    pub(super) fn free_block(&self, K: CsrMatrix<f64>) -> CsrMatrix<f64> {
        match &self.0 {
            Some(fixed) => select(&fixed.P, &K),
            None => K,
        }
    }

    pub(super) fn bytes(&self) -> usize {
        self.0.as_ref().map_or(0, |fixed| 2 * super::profile::bytes(&fixed.P) + 8 * fixed.x0.len())
    }
}

/// Positions of all vertices as one vector, m.
pub(super) fn stack(V: &[Vector3<f64>]) -> DVector<f64> {
    DVector::from_iterator(3 * V.len(), V.iter().flat_map(|x| [x.x, x.y, x.z]))
}

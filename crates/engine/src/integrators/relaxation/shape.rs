//! The elements of a body as sweeps see them, one at a time: simplices at rest.

use crate::model::system::System;
use fem_elements::number::Number;
use fem_solvers::Real;

/// The shape of a simplex at rest.
#[derive(Clone, Copy)]
pub struct Shape<const N: usize> {
    /// Gradients of the shape functions of all nodes, 1/m.
    pub gradients: [[f64; 3]; N],
    /// Volume times a factor of the element's moduli, m³.
    pub volume: f64,
}

/// The shape of a simplex at rest, its volume scaled by `factor`.
pub fn shape<T: Real, const N: usize>(system: &System<T>, corners: &[u32; N], factor: f64) -> Shape<N> {
    let x = |corner: usize| system.rest[corners[corner] as usize];
    let mut edges = nalgebra::Matrix3::identity();
    for e in 1..N {
        edges.set_column(e - 1, &(x(e) - x(0)));
    }
    let determinant = edges.determinant();
    let cofactors = fem_elements::tensor::cofactor(&fem_elements::tensor::from_fn(|i, j| edges[(i, j)]));
    let mut gradients = [[0.0; 3]; N];
    for e in 1..N {
        for j in 0..3 {
            gradients[e][j] = cofactors[j][e - 1] / determinant;
            gradients[0][j] -= gradients[e][j];
        }
    }
    let thickness = system.shape.mesh.thickness().unwrap_or(1.0);
    Shape { gradients, volume: factor * thickness * determinant.abs() / if N == 4 { 6.0 } else { 2.0 } }
}

/// a · b
#[inline(always)]
pub fn inner<L: Number>(a: &[L; 3], b: &[L; 3]) -> L {
    a[2].times_plus(b[2], a[1].times_plus(b[1], a[0] * b[0]))
}

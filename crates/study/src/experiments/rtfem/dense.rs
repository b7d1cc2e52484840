//! Linear elasticity as textbooks and the thesis write it, with dense matrices and apart from the engine: strains ε = B u in engineering
//! notation (xx, yy, zz, xy, yz, zx), element stiffness V Bᵀ C B.

use fem_engine::tensor::inverse;
use fem_mesh::TetrahedralMesh;
use nalgebra::{DMatrix, DVector, Matrix3, Matrix6, SMatrix, Vector3};

/// Elasticity matrix, Pa. Engineering shear strains need the shear modulus on its diagonal, (1 − 2ν)/2 in the common factor
/// E/((1 + ν)(1 − 2ν)); the thesis prints 1 − 2ν.
pub fn elasticity(young: f64, poisson: f64, shear: f64) -> Matrix6<f64> {
    let factor = young / ((1.0 + poisson) * (1.0 - 2.0 * poisson));
    Matrix6::from_fn(|i, j| {
        factor
            * match (i, j) {
                (i, j) if i < 3 && j < 3 => {
                    if i == j {
                        1.0 - poisson
                    } else {
                        poisson
                    }
                }
                (i, j) if i == j => shear,
                _ => 0.0,
            }
    })
}

/// Stiffness of the mesh, N/m.
pub fn stiffness(mesh: &TetrahedralMesh, C: &Matrix6<f64>) -> DMatrix<f64> {
    let size = 3 * mesh.vertices.len();
    let mut K = DMatrix::zeros(size, size);
    for element in &mesh.elements {
        let [a, b, c, d] = element.map(|i| mesh.vertices[i]);
        let edges = Matrix3::from_columns(&[b - a, c - a, d - a]);
        let volume = edges.determinant() / 6.0;
        let inverse = inverse(&edges);
        // Rows of the inverse are the gradients of the last three barycentric coordinates.
        let rest: [Vector3<f64>; 3] = std::array::from_fn(|i| inverse.row(i).transpose());
        let gradients = [-(rest[0] + rest[1] + rest[2]), rest[0], rest[1], rest[2]];
        let B = strain_matrix(&gradients);
        let of_element = B.transpose() * C * B * volume;
        for (row, &i) in element.iter().enumerate() {
            for (column, &j) in element.iter().enumerate() {
                let block = of_element.fixed_view::<3, 3>(3 * row, 3 * column);
                let mut place = K.fixed_view_mut::<3, 3>(3 * i, 3 * j);
                place += block;
            }
        }
    }
    K
}

fn strain_matrix(gradients: &[Vector3<f64>; 4]) -> SMatrix<f64, 6, 12> {
    let mut B = SMatrix::zeros();
    for (node, g) in gradients.iter().enumerate() {
        let rows =
            [[g.x, 0.0, 0.0], [0.0, g.y, 0.0], [0.0, 0.0, g.z], [g.y, g.x, 0.0], [0.0, g.z, g.y], [g.z, 0.0, g.x]];
        for (i, row) in rows.iter().enumerate() {
            for j in 0..3 {
                B[(i, 3 * node + j)] = row[j];
            }
        }
    }
    B
}

/// Displacements (m) under nodal forces (N), with some of the 3n components zero.
///
/// # Errors
/// A body that can move freely.
pub fn solve(K: &DMatrix<f64>, forces: &[Vector3<f64>], constrained: &[usize]) -> Result<Vec<Vector3<f64>>, String> {
    let mut K = K.clone();
    let mut f = DVector::from_iterator(K.nrows(), forces.iter().flat_map(|f| f.iter().copied()));
    for &i in constrained {
        K.row_mut(i).fill(0.0);
        K.column_mut(i).fill(0.0);
        K[(i, i)] = 1.0;
        f[i] = 0.0;
    }
    let factor = K.cholesky().ok_or("the stiffness is not positive definite; the body can move freely")?;
    let u = factor.solve(&f);
    Ok((0..forces.len()).map(|i| u.fixed_rows::<3>(3 * i).into_owned()).collect())
}

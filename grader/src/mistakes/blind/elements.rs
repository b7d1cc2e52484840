//! Functions of one element.

use finite_elements_3d as solved;
use nalgebra::{DVector, Matrix3, Matrix4x3, SMatrix, SVector, Vector3, Vector4};

use super::super::Mistake;

/// The mistakes of this set.
pub const MISTAKES: &[Mistake] = &[
    // φ0 leaves out φ3
    wrong!(phi_linear_tetrahedron, ["one vertex left out of the sum"], |V, element, x| {
        let X = element.map(|i| V[i]);
        let T = Matrix3::from_columns(&[X[1] - X[0], X[2] - X[0], X[3] - X[0]]);
        let p = T.try_inverse().unwrap() * (x - X[0]);
        Vector4::new(1.0 - p[0] - p[1], p[0], p[1], p[2])
    }),
    // edges as rows (transposed)
    wrong!(phi_linear_tetrahedron, ["transposed"], |V, element, x| {
        let X = element.map(|i| V[i]);
        let T = Matrix3::from_rows(&[(X[1] - X[0]).transpose(), (X[2] - X[0]).transpose(), (X[3] - X[0]).transpose()]);
        let p = T.try_inverse().unwrap() * (x - X[0]);
        Vector4::new(1.0 - p[0] - p[1] - p[2], p[0], p[1], p[2])
    }),
    // absolute values of the volumes
    wrong!(phi_linear_tetrahedron, ["unsigned volumes"], |V, element, x| {
        let X = element.map(|i| V[i]);
        let volume = |a: Vector3<f64>, b: Vector3<f64>, c: Vector3<f64>, d: Vector3<f64>| {
            (b - a).dot(&(c - a).cross(&(d - a))).abs()
        };
        let whole = volume(X[0], X[1], X[2], X[3]);
        Vector4::new(
            volume(*x, X[1], X[2], X[3]) / whole,
            volume(X[0], *x, X[2], X[3]) / whole,
            volume(X[0], X[1], *x, X[3]) / whole,
            volume(X[0], X[1], X[2], *x) / whole,
        )
    }),
    // one edge starts at the wrong vertex
    wrong!(phi_linear_tetrahedron, ["edges of another vertex"], |V, element, x| {
        let X = element.map(|i| V[i]);
        let T = Matrix3::from_columns(&[X[1] - X[0], X[2] - X[0], X[3] - X[1]]);
        let p = T.try_inverse().unwrap() * (x - X[0]);
        Vector4::new(1.0 - p[0] - p[1] - p[2], p[0], p[1], p[2])
    }),
    // x in place of x - X0
    wrong!(phi_linear_tetrahedron, ["point taken for an offset"], |V, element, x| {
        let X = element.map(|i| V[i]);
        let T = Matrix3::from_columns(&[X[1] - X[0], X[2] - X[0], X[3] - X[0]]);
        let p = T.try_inverse().unwrap() * x;
        Vector4::new(1.0 - p[0] - p[1] - p[2], p[0], p[1], p[2])
    }),
    // inverse transposed
    wrong!(dphi_linear_tetrahedron_dX, ["transposed"], |V, element, _X| {
        let X = element.map(|i| V[i]);
        let T = Matrix3::from_rows(&[(X[1] - X[0]).transpose(), (X[2] - X[0]).transpose(), (X[3] - X[0]).transpose()]);
        let inverse = T.try_inverse().unwrap();
        let mut dphi = Matrix4x3::zeros();
        dphi.fixed_rows_mut::<3>(1).copy_from(&inverse);
        for j in 0..3 {
            dphi[(0, j)] = -inverse.column(j).sum();
        }
        dphi
    }),
    // sign of the first row
    wrong!(dphi_linear_tetrahedron_dX, ["barycentric sign"], |V, element, _X| {
        let X = element.map(|i| V[i]);
        let inverse = Matrix3::from_columns(&[X[1] - X[0], X[2] - X[0], X[3] - X[0]]).try_inverse().unwrap();
        let mut dphi = Matrix4x3::zeros();
        dphi.fixed_rows_mut::<3>(1).copy_from(&inverse);
        for j in 0..3 {
            dphi[(0, j)] = inverse.column(j).sum();
        }
        dphi
    }),
    // first row sums rows in place of columns
    wrong!(dphi_linear_tetrahedron_dX, ["rows for columns in the sum"], |V, element, _X| {
        let X = element.map(|i| V[i]);
        let inverse = Matrix3::from_columns(&[X[1] - X[0], X[2] - X[0], X[3] - X[0]]).try_inverse().unwrap();
        let mut dphi = Matrix4x3::zeros();
        dphi.fixed_rows_mut::<3>(1).copy_from(&inverse);
        for j in 0..3 {
            dphi[(0, j)] = -inverse.row(j).sum();
        }
        dphi
    }),
    // local numbers for global ones
    wrong!(dphi_linear_tetrahedron_dX, ["local for global indices"], |V, _element, X| {
        solved::dphi_linear_tetrahedron_dX(V, &[0, 1, 2, 3], X)
    }),
    // first vertex in place of the centroid
    wrong!(quadrature_single_point, ["evaluated at the wrong point"], |V, element, volume, integrand| {
        integrand(&V[element[0]]) * volume
    }),
    // divided by three
    wrong!(quadrature_single_point, ["divided by 3"], |V, element, volume, integrand| {
        let [a, b, c, d] = *element;
        integrand(&((V[a] + V[b] + V[c] + V[d]) / 3.0)) * volume
    }),
    // a factor 1/6
    wrong!(quadrature_single_point, ["scaled by 1/6"], |V, element, volume, integrand| {
        let [a, b, c, d] = *element;
        integrand(&((V[a] + V[b] + V[c] + V[d]) / 4.0)) * (volume / 6.0)
    }),
    // the last vertex left out of the centroid
    wrong!(quadrature_single_point, ["at the mean of three vertices divided by 4"], |V, element, volume, integrand| {
        let mut x = Vector3::zeros();
        for a in 0..3 {
            x += V[element[a]];
        }
        integrand(&(x / 4.0)) * volume
    }),
    // lumped mass
    wrong!(T_linear_tetrahedron, ["lumped"], |qdot, element, density, volume| {
        element.iter().map(|&v| 0.5 * density * volume / 4.0 * qdot.fixed_rows::<3>(3 * v).norm_squared()).sum()
    }),
    // local numbers for global ones
    wrong!(T_linear_tetrahedron, ["local for global indices"], |qdot, _element, density, volume| {
        let M = solved::mass_matrix_linear_tetrahedron(density, volume);
        let v = SVector::<f64, 12>::from_fn(|i, _| qdot[i]);
        0.5 * v.dot(&(M * v))
    }),
    // energy of the mean velocity alone
    wrong!(T_linear_tetrahedron, ["only the centroid"], |qdot, element, density, volume| {
        let mean = element.iter().map(|&v| qdot.fixed_rows::<3>(3 * v).into_owned()).sum::<Vector3<f64>>() / 4.0;
        0.5 * density * volume * mean.norm_squared()
    }),
    // y read for z
    wrong!(
        T_linear_tetrahedron,
        ["the velocity along y scaled by 2 and missing the velocity along z"],
        |qdot, element, density, volume| {
            let M = solved::mass_matrix_linear_tetrahedron(density, volume);
            let mut v = SVector::<f64, 12>::zeros();
            for a in 0..4 {
                v[3 * a] = qdot[3 * element[a]];
                v[3 * a + 1] = qdot[3 * element[a] + 1];
                v[3 * a + 2] = qdot[3 * element[a] + 1];
            }
            0.5 * v.dot(&(M * v))
        }
    ),
    // 3 * left out of the index
    wrong!(T_linear_tetrahedron, ["factor 3 left out in q"], |qdot, element, density, volume| {
        let M = solved::mass_matrix_linear_tetrahedron(density, volume);
        let v = SVector::<f64, 12>::from_fn(|i, _| qdot[element[i / 3] + i % 3]);
        0.5 * v.dot(&(M * v))
    }),
    // lumped
    wrong!(mass_matrix_linear_tetrahedron, ["lumped"], |density, volume| {
        SMatrix::<f64, 12, 12>::identity() * (density * volume / 4.0)
    }),
    // x, y and z mixed: blocks are full
    wrong!(mass_matrix_linear_tetrahedron, ["x pushes y"], |density, volume| {
        SMatrix::<f64, 12, 12>::from_fn(|i, j| density * volume / 20.0 * if i / 3 == j / 3 { 2.0 } else { 1.0 })
    }),
    // ordered by components
    wrong!(mass_matrix_linear_tetrahedron, ["grouped by coordinate"], |density, volume| {
        SMatrix::<f64, 12, 12>::from_fn(|i, j| {
            if i / 4 != j / 4 {
                0.0
            } else if i == j {
                density * volume / 10.0
            } else {
                density * volume / 20.0
            }
        })
    }),
    // volume twice
    wrong!(V_linear_tetrahedron, ["scaled by volume"], |q, V, element, volume, C, D| {
        solved::quadrature_single_point(V, element, volume, |X| {
            let dphi = solved::dphi_linear_tetrahedron_dX(V, element, X);
            volume * solved::psi_neo_hookean(&solved::given::deformation_gradient(q, element, &dphi), C, D)
        })
    }),
    // C and D exchanged
    wrong!(V_linear_tetrahedron, ["C and D swapped"], |q, V, element, volume, C, D| {
        solved::quadrature_single_point(V, element, volume, |X| {
            let dphi = solved::dphi_linear_tetrahedron_dX(V, element, X);
            solved::psi_neo_hookean(&solved::given::deformation_gradient(q, element, &dphi), D, C)
        })
    }),
    // displacement gradient without the identity
    wrong!(V_linear_tetrahedron, ["displacement gradient for F"], |q, V, element, volume, C, D| {
        let u = DVector::from_fn(q.len(), |i, _| q[i] - V[i / 3][i % 3]);
        solved::quadrature_single_point(V, element, volume, |X| {
            let dphi = solved::dphi_linear_tetrahedron_dX(V, element, X);
            solved::psi_neo_hookean(&solved::given::deformation_gradient(&u, element, &dphi), C, D)
        })
    }),
    // stress transposed
    wrong!(dV_linear_tetrahedron_dq, ["transposed"], |q, V, element, volume, C, D| {
        let (dphi, F) = F_of(q, V, element);
        let P = Matrix3::from_column_slice(solved::dpsi_neo_hookean_dF(&F, C, D).as_slice());
        SVector::<f64, 12>::from_column_slice((P * dphi.transpose() * volume).as_slice())
    }),
    // all x first, then y, then z
    wrong!(dV_linear_tetrahedron_dq, ["grouped by coordinate"], |q, V, element, volume, C, D| {
        let (dphi, F) = F_of(q, V, element);
        let P = Matrix3::from_row_slice(solved::dpsi_neo_hookean_dF(&F, C, D).as_slice());
        SVector::<f64, 12>::from_column_slice((dphi * P.transpose() * volume).as_slice())
    }),
    // volume left out
    wrong!(dV_linear_tetrahedron_dq, ["missing volume"], |q, V, element, _volume, C, D| {
        let (dphi, F) = F_of(q, V, element);
        B_of(&dphi).transpose() * solved::dpsi_neo_hookean_dF(&F, C, D)
    }),
    // no force on the first vertex
    wrong!(dV_linear_tetrahedron_dq, ["missing term"], |q, V, element, volume, C, D| {
        let (mut dphi, F) = F_of(q, V, element);
        dphi.fixed_rows_mut::<1>(0).fill(0.0);
        B_of(&dphi).transpose() * solved::dpsi_neo_hookean_dF(&F, C, D) * volume
    }),
    // projected
    wrong!(d2V_linear_tetrahedron_dq2, ["projected"], |q, V, element, volume, C, D| {
        let (dphi, F) = F_of(q, V, element);
        let B = B_of(&dphi);
        solved::given::project(&(B.transpose() * solved::d2psi_neo_hookean_dF2(&F, C, D) * B * volume))
    }),
    // sign
    wrong!(d2V_linear_tetrahedron_dq2, ["negated"], |q, V, element, volume, C, D| {
        let (dphi, F) = F_of(q, V, element);
        let B = B_of(&dphi);
        B.transpose() * solved::d2psi_neo_hookean_dF2(&F, C, D) * B * -volume
    }),
    // B flattens F by columns
    wrong!(d2V_linear_tetrahedron_dq2, ["columns for rows"], |q, V, element, volume, C, D| {
        let (dphi, F) = F_of(q, V, element);
        let mut B = SMatrix::<f64, 9, 12>::zeros();
        for a in 0..4 {
            for i in 0..3 {
                for j in 0..3 {
                    B[(i + 3 * j, 3 * a + i)] = dphi[(a, j)];
                }
            }
        }
        B.transpose() * solved::d2psi_neo_hookean_dF2(&F, C, D) * B * volume
    }),
    // stiffness of the undeformed element
    wrong!(d2V_linear_tetrahedron_dq2, ["rest for deformed"], |_q, V, element, volume, C, D| {
        let dphi = solved::dphi_linear_tetrahedron_dX(V, element, &V[element[0]]);
        let B = B_of(&dphi);
        B.transpose() * solved::d2psi_neo_hookean_dF2(&Matrix3::identity(), C, D) * B * volume
    }),
];

fn F_of(q: &DVector<f64>, V: &[Vector3<f64>], element: &[usize; 4]) -> (Matrix4x3<f64>, Matrix3<f64>) {
    let dphi = solved::dphi_linear_tetrahedron_dX(V, element, &V[element[0]]);
    (dphi, solved::given::deformation_gradient(q, element, &dphi))
}
fn B_of(dphi: &Matrix4x3<f64>) -> SMatrix<f64, 9, 12> {
    let mut B = SMatrix::<f64, 9, 12>::zeros();
    for a in 0..4 {
        for i in 0..3 {
            for j in 0..3 {
                B[(3 * i + j, 3 * a + i)] = dphi[(a, j)];
            }
        }
    }
    B
}

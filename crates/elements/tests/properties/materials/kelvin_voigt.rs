//! Kelvin–Voigt damping: dissipation of any velocity gradient, none of a rigid motion.

use super::*;
use fem_elements::materials::KelvinVoigt;
use fem_elements::tensor::{dot, from_fn, plus_identity, product, transpose, volume_change};
use nalgebra::Matrix3;

const DAMPING: KelvinVoigt<f64> = KelvinVoigt { mu: MU, lambda: LAMBDA };

/// H : Ḟ
fn stress(G: &Tensor<f64>, rate: &Tensor<f64>) -> Tensor<f64> {
    let H = DAMPING.derivative(G);
    from_fn(|i, j| (0..9).map(|column| H[3 * i + j][column] * rate[column / 3][column % 3]).sum())
}

/// U̇ from U̇ U + U U̇ = Ċ of C = FᵀF, in the eigenvectors of C.
fn stretch_rate(F: &Tensor<f64>, rate: &Tensor<f64>) -> Matrix3<f64> {
    let [F, rate] = [F, rate].map(|a| Matrix3::from_fn(|i, j| a[i][j]));
    let squares = (F.transpose() * F).symmetric_eigen();
    let (Q, sigma) = (squares.eigenvectors, squares.eigenvalues.map(f64::sqrt));
    let of_square = Q.transpose() * (F.transpose() * rate + rate.transpose() * F) * Q;
    Matrix3::from_fn(|i, j| of_square[(i, j)] / (sigma[i] + sigma[j]))
}

/// 2μ U̇:U̇ + λ tr(U̇)²
fn dissipation(rate: &Matrix3<f64>) -> f64 {
    2.0 * MU * rate.norm_squared() + LAMBDA * rate.trace().powi(2)
}

/// Any deformations, inverted ones among them.
fn deformations() -> Vec<Tensor<f64>> {
    let mut random = Random(21);
    (0..100).map(|_| from_fn(|_, _| 2.0 * random.number())).collect()
}

#[test]
fn the_damping_dissipates_the_work_of_the_rate_of_the_stretch_and_never_less_than_zero() {
    let mut random = Random(22);
    for G in deformations() {
        let (F, rate) = (plus_identity(&G), from_fn(|_, _| random.number()));
        let dissipated = dot(&stress(&G, &rate), &rate);
        let size = largest(&rate) * (MU + LAMBDA);
        assert!(distance(&DAMPING.derivative_times(&G, &rate), &stress(&G, &rate)) < 1e-12 * size, "{G:?}");
        if 1.0 + volume_change(&G).0 > 0.01 {
            let expected = dissipation(&stretch_rate(&F, &rate));
            assert!((dissipated - expected).abs() < 1e-9 * (1.0 + expected), "{dissipated} of {expected} at {G:?}");
        }
        let H = nalgebra::SMatrix::<f64, 9, 9>::from_fn(|i, j| DAMPING.derivative(&G)[i][j]);
        assert!((H - H.transpose()).amax() < 1e-14 * H.amax(), "{G:?}");
        assert!(H.symmetric_eigenvalues().min() > -1e-13 * H.amax(), "{G:?}");
    }
}

#[test]
fn a_rigid_motion_has_no_damping_and_no_other_motion_a_torque() {
    let mut random = Random(23);
    for G in deformations() {
        let F = plus_identity(&G);
        let [x, y, z] = [0, 1, 2].map(|_| random.number());
        let spin = product(&[[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]], &F);
        let size = largest(&F).powi(3) * (MU + LAMBDA);
        assert!(largest(&stress(&G, &spin)) < 1e-13 * size, "{G:?}");
        let rate = from_fn(|_, _| random.number());
        let kirchhoff = product(&stress(&G, &rate), &transpose(&F));
        assert!(distance(&kirchhoff, &transpose(&kirchhoff)) < 1e-13 * size, "{G:?}");
    }
}

#[test]
fn the_damping_of_the_undeformed_body_is_the_stiffness_of_every_law() {
    for_all_laws(|name, law| {
        let G = [[0.0; 3]; 3];
        let (H, K) = (DAMPING.derivative(&G), law.derivative(&G));
        let pairs = H.as_flattened().iter().zip(K.as_flattened());
        let difference = pairs.map(|(h, k)| (h - k).abs()).fold(0.0, f64::max);
        assert!(difference < 1e-12 * (MU + LAMBDA), "{name}: {difference}");
    });
}

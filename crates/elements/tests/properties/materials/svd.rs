//! The signed singular value decomposition.

use super::{Random, any, diagonal, distance, largest, upright};
use fem_elements::number::Float;
use fem_elements::svd::svd;
use fem_elements::tensor::{Tensor, from_fn, plus_identity, product, transpose};

fn determinant(a: &Tensor<f64>) -> f64 {
    nalgebra::Matrix3::from_fn(|i, j| a[i][j]).determinant()
}

fn check(F: &Tensor<f64>) {
    let found = svd(F);
    for basis in [found.U, found.V] {
        assert!(distance(&product(&basis, &transpose(&basis)), &diagonal([1.0; 3])) < 4e-15, "{F:?} gives {found:?}");
        assert!(determinant(&basis) > 0.0, "{F:?} gives {found:?}");
    }
    let error = distance(&found.with_values(&found.sigma), F);
    assert!(error <= 1e-14 * largest(F), "{F:?}: {error:e}, {found:?}");
    // Both bases are right-handed, which determines the sign of the last.
    let [first, second, third] = found.sigma;
    let tolerance = 1e-15 * first;
    assert!(first + tolerance >= second && second + tolerance >= third.abs(), "{F:?} gives {found:?}");
}

#[test]
fn two_rotations_and_sorted_stretches_reproduce_any_matrix() {
    upright().iter().chain(&any()).map(plus_identity).for_each(|F| check(&F));
}

#[test]
fn stretches_far_apart_or_close_together_lose_no_digits() {
    let mut random = Random(3);
    for n in 0..2000 {
        let (U, V) = (random.rotation(), random.rotation());
        let spread = 10f64.powf(8.0 * random.number());
        let near = 1.0 + 10f64.powi(-(n % 17));
        let sigma = match n % 4 {
            0 => [1.0, near, spread],
            1 => [spread, spread * near, 1.0],
            2 => [spread * spread, spread, 1.0],
            _ => [1.0, near, -near * near],
        };
        check(&product(&product(&U, &diagonal(sigma)), &V));
    }
}

#[test]
fn the_nearest_rotation_is_the_rotation_of_a_stretched_body() {
    let mut random = Random(11);
    for n in 0..500 {
        let (Q, V) = (random.rotation(), random.rotation());
        // Stretches from nearly equal to far apart, with an inversion smaller than the other stretches.
        let sigma = [1.0 + 10f64.powi(-(n % 17)), 1.0, if n % 2 == 0 { 0.1 } else { -0.1 }];
        let stretch = product(&product(&V, &diagonal(sigma)), &transpose(&V));
        let R = svd(&product(&Q, &stretch)).with_values(&[1.0; 3]);
        assert!(distance(&R, &Q) < 2e-14, "{sigma:?}: {:e}", distance(&R, &Q));
    }
}

#[test]
fn entries_too_large_or_too_small_to_be_squared_lose_no_digits() {
    let mut random = Random(4);
    for size in [1e-300, 1e-160, 1e160, 1e300] {
        check(&random.tensor(size));
    }
}

#[test]
fn lanes_of_single_precision_have_errors_of_single_round_off() {
    let gradients = any();
    for batch in gradients.chunks_exact(f32::WIDTH) {
        let F: Vec<_> = batch.iter().map(plus_identity).collect();
        let lanes: Tensor<<f32 as Float>::Lanes> = from_fn(|i, j| f32::lanes(|lane| F[lane][i][j] as f32));
        let found = svd(&lanes);
        let again = found.with_values(&found.sigma);
        for (lane, F) in F.iter().enumerate() {
            let again = from_fn(|i, j| f64::from(f32::each(&again[i][j])[lane]));
            assert!(distance(&again, F) <= 4e-6 * largest(F), "{F:?} gives {again:?}");
        }
    }
}

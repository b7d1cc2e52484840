//! The rotation in closed form against the singular value decomposition.

use fem_elements::number::{Float, Number};
use fem_elements::polar::SpaceRotation;
use fem_elements::svd::svd;
use fem_elements::tensor::{Tensor, from_fn, plus_identity, product, transpose};

/// Numbers between −1 and 1, the same in every run: Knuth's linear congruential generator.
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }

    fn tensor(&mut self, size: f64) -> Tensor<f64> {
        from_fn(|_, _| size * self.next())
    }

    /// A rotation by any angle about any axis.
    fn rotation(&mut self) -> Tensor<f64> {
        let F = svd(&self.tensor(1.0));
        from_fn(|i, j| F.U[j][i])
    }
}

/// The largest difference of entries.
fn distance(a: &Tensor<f64>, b: &Tensor<f64>) -> f64 {
    a.as_flattened().iter().zip(b.as_flattened()).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// G of F = R S with these stretches.
fn stretched(random: &mut Random, stretches: [f64; 3]) -> Tensor<f64> {
    let (R, V) = (random.rotation(), random.rotation());
    let scaled = from_fn(|i, j| R[i][j] * stretches[j]);
    let mut G = product(&scaled, &transpose(&V));
    (0..3).for_each(|i| G[i][i] -= 1.0);
    G
}

fn error<T: Float + Number<Element = T>>(G: &Tensor<f64>) -> Option<f64> {
    let F = svd(&plus_identity(G));
    let expected = F.with_values(&[1.0; 3]);
    let found = SpaceRotation::of(&from_fn(|i, j| <T as Float>::of(G[i][j])))?;
    let strain = F.sigma.iter().sum::<f64>() - 3.0;
    let size = F.sigma[0];
    let rotation = found.rotation().map(|row| row.map(Float::as_f64));
    Some(distance(&rotation, &expected).max((Float::as_f64(found.strain) - strain).abs() / size))
}

#[test]
fn the_closed_form_is_the_rotation_of_the_singular_value_decomposition() {
    let mut random = Random(1);
    for stretches in [[1.0; 3], [1.5, 1.0, 0.7], [3.0, 0.4, 0.3], [10.0, 1.0, 0.2], [1.0, 0.9, 0.0], [1.0, 0.8, -0.4]] {
        for _ in 0..200 {
            let G = stretched(&mut random, stretches);
            let (double, single) = (error::<f64>(&G), error::<f32>(&G));
            assert!(double.is_some_and(|error| error < 1e-13), "{stretches:?}: {double:?}");
            assert!(single.is_some_and(|error| error < 1e-4), "{stretches:?}, f32: {single:?}");
        }
    }
}

#[test]
fn where_two_stretches_nearly_cancel_there_is_no_closed_form() {
    let mut random = Random(2);
    for stretches in [[1.0, 0.5, -0.5], [1.0, 0.0, 0.0], [1.0, 1.0, -1.0], [1.0, 1e-3, 1e-3]] {
        let G = stretched(&mut random, stretches);
        assert!(SpaceRotation::of(&G).is_none(), "{stretches:?}");
    }
    assert!(SpaceRotation::of(&[[f64::NAN; 3]; 3]).is_none());
}

#[test]
fn near_rest_strain_and_change_of_the_rotation_keep_their_digits() {
    let mut random = Random(3);
    for size in [1e-3, 1e-6, 1e-9, 1e-12] {
        for _ in 0..100 {
            let G = random.tensor(size);
            let found = SpaceRotation::of(&G).expect("a well-conditioned rotation");
            // To first order R − 1 is the skew part of G, and the strain its trace; terms of second order follow.
            let skew = from_fn(|i, j| 0.5 * (G[i][j] - G[j][i]));
            let trace = G[0][0] + G[1][1] + G[2][2];
            let tolerance = size * (10.0 * size + 1e-14);
            assert!(distance(&found.change, &skew) < tolerance, "{G:?}");
            assert!((found.strain - trace).abs() < tolerance, "{G:?}");
        }
    }
    let rest = SpaceRotation::of(&[[0.0; 3]; 3]).expect("a well-conditioned rotation");
    assert_eq!((rest.change, rest.strain), ([[0.0; 3]; 3], 0.0));
}

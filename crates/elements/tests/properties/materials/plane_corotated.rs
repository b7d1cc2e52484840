//! The corotated law of flat bodies.

use super::*;
use fem_elements::materials::PlaneCorotated;
use fem_elements::svd::svd_in_plane;
use fem_elements::tensor::{from_fn, plus_identity, product, transpose, zero};

const LAW: PlaneCorotated<f64> = PlaneCorotated { mu: MU, lambda: LAMBDA };

/// The entries of a flattened tensor within the plane.
const IN_PLANE: [usize; 4] = [0, 1, 3, 4];

/// G with random entries in [−size, size] within the plane.
fn gradient(random: &mut Random, size: f64) -> Tensor<f64> {
    let G = random.tensor(size);
    from_fn(|i, j| if i < 2 && j < 2 { G[i][j] } else { 0.0 })
}

/// det F
fn determinant(G: &Tensor<f64>) -> f64 {
    (1.0 + G[0][0]) * (1.0 + G[1][1]) - G[0][1] * G[1][0]
}

/// σ_1 + σ_2, which is zero on the crease.
fn trace_of_stretch(G: &Tensor<f64>) -> f64 {
    (2.0 + G[0][0] + G[1][1]).hypot(G[1][0] - G[0][1])
}

#[test]
fn it_is_the_law_in_space_where_triangles_are_not_inverted() {
    let (mut random, in_space) = (Random(21), corotated::<f64>());
    for n in 0..500 {
        let G = gradient(&mut random, 1e-9 * 1.05f64.powi(n % 420));
        if determinant(&G) < 0.01 {
            continue;
        }
        let (energy, P, H) = (in_space.energy(&G), in_space.stress(&G), in_space.derivative(&G));
        assert!((LAW.energy(&G) - energy).abs() <= 1e-12 * energy, "{G:?}: {} and {energy}", LAW.energy(&G));
        // Singular values and vectors of F near rest have the digits of F, not of G.
        assert!(distance(&LAW.stress(&G), &P) <= 1e-13 * largest(&P) + 1e-15 * (MU + LAMBDA), "{G:?}");
        assert_eq!(LAW.energy_and_stress(&G), (LAW.energy(&G), LAW.stress(&G)));
        let projected = in_space.projected_derivative(&G);
        for (found, expected) in [(LAW.derivative(&G), H), (LAW.projected_derivative(&G), projected)] {
            for row in IN_PLANE {
                for column in IN_PLANE {
                    let error = (found[row][column] - expected[row][column]).abs();
                    assert!(error <= 1e-12 * largest(&H), "{G:?}: {error:e}");
                }
            }
        }
    }
}

#[test]
fn stress_and_derivative_agree_with_differences_in_inverted_triangles_too() {
    let (mut random, mut inverted) = (Random(22), 0);
    for _ in 0..400 {
        let G = gradient(&mut random, 2.0);
        if trace_of_stretch(&G) < 0.2 {
            continue;
        }
        inverted += usize::from(determinant(&G) < 0.0);
        let (P, H, h) = (LAW.stress(&G), LAW.derivative(&G), 1e-5);
        for k in IN_PLANE {
            let moved = |by: f64| {
                let mut G = G;
                G[k / 3][k % 3] += by;
                G
            };
            let (plus, minus) = (moved(h), moved(-h));
            let slope = (LAW.energy(&plus) - LAW.energy(&minus)) / (2.0 * h);
            assert!((slope - P[k / 3][k % 3]).abs() < 1e-7, "{G:?}: {slope}");
            let (plus, minus) = (LAW.stress(&plus), LAW.stress(&minus));
            for i in IN_PLANE {
                let slope = (plus[i / 3][i % 3] - minus[i / 3][i % 3]) / (2.0 * h);
                assert!((slope - H[i][k]).abs() < 1e-6 * (1.0 + largest(&H)), "{G:?}: {slope} and {}", H[i][k]);
            }
        }
    }
    assert!(inverted > 50, "{inverted} inverted triangles");
}

#[test]
fn the_energy_is_the_least_over_all_rotations_of_the_plane() {
    let mut random = Random(23);
    for _ in 0..100 {
        let G = gradient(&mut random, 2.0);
        let energy = |angle: f64| {
            let (s, c) = angle.sin_cos();
            let D = [[1.0 + G[0][0] - c, G[0][1] + s], [G[1][0] - s, 1.0 + G[1][1] - c]];
            D.as_flattened().iter().map(|entry| entry * entry).sum::<f64>()
        };
        let least =
            (0..3600).map(|n| energy(f64::from(n) * std::f64::consts::PI / 1800.0)).fold(f64::INFINITY, f64::min);
        let found = PlaneCorotated { mu: 1.0, lambda: 0.0 }.energy(&G);
        assert!((least - 1e-4..=least + 1e-12).contains(&found), "{found} instead of {least}, {G:?}");
    }
}

#[test]
fn the_projected_derivative_has_no_negative_eigenvalue() {
    let mut random = Random(24);
    for _ in 0..200 {
        let H = LAW.projected_derivative(&gradient(&mut random, 1.5));
        assert!(eigenvalues(&H)[0] >= -1e-13 * largest(&H));
    }
}

#[test]
fn stretches_of_the_plane_reproduce_the_deformation_and_the_second_has_the_sign_of_its_determinant() {
    let mut random = Random(25);
    for n in 0..500 {
        let mut G = gradient(&mut random, 2.0);
        match n % 10 {
            0 => G = zero(),
            1 => (G[0][0], G[1][1], G[0][1], G[1][0]) = (-2.0, 0.0, 0.0, 0.0),
            2 => (G[0][0], G[1][1], G[0][1], G[1][0]) = (-1.0, -1.0, 0.0, 0.0),
            _ => {}
        }
        let found = svd_in_plane(&G);
        let F = plus_identity(&G);
        assert!(distance(&found.with_values(&found.sigma), &F) < 1e-14 * largest(&F), "{F:?} gives {found:?}");
        for basis in [found.U, found.V] {
            assert!(distance(&product(&basis, &transpose(&basis)), &diagonal([1.0; 3])) < 4e-15, "{found:?}");
        }
        let [first, second, third] = found.sigma;
        assert!(third == 1.0 && first >= second.abs() - 1e-15 && (first * second - determinant(&G)).abs() < 1e-13);
    }
}

#[test]
fn no_rotation_is_preferred_where_all_are_as_near() {
    let mut mirrored = zero();
    mirrored[0][0] = -2.0;
    let P = LAW.stress(&mirrored);
    assert!(P.as_flattened().iter().all(|entry| entry.is_finite()) && LAW.energy(&mirrored).is_finite());
    assert!(LAW.derivative(&mirrored).as_flattened().iter().all(|entry| entry.is_finite()));
}

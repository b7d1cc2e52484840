//! Both models on single elements: derivatives, rotations, closed forms, dissipation.

mod additive;
mod j2;

use fem_elements::materials::Law;
use fem_elements::plasticity::{Additive, Internal, J2};
use fem_elements::tensor::{Tensor, from_fn, plus_identity, product};

/// Evenly spread numbers in [−1, 1], the same in every run: SplitMix64 by Steele, Lea and Flood (2014).
struct Random(u64);

impl Random {
    fn number(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }

    /// Entries in [−size, size].
    fn tensor(&mut self, size: f64) -> Tensor<f64> {
        from_fn(|_, _| size * self.number())
    }

    fn rotation(&mut self) -> Tensor<f64> {
        let [w, x, y, z]: [f64; 4] = std::array::from_fn(|_| self.number());
        let q = nalgebra::UnitQuaternion::from_quaternion(nalgebra::Quaternion::new(w, x, y, z));
        let R = q.to_rotation_matrix();
        from_fn(|i, j| R[(i, j)])
    }
}

fn minus_identity(F: &Tensor<f64>) -> Tensor<f64> {
    from_fn(|i, j| F[i][j] - f64::from(u8::from(i == j)))
}

fn norm(a: &Tensor<f64>) -> f64 {
    fem_elements::tensor::dot(a, a).sqrt()
}

fn difference(a: &Tensor<f64>, b: &Tensor<f64>) -> f64 {
    norm(&from_fn(|i, j| a[i][j] - b[i][j]))
}

/// Errors of central differences of the energy and of the stress, relative to the largest derivative.
fn errors(law: &dyn Law<f64>, G: &Tensor<f64>) -> (f64, f64) {
    let (P, H, h) = (law.stress(G), law.derivative(G), 1e-5);
    let size = H.as_flattened().iter().fold(0.0f64, |size, entry| size.max(entry.abs()));
    let (mut of_stress, mut of_derivative) = (0.0f64, 0.0f64);
    for k in 0..9 {
        let (mut plus, mut minus) = (*G, *G);
        plus[k / 3][k % 3] += h;
        minus[k / 3][k % 3] -= h;
        let slope = (law.energy(&plus) - law.energy(&minus)) / (2.0 * h);
        of_stress = of_stress.max((slope - P[k / 3][k % 3]).abs());
        let (plus, minus) = (law.stress(&plus), law.stress(&minus));
        for i in 0..9 {
            let slope = (plus[i / 3][i % 3] - minus[i / 3][i % 3]) / (2.0 * h);
            of_derivative = of_derivative.max((slope - H[i][k]).abs());
        }
    }
    (of_stress / size, of_derivative / size)
}

fn assert_consistent(law: &dyn Law<f64>, G: &Tensor<f64>) {
    let (of_stress, of_derivative) = errors(law, G);
    assert!(of_stress < 1e-8 && of_derivative < 1e-6, "{of_stress:e} {of_derivative:e} at {G:?}");
    let (energy, P) = law.energy_and_stress(G);
    assert!(energy == law.energy(G) && P == law.stress(G), "{G:?}");
    let H = nalgebra::SMatrix::<f64, 9, 9>::from_fn(|i, j| law.derivative(G)[i][j]);
    assert!((H - H.transpose()).amax() < 1e-13 * H.amax(), "{G:?}");
    let raised = nalgebra::SMatrix::<f64, 9, 9>::from_fn(|i, j| law.projected_derivative(G)[i][j]);
    assert!(raised.symmetric_eigenvalues().min() > -1e-12 * H.amax(), "{G:?}");
    if H.symmetric_eigenvalues().min() > 1e-9 * H.amax() {
        assert!((raised - H).amax() < 1e-11 * H.amax(), "{G:?}");
    }
}

/// A rotation after the deformation rotates the stress and keeps the energy.
fn assert_objective(law: &dyn Law<f64>, G: &Tensor<f64>, Q: &Tensor<f64>) {
    let turned = minus_identity(&product(Q, &plus_identity(G)));
    let (P, size) = (law.stress(G), norm(&law.stress(G)) + 1.0);
    assert!((law.energy(&turned) - law.energy(G)).abs() < 1e-12 * size, "{G:?}");
    assert!(difference(&law.stress(&turned), &product(Q, &P)) < 1e-12 * size, "{G:?}");
}

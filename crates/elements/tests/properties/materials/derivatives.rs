//! Stress against differences of the energy, stress derivative against differences of the stress.

use super::*;
use fem_elements::svd::svd;
use fem_elements::tensor::plus_identity;

/// Largest errors of central differences with step h, relative to the largest entry: of the stress, of its derivative.
fn errors(law: &dyn Law<f64>, G: &Tensor<f64>, h: f64) -> (f64, f64) {
    let (P, H) = (law.stress(G), law.derivative(G));
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
    (of_stress / (largest(&P) + MU), of_derivative / largest(&H))
}

/// Half the step leaves a quarter of the error, or round-off.
fn converges(coarse: f64, fine: f64) -> bool {
    fine < 1e-8 || (3.0..5.0).contains(&(coarse / fine))
}

fn check(name: &str, law: &dyn Law<f64>, G: &Tensor<f64>) {
    // A step is small against the smallest stretch, on which the curvature depends.
    let smallest = svd(&plus_identity(G)).sigma.map(f64::abs)[2].min(1.0);
    let h = 1e-3 * smallest;
    let (coarse, fine) = (errors(law, G, h), errors(law, G, h / 2.0));
    assert!(converges(coarse.0, fine.0), "{name}, stress: {} then {}; {G:?}", coarse.0, fine.0);
    assert!(converges(coarse.1, fine.1), "{name}, derivative: {} then {}; {G:?}", coarse.1, fine.1);
}

fn check_upright(name: &str, law: &dyn Law<f64>) {
    upright().iter().for_each(|G| check(name, law, G));
}

#[test]
fn stress_and_stress_derivative_agree_with_finite_differences() {
    for_all_laws(check_upright);
}

#[test]
fn derivatives_of_inverted_elements_agree_with_differences_if_the_law_allows_inversion() {
    let mut random = Random(5);
    let mut number = 0;
    while number < 50 {
        let G = random.tensor(2.0);
        let sigma = svd(&plus_identity(&G)).sigma;
        // Away from the crease of the corotated law.
        if sigma[2] < -0.1 && sigma[1] + sigma[2] > 0.3 {
            for_all_laws_with_inversion(|name, law| check(name, law, &G));
            number += 1;
        }
    }
}

/// A law with one mistake.
struct Wrong<'a>(&'a dyn Law<f64>, fn(&mut Tensor<f64>), fn(&mut Tensor4<f64>));

impl Law<f64> for Wrong<'_> {
    fn energy(&self, G: &Tensor<f64>) -> f64 {
        self.0.energy(G)
    }

    fn stress(&self, G: &Tensor<f64>) -> Tensor<f64> {
        let mut P = self.0.stress(G);
        self.1(&mut P);
        P
    }

    fn derivative(&self, G: &Tensor<f64>) -> Tensor4<f64> {
        let mut H = self.0.derivative(G);
        self.2(&mut H);
        H
    }

    fn projected_derivative(&self, G: &Tensor<f64>) -> Tensor4<f64> {
        self.0.projected_derivative(G)
    }
}

fn mistakes_are_found(name: &str, law: &dyn Law<f64>) {
    let G = [[0.3, 0.2, -0.1], [0.05, -0.2, 0.15], [-0.25, 0.1, 0.12]];
    let finds = |wrong: Wrong| {
        let (coarse, fine) = (errors(&wrong, &G, 1e-4), errors(&wrong, &G, 5e-5));
        !converges(coarse.0, fine.0) || !converges(coarse.1, fine.1)
    };
    assert!(!finds(Wrong(law, |_| (), |_| ())), "{name}");
    assert!(finds(Wrong(law, |P| P.iter_mut().flatten().for_each(|p| *p = -*p), |_| ())), "{name}: negated stress");
    assert!(finds(Wrong(law, |P| P[1][2] *= 1.0 + 1e-6, |_| ())), "{name}: one entry of the stress by a millionth");
    assert!(finds(Wrong(law, |_| (), |H| H[8][0] *= -1.0)), "{name}: one entry of the derivative negated");
    assert!(finds(Wrong(law, |_| (), |H| H.iter_mut().flatten().for_each(|h| *h *= 0.5))), "{name}: half of it");
}

#[test]
fn the_comparison_finds_a_wrong_sign_a_wrong_factor_and_an_error_of_a_millionth() {
    for_all_laws(mistakes_are_found);
}

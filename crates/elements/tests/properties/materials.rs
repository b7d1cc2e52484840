//! Properties of every law, and closed forms of single laws.

mod closed_forms;
mod derivatives;
mod gent;
mod kelvin_voigt;
mod lanes;
mod mooney_rivlin;
mod near_rest;
mod ogden;
mod plane_corotated;
mod projected;
mod scenes;
mod svd;
mod symmetries;
mod yeoh;

use fem_elements::Real;
use fem_elements::materials::{
    AnyLaw, Corotated, Gent, Hencky, Law, Linear, MooneyRivlin, NeoHookean, Ogden, StVenantKirchhoff, StableNeoHookean,
    Yeoh,
};
use fem_elements::number::{Number, constant};
use fem_elements::tensor::{Tensor, Tensor4};

/// Lamé's constants of all laws under test, Pa.
const MU: f64 = 1.5;
const LAMBDA: f64 = 4.0;

fn linear<T: Number>() -> Linear<T> {
    Linear { mu: constant(MU), lambda: constant(LAMBDA) }
}

fn corotated<T: Number>() -> Corotated<T> {
    Corotated { mu: constant(MU), lambda: constant(LAMBDA) }
}

fn st_venant_kirchhoff<T: Number>() -> StVenantKirchhoff<T> {
    StVenantKirchhoff { mu: constant(MU), lambda: constant(LAMBDA) }
}

/// Its bulk modulus λ + 2μ/3 is 2D.
fn neo_hookean<T: Number>() -> NeoHookean<T> {
    NeoHookean { C: constant(MU / 2.0), D: constant(LAMBDA / 2.0 + MU / 3.0) }
}

fn stable_neo_hookean<T: Number>() -> StableNeoHookean<T> {
    StableNeoHookean { mu: constant(MU), lambda: constant(LAMBDA) }
}

fn hencky<T: Number>() -> Hencky<T> {
    Hencky { mu: constant(MU), lambda: constant(LAMBDA) }
}

fn mooney_rivlin<T: Number>() -> MooneyRivlin<T> {
    let NeoHookean { C, D } = neo_hookean::<T>();
    MooneyRivlin { C10: constant::<T>(0.625) * C, C01: constant::<T>(0.375) * C, D }
}

fn yeoh<T: Number>() -> Yeoh<T> {
    let NeoHookean { C, D } = neo_hookean();
    Yeoh { C1: C, C2: constant(-0.0625), C3: constant(0.03125), D }
}

fn gent<T: Number>() -> Gent<T> {
    let NeoHookean { C, D } = neo_hookean();
    Gent { C, Jm: constant(200.0), D }
}

fn ogden<T: Number>() -> Ogden<T> {
    let NeoHookean { D, .. } = neo_hookean();
    Ogden { mu: [1.0, 0.075, -0.6].map(constant), alpha: [1.5, 4.0, -2.0].map(constant), D }
}

/// All laws.
fn laws<T: Number>() -> Vec<AnyLaw<T>> {
    vec![
        AnyLaw::Linear(linear()),
        AnyLaw::Corotated(corotated()),
        AnyLaw::StVenantKirchhoff(st_venant_kirchhoff()),
        AnyLaw::NeoHookean(neo_hookean()),
        AnyLaw::StableNeoHookean(stable_neo_hookean()),
        AnyLaw::Hencky(hencky()),
        AnyLaw::MooneyRivlin(mooney_rivlin()),
        AnyLaw::Yeoh(yeoh()),
        AnyLaw::Gent(gent()),
        AnyLaw::Ogden(ogden()),
    ]
}

/// Calls `check(name, law)` with every law.
fn for_all_laws(check: impl Fn(&str, &dyn Law<f64>)) {
    laws().iter().for_each(|law| check(law.name(), f64::law(law)));
}

/// Calls it with every law that ignores rotations.
fn for_all_objective_laws(check: impl Fn(&str, &dyn Law<f64>)) {
    laws().iter().filter(|law| !law.is_linear()).for_each(|law| check(law.name(), f64::law(law)));
}

/// Calls it with every law whose energy is finite for J ≤ 0.
fn for_all_laws_with_inversion(check: impl Fn(&str, &dyn Law<f64>)) {
    laws().iter().filter(|law| law.allows_inversion()).for_each(|law| check(law.name(), f64::law(law)));
}

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
        std::array::from_fn(|_| std::array::from_fn(|_| size * self.number()))
    }

    /// From a unit quaternion.
    fn rotation(&mut self) -> Tensor<f64> {
        let [w, x, y, z]: [f64; 4] = std::array::from_fn(|_| self.number());
        let q = nalgebra::UnitQuaternion::from_quaternion(nalgebra::Quaternion::new(w, x, y, z));
        let R = q.to_rotation_matrix();
        std::array::from_fn(|i| std::array::from_fn(|j| R[(i, j)]))
    }
}

fn minus_identity(F: &Tensor<f64>) -> Tensor<f64> {
    let mut G = *F;
    for i in 0..3 {
        G[i][i] -= 1.0;
    }
    G
}

fn diagonal(values: [f64; 3]) -> Tensor<f64> {
    std::array::from_fn(|i| std::array::from_fn(|j| if i == j { values[i] } else { 0.0 }))
}

/// Largest |a − b| over all entries.
fn distance<const N: usize>(a: &[[f64; N]; N], b: &[[f64; N]; N]) -> f64 {
    a.as_flattened().iter().zip(b.as_flattened()).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// Largest |entry|.
fn largest<const N: usize>(a: &[[f64; N]; N]) -> f64 {
    distance(a, &[[0.0; N]; N])
}

/// Ascending.
fn eigenvalues(H: &Tensor4<f64>) -> Vec<f64> {
    let matrix = nalgebra::SMatrix::<f64, 9, 9>::from_fn(|i, j| H[i][j]);
    let mut values: Vec<_> = matrix.symmetric_eigenvalues().iter().copied().collect();
    values.sort_by(f64::total_cmp);
    values
}

/// Bars, sheets and shears in their principal axes.
const STRETCHES: [[f64; 3]; 6] =
    [[1.5, 0.9, 0.9], [0.6, 1.2, 1.2], [3.0, 0.6, 0.6], [1.8, 1.8, 0.35], [1.001, 0.9995, 0.9995], [2.0, 1.0, 0.5]];

/// Changes of volume alone.
const VOLUMETRIC_STRETCHES: [f64; 5] = [0.3, 0.9, 1.001, 1.1, 2.0];

/// D (J − 1)² and the diagonal of its P where J = s³.
fn volumetric(D: f64, s: f64) -> (f64, [f64; 3]) {
    let j = s.powi(3) - 1.0;
    (D * j * j, [2.0 * D * j * s * s; 3])
}

fn assert_near(found: f64, expected: f64, what: &str) {
    let size = expected.abs().max(MU + LAMBDA);
    assert!((found - expected).abs() <= 1e-12 * size, "{what}: {found} instead of {expected}");
}

/// Energy density and diagonal of P at principal stretches.
fn check_stretches(law: &dyn Law<f64>, stretches: [f64; 3], (energy, stress): (f64, [f64; 3])) {
    let G = minus_identity(&diagonal(stretches));
    assert_near(law.energy(&G), energy, &format!("energy at {stretches:?}"));
    let size = stress.iter().fold(MU + LAMBDA, |size, stress| size.max(stress.abs()));
    let error = distance(&law.stress(&G), &diagonal(stress));
    assert!(error <= 1e-12 * size, "stress at {stretches:?}: {error:e}");
}

/// The law is the neo-Hookean one of [`neo_hookean`] at every deformation.
fn check_is_neo_hookean(law: &dyn Law<f64>) {
    let neo = neo_hookean::<f64>();
    for G in upright() {
        let (energy, P, H) = (neo.energy(&G), neo.stress(&G), neo.derivative(&G));
        assert!((law.energy(&G) - energy).abs() <= 1e-15 * energy, "{G:?}");
        assert!(distance(&law.stress(&G), &P) <= 1e-15 * largest(&P), "{G:?}");
        assert!(distance(&law.derivative(&G), &H) <= 1e-14 * largest(&H), "{G:?}");
        let (found, expected) = (law.projected_derivative(&G), neo.projected_derivative(&G));
        assert!(distance(&found, &expected) <= 1e-13 * largest(&H), "{G:?}");
    }
}

/// Deformations with J > 0 between gentle and wild, and those of coinciding stretches.
fn upright() -> Vec<Tensor<f64>> {
    let mut random = Random(1);
    let mut gradients: Vec<_> = (0..200).map(|n| random.tensor(0.01 * 1.03f64.powi(n))).collect();
    gradients.retain(|G| 1.0 + fem_elements::tensor::volume_change(G).0 > 0.05);
    let stretches = [[1.0; 3], [2.0; 3], [0.3; 3], [1.0, 1.0, 0.2], [3.0, 1.0, 1.0], [1.5, 1.5, 0.7]];
    for values in stretches {
        let (U, V) = (random.rotation(), random.rotation());
        let F = fem_elements::tensor::product(&fem_elements::tensor::product(&U, &diagonal(values)), &V);
        gradients.extend([minus_identity(&F), minus_identity(&diagonal(values))]);
    }
    gradients
}

/// Deformations of any J: wild, inverted, flattened to a plane, a line or a point, mirrored.
fn any() -> Vec<Tensor<f64>> {
    let mut random = Random(2);
    let mut gradients: Vec<_> = (0..800).map(|n| random.tensor(if n % 2 == 0 { 1.5 } else { 6.0 })).collect();
    let stretches = [
        [0.0; 3],
        [1.0, 0.0, 0.0],
        [1.0, 1.0, 0.0],
        [2.0, 0.5, 0.0],
        [1.0, 1.0, -1.0],
        [1.0, 0.5, -0.5],
        [2.0, 2.0, -2.0],
        [3.0, 1e-9, -1e-9],
        [1e3, 1.0, -1e-3],
        [1e-12, 1e-12, 1e-12],
    ];
    for values in stretches {
        for _ in 0..20 {
            let (U, V) = (random.rotation(), random.rotation());
            gradients.push(minus_identity(&fem_elements::tensor::product(
                &fem_elements::tensor::product(&U, &diagonal(values)),
                &V,
            )));
        }
        gradients.push(minus_identity(&diagonal(values)));
    }
    gradients
}

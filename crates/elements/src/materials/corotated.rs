//! ψ = μ ‖F − R‖² + λ/2 (tr(RᵀF) − 3)², R the rotation nearest to F: corotated linear elasticity.
//!
//! Sifakis and Barbič, FEM Simulation of 3D Deformable Solids (2012), part one, §3.4; eigenvalues: Smith, de Goes and Kim,
//! Analytic Eigensystems for Isotropic Distortion Energies (2019).
//!
//! With y = tr(RᵀF) − 3, P = 2μ (F − R) + λ y R and ∂P/∂F = 2μ 1 + λ R⊗R + (λ y − 2μ) ∂R/∂F: [`SpaceRotation`] has R and its derivative
//! in closed form. R is always proper: an inverted element, of which the last singular value is negative, is pushed back. Where
//! σ_i + σ_j = 0, R jumps and ψ has a crease; near there the singular value decomposition F = U diag(σ) Vᵀ takes over, R = U Vᵀ: with
//! e = σ − 1, ψ = μ Σe² + λ/2 (Σe)² and P = U diag(2μ e + λ Σe) Vᵀ.

use pulp::{Simd, WithSimd};

use super::isotropic::{Principal, derivative_from, projected_derivative_from};
use super::stretches::stretches;
use super::{Law, NamedLaw, Terms};
use crate::number::{Float, Number, constant};
use crate::polar::SpaceRotation;
use crate::svd::Svd;
use crate::tensor::{Tensor, Tensor4, add_diagonal, dot, from_fn, half};

/// Lamé's constants of small strain, Pa.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Corotated<T> {
    /// Shear modulus μ.
    pub mu: T,
    /// λ
    pub lambda: T,
}

impl<T: Number> Corotated<T> {
    #[inline(always)]
    fn energy_of(&self, e: &[T; 3]) -> T {
        let sum = e[0] + e[1] + e[2];
        self.mu * (e[0] * e[0] + e[1] * e[1] + e[2] * e[2]) + half::<T>() * self.lambda * sum * sum
    }

    #[inline(always)]
    fn stress_of(&self, F: &Svd<T>, e: &[T; 3]) -> Tensor<T> {
        let (two_mu, pressure) = (constant::<T>(2.0) * self.mu, self.lambda * (e[0] + e[1] + e[2]));
        F.with_values(&[two_mu * e[0] + pressure, two_mu * e[1] + pressure, two_mu * e[2] + pressure])
    }

    #[inline(never)] // rare
    fn energy_and_stress_on_crease(&self, G: &Tensor<T>) -> (T, Tensor<T>) {
        T::vectorize(OnCrease { law: self, G })
    }

    #[inline(never)] // rare
    fn derivative_on_crease(&self, G: &Tensor<T>) -> Tensor4<T> {
        T::vectorize(DerivativeOnCrease { law: self, G })
    }

    #[inline(always)]
    fn principal(&self, F: &Svd<T>, e: &[T; 3]) -> Principal<T> {
        let two = constant::<T>(2.0);
        let pressure = two * self.lambda * (e[0] + e[1] + e[2]);
        // On the crease the derivative is not finite; beside it, it is cut off.
        let floor = constant::<T>(Float::as_f64(<T::Element as Float>::EPSILON).sqrt());
        let mut principal = Principal::zero();
        for k in 0..3 {
            let (i, j) = ((k + 1) % 3, (k + 2) % 3);
            let sum = (F.sigma[i] + F.sigma[j]).max(floor);
            principal.twist[k] = (two * self.mu * (e[i] + e[j]) + pressure) / sum;
            principal.flip[k] = two * self.mu;
            principal.scaling[k] = [self.lambda; 3];
            principal.scaling[k][k] += two * self.mu;
        }
        principal
    }
}

/// Energy and stress by singular values.
struct OnCrease<'a, T> {
    law: &'a Corotated<T>,
    G: &'a Tensor<T>,
}

impl<T: Number> WithSimd for OnCrease<'_, T> {
    type Output = (T, Tensor<T>);

    #[inline(always)]
    fn with_simd<S: Simd>(self, _simd: S) -> (T, Tensor<T>) {
        let (F, e) = stretches(self.G);
        (self.law.energy_of(&e), self.law.stress_of(&F, &e))
    }
}

/// The derivative by singular values.
struct DerivativeOnCrease<'a, T> {
    law: &'a Corotated<T>,
    G: &'a Tensor<T>,
}

impl<T: Number> WithSimd for DerivativeOnCrease<'_, T> {
    type Output = Tensor4<T>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _simd: S) -> Tensor4<T> {
        let (F, e) = stretches(self.G);
        derivative_from(&F, &self.law.principal(&F, &e))
    }
}

/// Energy, stress and derivative from the closed form of the rotation.
impl<T: Number> Corotated<T> {
    #[inline(always)]
    fn energy_at(&self, R: &SpaceRotation<T>, difference: &Tensor<T>) -> T {
        self.mu * dot(difference, difference) + half::<T>() * self.lambda * R.strain * R.strain
    }

    #[inline(always)]
    fn stress_at(&self, R: &SpaceRotation<T>, difference: &Tensor<T>) -> Tensor<T> {
        let (two_mu, pressure) = (constant::<T>(2.0) * self.mu, self.lambda * R.strain);
        let rotation = R.rotation();
        from_fn(
            #[inline(always)]
            |i, j| two_mu * difference[i][j] + pressure * rotation[i][j],
        )
    }

    #[inline(always)]
    fn terms_at(&self, R: &SpaceRotation<T>, G: &Tensor<T>) -> OfRotation<T> {
        let two_mu = constant::<T>(2.0) * self.mu;
        let (factor, B) = (self.lambda * R.strain - two_mu, R.spin(G));
        let spin = from_fn(
            #[inline(always)]
            |k, l| factor * B[k][l],
        );
        OfRotation { R: R.rotation(), identity: two_mu, rotation: self.lambda, spin }
    }
}

/// ∂P/∂F = a 1 + b R⊗R + Σ c_kl t_k⊗t_l, where t_k = R \[e_k\]× are the changes of R.
#[derive(Clone, Copy, Debug)]
pub struct OfRotation<T> {
    /// The rotation nearest to F.
    pub R: Tensor<T>,
    /// a, Pa
    pub identity: T,
    /// b, Pa
    pub rotation: T,
    /// c, Pa
    pub spin: Tensor<T>,
}

impl<T: Number> OfRotation<T> {
    /// ∂P/∂F, entry by entry.
    #[inline(always)]
    pub fn derivative(&self) -> Tensor4<T> {
        let Self { R, identity, rotation, spin } = self;
        // Column k + 1 of t_k is column k + 2 of R, and its column k + 2 is minus column k + 1.
        let mut t = [[T::zero(); 9]; 3];
        for k in 0..3 {
            let (next, last) = ((k + 1) % 3, (k + 2) % 3);
            for i in 0..3 {
                t[k][3 * i + next] = R[i][last];
                t[k][3 * i + last] = -R[i][next];
            }
        }
        let mut H = [[T::zero(); 9]; 9];
        for row in 0..9 {
            let of_R = *rotation * R[row / 3][row % 3];
            let mut of_t = [T::zero(); 3];
            for l in 0..3 {
                of_t[l] = spin[0][l] * t[0][row] + spin[1][l] * t[1][row] + spin[2][l] * t[2][row];
            }
            for column in row..9 {
                let of_spin = of_t[0] * t[0][column] + of_t[1] * t[1][column] + of_t[2] * t[2][column];
                H[row][column] = of_R * R[column / 3][column % 3] + of_spin;
                H[column][row] = H[row][column];
            }
        }
        add_diagonal(&mut H, *identity);
        H
    }
}

/// F − R
#[inline(always)]
fn difference<T: Number>(G: &Tensor<T>, R: &SpaceRotation<T>) -> Tensor<T> {
    from_fn(
        #[inline(always)]
        |i, j| G[i][j] - R.change[i][j],
    )
}

impl<T: Number> Law<T> for Corotated<T> {
    #[inline(always)]
    fn energy(&self, G: &Tensor<T>) -> T {
        match SpaceRotation::of(G) {
            Some(R) => self.energy_at(&R, &difference(G, &R)),
            None => self.energy_and_stress_on_crease(G).0,
        }
    }

    #[inline(always)]
    fn stress(&self, G: &Tensor<T>) -> Tensor<T> {
        match SpaceRotation::of(G) {
            Some(R) => self.stress_at(&R, &difference(G, &R)),
            None => self.energy_and_stress_on_crease(G).1,
        }
    }

    /// With one rotation for both.
    #[inline(always)]
    fn energy_and_stress(&self, G: &Tensor<T>) -> (T, Tensor<T>) {
        match SpaceRotation::of(G) {
            Some(R) => {
                let difference = difference(G, &R);
                (self.energy_at(&R, &difference), self.stress_at(&R, &difference))
            }
            None => self.energy_and_stress_on_crease(G),
        }
    }

    #[inline(always)]
    fn derivative(&self, G: &Tensor<T>) -> Tensor4<T> {
        match SpaceRotation::of(G) {
            Some(R) => self.terms_at(&R, G).derivative(),
            None => self.derivative_on_crease(G),
        }
    }

    #[inline(always)]
    fn terms(&self, G: &Tensor<T>) -> Terms<T> {
        match SpaceRotation::of(G) {
            Some(R) => Terms::Rotation(self.terms_at(&R, G)),
            None => Terms::Entries,
        }
    }

    #[inline(always)]
    fn projected_derivative(&self, G: &Tensor<T>) -> Tensor4<T> {
        let (F, e) = stretches(G);
        projected_derivative_from(&F, &self.principal(&F, &e))
    }
}

impl<T: Number> NamedLaw<T> for Corotated<T> {
    const NAME: &'static str = "corotated";

    fn of(material: &fem_model::Material) -> Option<Self> {
        let fem_model::Law::Corotated(elastic) = material.law else { return None };
        let [mu, lambda] = elastic.lame(material.plane).map(constant);
        Some(Self { mu, lambda })
    }

    fn moduli(&self) -> [T; 2] {
        [self.mu, self.lambda + constant::<T>(2.0 / 3.0) * self.mu]
    }
}

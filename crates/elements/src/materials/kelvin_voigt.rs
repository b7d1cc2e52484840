//! Kelvin–Voigt damping of an elastic solid: the stress β (2μ U̇ + λ tr(U̇) 1), conjugate to the rate of the right stretch tensor U, F = R U.
//!
//! Bonet and Wood, Nonlinear Continuum Mechanics for Finite Element Analysis (2008), §4.12: with F = Σ σ_i u_i⊗v_i the rate of U has the components
//! U̇_ij = (σ_i Ḟ_ij + σ_j Ḟ_ji)/(σ_i + σ_j), where Ḟ_ij = u_i·Ḟ v_j. So 2μ U̇:U̇ + λ tr(U̇)² = Ḟ : H : Ḟ with
//! H = 2μ Σ_i B_ii⊗B_ii + λ R⊗R + 4μ Σ_{i<j} N_ij⊗N_ij, B_ij = u_i⊗v_j, N_ij = (σ_i B_ij + σ_j B_ji)/(σ_i + σ_j).
//!
//! H is symmetric and positive semi-definite at any F. It is zero for the velocities of a rigid motion, Ḟ = W F with a skew W, and its forces have no
//! torque about the deformed body. In the undeformed body it is the stiffness of an isotropic law with these moduli. Its entries do
//! not grow with the stretch: those of a stress of Green's strain grow with the second power, and in elements that are far out of shape damping would
//! outweigh elasticity.
//!
//! The same without singular values, as long as R is well-conditioned: with M = RᵀḞ = Ω U + U̇ and the skew Ω = [ω]×, M − Mᵀ = Ω U + U Ω gives
//! (tr U 1 − U) ω = ax(M), the axial vector of M − Mᵀ, and U̇ = M − Ω U. A stress T conjugate to U̇ is the stress R (T − [(tr U 1 − U)⁻¹ ax(T U)]×)
//! conjugate to Ḟ.

use pulp::{Simd, WithSimd};

use super::Law;
use crate::number::{Number, constant, vectorized};
use crate::polar::SpaceRotation;
use crate::svd::svd;
use crate::tensor::{Tensor, Tensor4, from_fn, half, plus_identity, product, trace, transpose, zero};

/// Lamé's constants of small strain, Pa: the form Σ V Ḟ : H : Ḟ of velocity gradients at a deformation, of which no energy is stored.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct KelvinVoigt<T> {
    /// Shear modulus μ.
    pub mu: T,
    /// λ
    pub lambda: T,
}

impl<T: Number> KelvinVoigt<T> {
    /// The damping of a law with this shear modulus and bulk modulus at small strain, Pa.
    pub fn new([mu, bulk]: [f64; 2]) -> Self {
        Self { mu: constant(mu), lambda: constant(bulk - 2.0 / 3.0 * mu) }
    }
}

impl<T: Number> Law<T> for KelvinVoigt<T> {
    #[inline(always)]
    fn energy(&self, _: &Tensor<T>) -> T {
        T::zero()
    }

    #[inline(always)]
    fn stress(&self, _: &Tensor<T>) -> Tensor<T> {
        zero()
    }

    #[inline(always)]
    fn derivative(&self, G: &Tensor<T>) -> Tensor4<T> {
        match Stretch::of(G) {
            Some(stretch) => self.derivative_at(&stretch),
            None => vectorized(DerivativeOnCrease { law: self, G }),
        }
    }

    #[inline(always)]
    fn derivative_times(&self, G: &Tensor<T>, rate: &Tensor<T>) -> Tensor<T> {
        match Stretch::of(G) {
            Some(stretch) => stretch.stress(&self.stress_of(&stretch.rate(rate))),
            None => vectorized(ProductOnCrease { law: self, G, rate }),
        }
    }

    #[inline(always)]
    fn projected_derivative(&self, G: &Tensor<T>) -> Tensor4<T> {
        self.derivative(G)
    }
}

impl<T: Number> KelvinVoigt<T> {
    /// 2μ U̇ + λ tr(U̇) 1
    #[inline(always)]
    fn stress_of(&self, rate: &Tensor<T>) -> Tensor<T> {
        let (two_mu, pressure) = (constant::<T>(2.0) * self.mu, self.lambda * trace(rate));
        let mut stress = from_fn(
            #[inline(always)]
            |i, j| two_mu * rate[i][j],
        );
        for i in 0..3 {
            stress[i][i] += pressure;
        }
        stress
    }

    /// H, from the gradients of the components of U̇.
    #[inline(always)]
    fn derivative_at(&self, stretch: &Stretch<T>) -> Tensor4<T> {
        let mut H = [[T::zero(); 9]; 9];
        for i in 0..3 {
            let (j, k) = ((i + 1) % 3, (i + 2) % 3);
            let (mut normal, mut shear) = (zero(), zero());
            normal[i][i] = T::one();
            (shear[j][k], shear[k][j]) = (half(), half());
            add_square(&mut H, constant::<T>(2.0) * self.mu, &entries(&stretch.stress(&normal)));
            add_square(&mut H, constant::<T>(4.0) * self.mu, &entries(&stretch.stress(&shear)));
        }
        add_square(&mut H, self.lambda, &entries(&stretch.R));
        H
    }

    /// The same from singular values.
    #[inline(always)]
    fn derivative_on_crease(&self, G: &Tensor<T>) -> Tensor4<T> {
        let F = svd(&plus_identity(G));
        let mut H = [[T::zero(); 9]; 9];
        for i in 0..3 {
            add_square(&mut H, constant::<T>(2.0) * self.mu, &mode(&F.U[i], &F.V[i]));
            let (j, k) = ((i + 1) % 3, (i + 2) % 3);
            let [a, b] = parts(F.sigma[j], F.sigma[k]);
            let (one, other) = (mode(&F.U[j], &F.V[k]), mode(&F.U[k], &F.V[j]));
            let mut shear = one;
            for entry in 0..9 {
                shear[entry] = a * one[entry] + b * other[entry];
            }
            add_square(&mut H, constant::<T>(4.0) * self.mu, &shear);
        }
        add_square(&mut H, self.lambda, &entries(&F.with_values(&[T::one(); 3])));
        H
    }

    /// Σ X_ij u_i⊗v_j with the components X of the derivative of ½ Ḟ : H : Ḟ by those of Ḟ.
    #[inline(always)]
    fn product_on_crease(&self, G: &Tensor<T>, rate: &Tensor<T>) -> Tensor<T> {
        let F = svd(&plus_identity(G));
        let of = product(&product(&F.U, rate), &transpose(&F.V));
        let (two_mu, four_mu) = (constant::<T>(2.0) * self.mu, constant::<T>(4.0) * self.mu);
        let pressure = self.lambda * trace(&of);
        let mut X = zero();
        for i in 0..3 {
            X[i][i] = two_mu * of[i][i] + pressure;
            let (j, k) = ((i + 1) % 3, (i + 2) % 3);
            let [a, b] = parts(F.sigma[j], F.sigma[k]);
            let shear = four_mu * (a * of[j][k] + b * of[k][j]);
            (X[j][k], X[k][j]) = (a * shear, b * shear);
        }
        product(&transpose(&F.U), &product(&X, &F.V))
    }
}

/// H where R is ill-conditioned, compiled once for its callers.
struct DerivativeOnCrease<'a, T> {
    law: &'a KelvinVoigt<T>,
    G: &'a Tensor<T>,
}

impl<T: Number> WithSimd for DerivativeOnCrease<'_, T> {
    type Output = Tensor4<T>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _simd: S) -> Tensor4<T> {
        self.law.derivative_on_crease(self.G)
    }
}

/// H : Ḟ there.
struct ProductOnCrease<'a, T> {
    law: &'a KelvinVoigt<T>,
    G: &'a Tensor<T>,
    rate: &'a Tensor<T>,
}

impl<T: Number> WithSimd for ProductOnCrease<'_, T> {
    type Output = Tensor<T>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _simd: S) -> Tensor<T> {
        self.law.product_on_crease(self.G, self.rate)
    }
}

/// The polar decomposition F = R U in closed form.
struct Stretch<T> {
    R: Tensor<T>,
    U: Tensor<T>,
    /// (tr U 1 − U)⁻¹
    B: Tensor<T>,
}

impl<T: Number> Stretch<T> {
    /// `None` where R is ill-conditioned.
    #[inline(always)]
    fn of(G: &Tensor<T>) -> Option<Self> {
        let rotation = SpaceRotation::of(G)?;
        let R = rotation.rotation();
        let U = product(&transpose(&R), &plus_identity(G));
        Some(Self { R, B: rotation.spin_of(&U), U })
    }

    /// U̇
    #[inline(always)]
    fn rate(&self, rate: &Tensor<T>) -> Tensor<T> {
        let M = product(&transpose(&self.R), rate);
        let spin = product(&self.spin(&M), &self.U);
        from_fn(
            #[inline(always)]
            |i, j| half::<T>() * (M[i][j] - spin[i][j] + (M[j][i] - spin[j][i])),
        )
    }

    /// The stress conjugate to Ḟ of a stress T conjugate to U̇.
    #[inline(always)]
    fn stress(&self, T: &Tensor<T>) -> Tensor<T> {
        let spin = self.spin(&product(T, &transpose(&self.U)));
        let difference = from_fn(
            #[inline(always)]
            |i, j| T[i][j] - spin[i][j],
        );
        product(&self.R, &difference)
    }

    /// \[B ax(M)\]×
    #[inline(always)]
    fn spin(&self, M: &Tensor<T>) -> Tensor<T> {
        let axial = [M[2][1] - M[1][2], M[0][2] - M[2][0], M[1][0] - M[0][1]];
        let mut spin = [T::zero(); 3];
        for k in 0..3 {
            spin[k] = self.B[k][0] * axial[0] + self.B[k][1] * axial[1] + self.B[k][2] * axial[2];
        }
        let [x, y, z] = spin;
        [[T::zero(), -z, y], [z, T::zero(), -x], [-y, x, T::zero()]]
    }
}

/// Entries row by row.
#[inline(always)]
fn entries<T: Number>(a: &Tensor<T>) -> [T; 9] {
    [a[0][0], a[0][1], a[0][2], a[1][0], a[1][1], a[1][2], a[2][0], a[2][1], a[2][2]]
}

/// σ_i/(σ_i + σ_j) and σ_j/(σ_i + σ_j). In an inverted element the sum may vanish: it is at least the norm of the two.
#[inline(always)]
fn parts<T: Number>(one: T, other: T) -> [T; 2] {
    let sum = (one + other).max((one * one + other * other).sqrt());
    let is_positive = sum.gt(T::zero());
    [(one / sum).select(is_positive, T::zero()), (other / sum).select(is_positive, T::zero())]
}

/// u⊗v, row by row.
#[inline(always)]
fn mode<T: Number>(u: &[T; 3], v: &[T; 3]) -> [T; 9] {
    let mut entries = [T::zero(); 9];
    for (entry, value) in entries.iter_mut().enumerate() {
        *value = u[entry / 3] * v[entry % 3];
    }
    entries
}

/// Adds factor a⊗a.
#[inline(always)]
fn add_square<T: Number>(H: &mut Tensor4<T>, factor: T, a: &[T; 9]) {
    for row in 0..9 {
        let of_row = factor * a[row];
        for column in 0..9 {
            H[row][column] = of_row.times_plus(a[column], H[row][column]);
        }
    }
}

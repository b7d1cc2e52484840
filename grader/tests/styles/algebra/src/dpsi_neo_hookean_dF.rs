use nalgebra::{Matrix3, SVector};

/// Numbers that carry their derivatives along: the formula of the energy, differentiated by the computer.
pub fn dpsi_neo_hookean_dF(F: &Matrix3<f64>, C: f64, D: f64) -> SVector<f64, 9> {
    let entries: Vec<Dual> = (0..9).map(|k| Dual::variable(F[(k / 3, k % 3)], k)).collect();
    let at = |i: usize, j: usize| entries[3 * (i % 3) + j % 3];
    let minor = |j: usize| at(1, j + 1) * at(2, j + 2) - at(1, j + 2) * at(2, j + 1);
    let J = at(0, 0) * minor(0) + at(0, 1) * minor(1) + at(0, 2) * minor(2);
    let squares = entries.iter().fold(Dual::constant(0.0), |sum, &entry| sum + entry * entry);
    let volume = J - Dual::constant(1.0);
    let psi = Dual::constant(C) * (squares * J.power(-2.0 / 3.0)) + Dual::constant(D) * volume * volume;
    psi.derivatives
}

/// A number and its derivatives by the nine entries of F.
#[derive(Clone, Copy)]
struct Dual {
    value: f64,
    derivatives: SVector<f64, 9>,
}

impl Dual {
    fn constant(value: f64) -> Self {
        Self { value, derivatives: SVector::zeros() }
    }

    fn variable(value: f64, k: usize) -> Self {
        let mut derivatives = SVector::zeros();
        derivatives[k] = 1.0;
        Self { value, derivatives }
    }

    fn power(self, exponent: f64) -> Self {
        let slope = exponent * self.value.powf(exponent - 1.0);
        Self { value: self.value.powf(exponent), derivatives: self.derivatives * slope }
    }
}

impl std::ops::Add for Dual {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self { value: self.value + other.value, derivatives: self.derivatives + other.derivatives }
    }
}

impl std::ops::Sub for Dual {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self { value: self.value - other.value, derivatives: self.derivatives - other.derivatives }
    }
}

impl std::ops::Mul for Dual {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let derivatives = self.derivatives * other.value + other.derivatives * self.value;
        Self { value: self.value * other.value, derivatives }
    }
}

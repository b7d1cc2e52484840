use nalgebra::{Matrix3, SMatrix};

/// Numbers with two infinitesimal parts whose product does not vanish: one evaluation for each pair of entries.
pub fn d2psi_neo_hookean_dF2(F: &Matrix3<f64>, C: f64, D: f64) -> SMatrix<f64, 9, 9> {
    let second = |row: usize, column: usize| {
        let entry = |i: usize, j: usize| {
            let k = 3 * (i % 3) + j % 3;
            let is = |other: usize| if k == other { 1.0 } else { 0.0 };
            Hyper([F[(k / 3, k % 3)], is(row), is(column), 0.0])
        };
        let minor = |j: usize| entry(1, j + 1) * entry(2, j + 2) - entry(1, j + 2) * entry(2, j + 1);
        let J = entry(0, 0) * minor(0) + entry(0, 1) * minor(1) + entry(0, 2) * minor(2);
        let squares = (0..9).map(|k| entry(k / 3, k % 3)).fold(Hyper::constant(0.0), |sum, e| sum + e * e);
        let volume = J - Hyper::constant(1.0);
        let psi = Hyper::constant(C) * squares * J.power(-2.0 / 3.0) + Hyper::constant(D) * volume * volume;
        psi.0[3]
    };
    SMatrix::from_fn(|row, column| if row <= column { second(row, column) } else { second(column, row) })
}

/// a + b ε + c δ + d εδ with ε² = δ² = 0.
#[derive(Clone, Copy)]
struct Hyper([f64; 4]);

impl Hyper {
    fn constant(value: f64) -> Self {
        Self([value, 0.0, 0.0, 0.0])
    }

    fn power(self, p: f64) -> Self {
        let [a, b, c, d] = self.0;
        let (first, second) = (p * a.powf(p - 1.0), p * (p - 1.0) * a.powf(p - 2.0));
        Self([a.powf(p), first * b, first * c, first * d + second * b * c])
    }
}

impl std::ops::Add for Hyper {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self([0, 1, 2, 3].map(|k| self.0[k] + other.0[k]))
    }
}

impl std::ops::Sub for Hyper {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self([0, 1, 2, 3].map(|k| self.0[k] - other.0[k]))
    }
}

impl std::ops::Mul for Hyper {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let ([a, b, c, d], [x, y, z, w]) = (self.0, other.0);
        Self([a * x, a * y + b * x, a * z + c * x, a * w + b * z + c * y + d * x])
    }
}

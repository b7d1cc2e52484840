//! Numbers of 32 digits, each the sum of two f64: enough to judge a result in which most of f64's digits cancel.
//! (T. J. Dekker, A floating-point technique for extending the available precision, Numerische Mathematik 18, 1971.)

use std::ops::{Add, Mul};

/// Such a number: its leading half and the rest.
#[derive(Clone, Copy, Debug)]
pub struct DoubleDouble(f64, f64);

impl From<f64> for DoubleDouble {
    fn from(number: f64) -> Self {
        Self(number, 0.0)
    }
}

impl From<DoubleDouble> for f64 {
    fn from(number: DoubleDouble) -> f64 {
        number.0 + number.1
    }
}

impl Add for DoubleDouble {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        let sum = self.0 + other.0;
        let from_other = sum - self.0;
        let lost = (self.0 - (sum - from_other)) + (other.0 - from_other);
        normalised(sum, lost + self.1 + other.1)
    }
}

impl Mul for DoubleDouble {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        let product = self.0 * other.0;
        let lost = self.0.mul_add(other.0, -product);
        normalised(product, lost + self.0 * other.1 + self.1 * other.0)
    }
}

impl std::iter::Sum for DoubleDouble {
    fn sum<I: Iterator<Item = Self>>(numbers: I) -> Self {
        numbers.fold(0.0.into(), |sum, number| sum + number)
    }
}

fn normalised(large: f64, small: f64) -> DoubleDouble {
    let sum = large + small;
    DoubleDouble(sum, small - (sum - large))
}

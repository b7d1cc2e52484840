//! An energy with the size of its terms.

/// An energy, and the size of its terms, which bounds its rounding error; J.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Energy {
    /// The sum.
    pub value: f64,
    /// Sum of the magnitudes of its terms.
    pub terms: f64,
}

impl Energy {
    /// A single term.
    pub fn of(value: f64) -> Self {
        Self { value, terms: value.abs() }
    }
}

impl std::ops::Add for Energy {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self { value: self.value + other.value, terms: self.terms + other.terms }
    }
}

impl std::iter::Sum for Energy {
    fn sum<I: Iterator<Item = Self>>(energies: I) -> Self {
        energies.fold(Self::default(), std::ops::Add::add)
    }
}

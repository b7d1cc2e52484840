//! Shape functions as polynomials in barycentric coordinates.

/// A sum of terms: a factor, and the numbers of the barycentric coordinates that it is multiplied by.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShapeFunction(pub &'static [(f64, &'static [usize])]);

impl ShapeFunction {
    /// The value at barycentric coordinates.
    pub fn value(&self, L: &[f64]) -> f64 {
        self.0.iter().map(|(factor, of)| factor * of.iter().map(|&i| L[i]).product::<f64>()).sum()
    }

    /// The derivative by a barycentric coordinate; `None` if the function does not depend on it.
    pub fn derivative(&self, by: usize, L: &[f64]) -> Option<f64> {
        let of_term = |(factor, of): &(f64, &[usize])| {
            let power = of.iter().filter(|&&i| i == by).count();
            let place = of.iter().position(|&i| i == by)?;
            let others = of.iter().enumerate().filter(|(other, _)| *other != place).map(|(_, &i)| L[i]);
            Some(factor * power as f64 * others.product::<f64>())
        };
        self.0.iter().filter_map(of_term).reduce(|sum, term| sum + term)
    }

    /// The gradient at barycentric coordinates, whose own gradients are given.
    pub(super) fn gradient<const D: usize>(&self, of: &[[f64; D]], L: &[f64]) -> [f64; D] {
        // Terms that are zero are left out, so that a zero keeps its sign.
        let terms = || of.iter().enumerate().filter_map(|(i, of)| Some((self.derivative(i, L)?, of)));
        std::array::from_fn(|j| terms().map(|(factor, of)| factor * of[j]).reduce(|sum, x| sum + x).unwrap_or(0.0))
    }
}

//! Integrals over a tetrahedron. A. Grundmann and H. M. Möller, "Invariant integration formulas for the n-simplex by
//! combinatorial methods", SIAM Journal on Numerical Analysis 15, 1978.

/// Points in barycentric coordinates, with weights that add up to 1.
#[derive(Clone, Debug, PartialEq)]
pub struct Rule {
    /// `(coordinates, weight)`
    pub points: Vec<([f64; 4], f64)>,
}

impl Rule {
    /// Exact for polynomials of degree 2s + 1.
    pub fn of_index(s: u32) -> Self {
        let mut points = Vec::new();
        let degree = f64::from(2 * s + 1);
        for i in 0..=s {
            let below = degree + 3.0 - 2.0 * f64::from(i);
            let sign = if i % 2 == 0 { 1.0 } else { -1.0 };
            // Times 3!, so that the weights add up to 1 instead of to the volume of the unit simplex.
            let weight =
                6.0 * sign * 0.25f64.powi(s as i32) * below.powf(degree) / (factorial(i) * factorial(2 * s + 4 - i));
            let left = s - i;
            for a in 0..=left {
                for b in 0..=left - a {
                    for c in 0..=left - a - b {
                        let counts = [a, b, c, left - a - b - c];
                        points.push((counts.map(|count| f64::from(2 * count + 1) / below), weight));
                    }
                }
            }
        }
        Self { points }
    }
}

fn factorial(n: u32) -> f64 {
    (1..=n).map(f64::from).product()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn polynomials_up_to_the_degree_are_integrated_exactly() {
        // ∫ x^a y^b z^c over the unit tetrahedron, over its volume, is 6 a! b! c! / (a + b + c + 3)!.
        for s in 0..=4 {
            let rule = Rule::of_index(s);
            for (a, b, c) in [(0, 0, 0), (1, 0, 0), (2, 1, 0), (2, 2, 1), (3, 2, 2), (5, 2, 2)] {
                if a + b + c > 2 * s + 1 {
                    continue;
                }
                let monomial = |x: &[f64; 4]| x[0].powi(a as i32) * x[1].powi(b as i32) * x[2].powi(c as i32);
                let found: f64 = rule.points.iter().map(|(x, weight)| weight * monomial(x)).sum();
                let exact = 6.0 * factorial(a) * factorial(b) * factorial(c) / factorial(a + b + c + 3);
                assert!((found - exact).abs() < 1e-13, "{s}: {a} {b} {c}: {found} {exact}");
            }
        }
    }
}

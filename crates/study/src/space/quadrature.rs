//! Integrals over a triangle or a tetrahedron. A. Grundmann and H. M. Möller, "Invariant integration formulas for the n-simplex by
//! combinatorial methods", SIAM Journal on Numerical Analysis 15, 1978.

/// Points in the barycentric coordinates of a simplex with `N` corners, with weights that add up to 1.
#[derive(Clone, Debug, PartialEq)]
pub struct Rule<const N: usize> {
    /// `(coordinates, weight)`
    pub points: Vec<([f64; N], f64)>,
}

impl<const N: usize> Rule<N> {
    /// Exact for polynomials of degree 2s + 1.
    pub fn of_index(s: u32) -> Self {
        let dimension = N as u32 - 1;
        let mut points = Vec::new();
        let degree = f64::from(2 * s + 1);
        for i in 0..=s {
            let below = degree + f64::from(dimension) - 2.0 * f64::from(i);
            let sign = if i % 2 == 0 { 1.0 } else { -1.0 };
            // Times the factorial of the dimension, so that the weights add up to 1 instead of to the volume of the unit simplex.
            let weight = factorial(dimension) * sign * 0.25f64.powi(s as i32) * below.powf(degree)
                / (factorial(i) * factorial(2 * s + 1 + dimension - i));
            for counts in compositions::<N>(s - i) {
                points.push((counts.map(|count| f64::from(2 * count + 1) / below), weight));
            }
        }
        Self { points }
    }
}

/// All ways to write a number as a sum of `N` numbers, the first ones smallest first.
fn compositions<const N: usize>(total: u32) -> Vec<[u32; N]> {
    let mut found = vec![([0; N], total)];
    for place in 0..N - 1 {
        let with_next = |(counts, left): ([u32; N], u32)| {
            (0..=left).map(move |count| {
                let mut counts = counts;
                counts[place] = count;
                (counts, left - count)
            })
        };
        found = found.into_iter().flat_map(with_next).collect();
    }
    let with_last = |(mut counts, left): ([u32; N], u32)| {
        counts[N - 1] = left;
        counts
    };
    found.into_iter().map(with_last).collect()
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
            let (solid, flat) = (Rule::<4>::of_index(s), Rule::<3>::of_index(s));
            for (a, b, c) in [(0, 0, 0), (1, 0, 0), (2, 1, 0), (2, 2, 1), (3, 2, 2), (5, 2, 2)] {
                if a + b + c > 2 * s + 1 {
                    continue;
                }
                let monomial = |x: &[f64; 4]| x[0].powi(a as i32) * x[1].powi(b as i32) * x[2].powi(c as i32);
                let found: f64 = solid.points.iter().map(|(x, weight)| weight * monomial(x)).sum();
                let exact = 6.0 * factorial(a) * factorial(b) * factorial(c) / factorial(a + b + c + 3);
                assert!((found - exact).abs() < 1e-13, "{s}: {a} {b} {c}: {found} {exact}");
                // Over a triangle, x^a y^(b + c) of its mean is 2 a! (b + c)! / (a + b + c + 2)!.
                let monomial = |x: &[f64; 3]| x[0].powi(a as i32) * x[1].powi((b + c) as i32);
                let found: f64 = flat.points.iter().map(|(x, weight)| weight * monomial(x)).sum();
                let exact = 2.0 * factorial(a) * factorial(b + c) / factorial(a + b + c + 2);
                assert!((found - exact).abs() < 1e-13, "{s}: {a} {b} {c}: {found} {exact}");
            }
        }
    }
}

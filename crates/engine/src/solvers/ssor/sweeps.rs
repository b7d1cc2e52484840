//! The two sweeps of an iteration.

use pulp::{Simd, WithSimd};

use super::{Places, ROWS_AT_ONCE, Row};

/// t = (1 + L̃ᵀ)⁻¹ p
pub struct Backward<'a> {
    pub places: &'a Places,
    pub L: &'a [[Row; 3]],
    pub p: &'a [Row],
    pub t: &'a mut [Row],
}

impl WithSimd for Backward<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _simd: S) {
        let Self { places, L, p, t } = self;
        t.copy_from_slice(p);
        for row in (0..t.len()).rev() {
            let known = t[row];
            let blocks = places.starts[row] as usize..places.starts[row + 1] as usize;
            for (L, &column) in L[blocks.clone()].iter().zip(&places.columns[blocks]) {
                let above = &mut t[column as usize];
                for k in 0..4 {
                    above[k] -= L[0][k] * known[0] + L[1][k] * known[1] + L[2][k] * known[2];
                }
            }
        }
    }
}

/// s = (L̃ + 1)⁻¹ (p + K t); returns p·(t + s).
pub struct Forward<'a> {
    pub places: &'a Places,
    pub L: &'a [[Row; 3]],
    pub K: &'a [[Row; 3]],
    pub p: &'a [Row],
    pub t: &'a [Row],
    pub s: &'a mut [Row],
}

impl WithSimd for Forward<'_> {
    type Output = f64;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _simd: S) -> f64 {
        let Self { places, L, K, p, t, s } = self;
        let (mut total, mut sum) = (0.0, 0.0);
        for row in 0..t.len() {
            let blocks = places.starts[row] as usize..places.starts[row + 1] as usize;
            // each entry of a block has a sum of its own, so that no addition waits for another
            let mut sums = [[0.0; 4]; 3];
            for i in 0..3 {
                for k in 0..4 {
                    sums[i][k] = -K[row][i][k] * t[row][k];
                }
            }
            for (L, &column) in L[blocks.clone()].iter().zip(&places.columns[blocks]) {
                let known = &s[column as usize];
                for i in 0..3 {
                    for k in 0..4 {
                        sums[i][k] += L[i][k] * known[k];
                    }
                }
            }
            for i in 0..3 {
                s[row][i] = p[row][i] - ((sums[i][0] + sums[i][2]) + (sums[i][1] + sums[i][3]));
                sum += p[row][i] * (t[row][i] + s[row][i]);
            }
            if row % ROWS_AT_ONCE == 0 {
                total += f64::from(sum);
                sum = 0.0;
            }
        }
        total + f64::from(sum)
    }
}

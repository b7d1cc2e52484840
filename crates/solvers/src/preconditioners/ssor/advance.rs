//! The step along the direction.

use pulp::{Simd, WithSimd};

use super::super::coarse::Row;
use super::{CHUNK, Pair};
use crate::parts::Part;
use fem_elements::number::vectorized;
use fem_elements::threads::join;

/// x += α t, r −= α (t + s).
pub struct Advance<'a> {
    pub alpha: f32,
    pub st: &'a [Pair],
    pub x: &'a mut [Row],
    pub r: &'a mut [Row],
}

impl<'a> Advance<'a> {
    /// Advances the rows of a part; returns r·r.
    pub fn rows(self, part: &Part) -> f64 {
        let Some([left, right]) = part.halves.as_deref() else { return vectorized(self) };
        let [a, rest] = self.split(left.rows.len());
        let [b, own] = rest.split(right.rows.len());
        let (a, b) = join(|| a.rows(left), || b.rows(right));
        a + b + vectorized(own)
    }

    fn split(self, middle: usize) -> [Self; 2] {
        let Self { alpha, st, x, r } = self;
        let (st, st_right) = st.split_at(middle);
        let (x, x_right) = x.split_at_mut(middle);
        let (r, r_right) = r.split_at_mut(middle);
        [Advance { alpha, st, x, r }, Advance { alpha, st: st_right, x: x_right, r: r_right }]
    }
}

impl WithSimd for Advance<'_> {
    type Output = f64;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _simd: S) -> f64 {
        let Self { alpha, st, x, r } = self;
        let mut sum = 0.0;
        let chunks = st.chunks(CHUNK).zip(x.chunks_mut(CHUNK)).zip(r.chunks_mut(CHUNK));
        for ((st, x), r) in chunks {
            let mut squares = [0.0; 4];
            for (([s, t], x), r) in st.iter().zip(x).zip(r) {
                for k in 0..4 {
                    x[k] += alpha * t[k];
                    r[k] -= alpha * (t[k] + s[k]);
                    squares[k] += r[k] * r[k];
                }
            }
            sum += f64::from(squares.iter().sum::<f32>());
        }
        sum
    }
}

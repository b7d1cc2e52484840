//! Transposes of lanes, which the compiler turns into shuffles.

use std::array::from_fn;

use super::{F32x8, F64x4};

impl F64x4 {
    /// The transpose of four rows, by shuffles of two registers each.
    #[inline(always)]
    pub(in super::super) fn transpose(rows: [Self; 4]) -> [Self; 4] {
        let [a, b, c, d] = rows.map(Self::numbers);
        let even = |a: [f64; 4], b: [f64; 4]| Self::new([a[0], b[0], a[2], b[2]]).numbers();
        let odd = |a: [f64; 4], b: [f64; 4]| Self::new([a[1], b[1], a[3], b[3]]).numbers();
        let (ab, cd) = ([even(a, b), odd(a, b)], [even(c, d), odd(c, d)]);
        let low = |a: [f64; 4], b: [f64; 4]| Self::new([a[0], a[1], b[0], b[1]]);
        let high = |a: [f64; 4], b: [f64; 4]| Self::new([a[2], a[3], b[2], b[3]]);
        [low(ab[0], cd[0]), low(ab[1], cd[1]), high(ab[0], cd[0]), high(ab[1], cd[1])]
    }
}

impl F32x8 {
    /// The transpose of eight rows, by shuffles of two registers each.
    #[inline(always)]
    pub(in super::super) fn transpose(rows: [Self; 8]) -> [Self; 8] {
        type A = [f32; 8];
        let r = rows.map(Self::numbers);
        // Pairs within each half of a register, then fours, then the halves.
        let low = |a: A, b: A| Self::new([a[0], b[0], a[1], b[1], a[4], b[4], a[5], b[5]]).numbers();
        let high = |a: A, b: A| Self::new([a[2], b[2], a[3], b[3], a[6], b[6], a[7], b[7]]).numbers();
        let first = |a: A, b: A| Self::new([a[0], a[1], b[0], b[1], a[4], a[5], b[4], b[5]]).numbers();
        let second = |a: A, b: A| Self::new([a[2], a[3], b[2], b[3], a[6], a[7], b[6], b[7]]).numbers();
        let four = |a: A, b: A, c: A, d: A| {
            let (ab, cd) = ([low(a, b), high(a, b)], [low(c, d), high(c, d)]);
            [first(ab[0], cd[0]), second(ab[0], cd[0]), first(ab[1], cd[1]), second(ab[1], cd[1])]
        };
        let (upper, lower) = (four(r[0], r[1], r[2], r[3]), four(r[4], r[5], r[6], r[7]));
        let left = |a: A, b: A| Self::new([a[0], a[1], a[2], a[3], b[0], b[1], b[2], b[3]]);
        let right = |a: A, b: A| Self::new([a[4], a[5], a[6], a[7], b[4], b[5], b[6], b[7]]);
        from_fn(|i| if i < 4 { left(upper[i], lower[i]) } else { right(upper[i - 4], lower[i - 4]) })
    }
}

//! An order of insertion in which successive points are close to each other: biased randomized rounds, Amenta, Choi and Rote,
//! Incremental Constructions con BRIO (2003), along Hilbert's curve, Skilling, Programming the Hilbert Curve (2004).

use nalgebra::Vector3;

use crate::boxes::Bounds;

/// Bits of each coordinate on the curve.
const BITS: u32 = 20;

/// Indices of points, m, in the order in which [`tetrahedralize`](super::tetrahedralize) inserts them: in rounds, the last of which has about half of
/// them, the one before a quarter, and so on. In a round, points that follow each other are close to each other, and points at one place keep their
/// order. The rounds are a fixed function of the indices, so a mesh is reproducible.
pub fn insertion_order(points: &[Vector3<f64>]) -> Vec<usize> {
    let Bounds { least, largest } = Bounds::of(points);
    let size = (largest - least).max();
    let scale = if size > 0.0 { f64::from((1_u32 << BITS) - 1) / size } else { 0.0 };
    let mut order: Vec<(u32, u64, usize)> = points
        .iter()
        .enumerate()
        .map(|(index, x)| (round(index), on_curve(((x - least) * scale).map(|x| x as u32).into()), index))
        .collect();
    order.sort_unstable();
    order.into_iter().map(|(_, _, index)| index).collect()
}

/// The round of a point: half of all points are in the last one, a quarter in the one before, and so on.
fn round(index: usize) -> u32 {
    // The finalizer of Steele, Lea and Flood, Fast Splittable Pseudorandom Number Generators (2014).
    let mut x = (index as u64).wrapping_add(0x9e37_79b9_7f4a_7c15);
    x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    64 - (x ^ (x >> 31)).leading_ones().min(16)
}

/// Distance along Hilbert's curve of a cell of the grid.
fn on_curve(mut x: [u32; 3]) -> u64 {
    let mut bit = 1 << (BITS - 1);
    while bit > 1 {
        let below = bit - 1;
        for i in 0..3 {
            if x[i] & bit != 0 {
                x[0] ^= below;
            } else {
                let exchanged = (x[0] ^ x[i]) & below;
                x[0] ^= exchanged;
                x[i] ^= exchanged;
            }
        }
        bit >>= 1;
    }
    x[1] ^= x[0];
    x[2] ^= x[1];
    let mut gray = 0;
    let mut bit = 1 << (BITS - 1);
    while bit > 1 {
        if x[2] & bit != 0 {
            gray ^= bit - 1;
        }
        bit >>= 1;
    }
    let x = x.map(|x| x ^ gray);
    (0..BITS).rev().fold(0, |sum, bit| x.iter().fold(sum, |sum, x| sum << 1 | u64::from(x >> bit & 1)))
}
